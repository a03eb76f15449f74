// pack, mips, normal, bake, unpack, inspect, generate from outside: what they make of good maps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/texture_inputs.h"
#include "tests/support/program.h"
#include "texproc/filter/normal_codes.h"
#include "texproc/generate/generate.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using testing::Not;
using namespace testing_program;
using namespace testing_texture;
namespace fs = std::filesystem;
using nlohmann::json;

// From its numbers a grey colour is a height.
TEST(TextureTools, InspectSaysWhatTheNameSays)
{
    const Workplace place("texture_named");
    write_maps(place);
    fs::copy(place / "rough.png", place / "Tiles_Color.png");
    fs::copy(place / "color.png", place / "wall_arm.png");
    const std::string out = run({"texture", "inspect", "Tiles_Color.png", "wall_arm.png"}, place).out;
    EXPECT_THAT(out, HasSubstr("named as    albedo (sRGB)\n"));
    EXPECT_THAT(out, HasSubstr("roughness g"));
    const json facts = json::parse(run({"texture", "inspect", "Tiles_Color.png", "--json"}, place).out);
    EXPECT_TRUE(facts[0]["named"].contains("albedo"));
}

// The height of ground_alb_ht.png is its alpha; red, which was taken before, is colour.
TEST(TextureTools, BakeTakesTheChannelThatHoldsTheHeight)
{
    const Workplace place("texture_bake_channel");
    Image height(32, 32, 1, ColorSpace::Data), both(32, 32, 4, ColorSpace::Data);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            height.at(x, y, 0) = (x / 4 + y / 4) % 2 ? 0.8f : 0.2f;
            both.at(x, y, 0) = static_cast<float>(x) / 31.0f;
            both.at(x, y, 2) = static_cast<float>(y) / 31.0f;
            both.at(x, y, 3) = height.at(x, y, 0);
        }
    texproc::write_raw(place / "alone.png", texproc::to_raw(height, texproc::PixelType::U8));
    for (const char* name : {"ground_alb_ht.png", "both.png"})
        texproc::write_raw(place / name, texproc::to_raw(both, texproc::PixelType::U8));
    const auto bake = [&](const std::string& map, const std::string& out) {
        return run({"texture", "bake", "--height", map, "-o", out + "_%d.png"}, place);
    };
    EXPECT_EQ(bake("alone.png", "a").err, "");
    EXPECT_THAT(bake("ground_alb_ht.png", "b").err, HasSubstr("height is ground_alb_ht.png:a"));
    EXPECT_EQ(bake("both.png:a", "c").err, "");
    EXPECT_THAT(bake("both.png", "d").err, HasSubstr("coloured"));
    const std::string known = read_file(place / "a_occlusion.png");
    EXPECT_EQ(read_file(place / "b_occlusion.png"), known);
    EXPECT_EQ(read_file(place / "c_occlusion.png"), known);
    EXPECT_NE(read_file(place / "d_occlusion.png"), known);
    EXPECT_EQ(bake("alone.png:b", "e").exit_code, 2);
    EXPECT_EQ(run({"texture", "normal", "both.png:a", "--from-height", "-o", "n.png"}, place).exit_code, 0);
}

// What is not what it was named for is said, where it can be seen.
TEST(TextureTools, ColourInThePlaceOfDataIsSaid)
{
    const Workplace place("texture_colour_said");
    Image color(16, 16, 3, ColorSpace::Data), light(16, 16, 1, ColorSpace::Data, 3.0f);
    Image normal(16, 16, 3, ColorSpace::Data, 0.5f), grey(16, 16, 3, ColorSpace::Data, 0.4f);
    for (std::size_t i = 0; i < color.pixels.size(); ++i) {
        color.pixels[i] = i % 3 == 2 ? 0.2f : 0.6f;
        if (i % 3 == 2) normal.pixels[i] = 1.0f;
    }
    for (const auto& [name, image] : {std::pair{"paint.png", &color}, {"up.png", &normal}, {"grey.png", &grey}})
        texproc::write_raw(place / name, texproc::to_raw(*image, texproc::PixelType::U8));
    texproc::write_raw(place / "light.exr", texproc::to_raw(light, texproc::PixelType::F32));
    const auto said = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "texture");
        const Outcome outcome = run(arguments, place);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.err;
    };
    const std::vector<std::string> to{"--rule", "median", "-o", "o_%d.png"};
    const auto prefilter = [&](const std::string& n, const std::string& r) {
        std::vector<std::string> all{"prefilter", "--normal", n, "--roughness", r};
        all.insert(all.end(), to.begin(), to.end());
        return said(all);
    };
    EXPECT_THAT(prefilter("paint.png", "grey.png"), HasSubstr("hardly a normal map"));
    EXPECT_THAT(prefilter("up.png", "paint.png"), HasSubstr("its red is taken for the roughness"));
    EXPECT_THAT(prefilter("up.png", "grey.png"), Not(HasSubstr("note")));
    EXPECT_THAT(prefilter("up.png", "paint.png:g"), Not(HasSubstr("note")));
    const std::vector<std::string> pack{"pack", "--preset", "gltf-orm", "-o", "p.png", "--metallic", "grey.png", "--roughness"};
    auto red = pack, green = pack;
    red.push_back("paint.png"), green.push_back("paint.png:g");
    EXPECT_THAT(said(red), HasSubstr("its red is taken for the roughness"));
    EXPECT_EQ(said(green), "");
    const std::string by_channel = read_file(place / "p.png");
    fs::copy(place / "paint.png", place / "wall_arm.png");
    green.back() = "wall_arm.png";
    EXPECT_THAT(said(green), HasSubstr("roughness is wall_arm.png:g, as the name says"));
    EXPECT_EQ(read_file(place / "p.png"), by_channel);
    EXPECT_THAT(said({"mips", "light.exr", "-o", "m_%d.png"}), HasSubstr("256 of 256 numbers are above 1"));
    EXPECT_EQ(said({"mips", "light.exr", "-o", "m.exr"}), "");
}

TEST(TextureTools, OddShapesAreFine)
{
    const Workplace place("texture_odd");
    write_maps(place);
    EXPECT_EQ(run({"texture", "mips", "line.png", "-o", "m_%d.png"}, place).exit_code, 0);
    EXPECT_TRUE(fs::exists(place / "m_5.png"));
    EXPECT_EQ(run({"texture", "bake", "--height", "line.png", "-o", "b_%d.png"}, place).exit_code,
              0);
    EXPECT_TRUE(fs::exists(place / "b_puddle.png"));
    EXPECT_EQ(run({"texture", "inspect", "line.png"}, place).exit_code, 0);
    const Outcome same = run({"texture", "compare", "line.png", "line.png"}, place);
    EXPECT_EQ(same.exit_code, 0);
    EXPECT_THAT(same.out, HasSubstr("psnr     equal"));
    EXPECT_THAT(same.out, Not(HasSubstr("equal dB")));
    // Zero normals point up.
    EXPECT_EQ(run({"texture", "normal", "zero.png", "--renormalize", "--bits", "8", "-o", "up.png"},
                  place)
                  .exit_code,
              0);
    EXPECT_EQ(static_cast<int>(texproc::read_raw(place / "up.png").bytes[2]), 255);
}

TEST(TextureTools, APresetOfOnesOwnPacksAndUnpacks)
{
    const Workplace place("texture_own");
    write_maps(place);
    write_file(place / "mine.toml",
               "note = \"mine\"\nchannels = [\"wetness | 0\", \"1 - roughness\", \"normal.g\", "
               "\"0.25\"]\n");
    ASSERT_EQ(run({"texture", "pack", "--preset", "mine.toml", "--map", "wetness=rough.png",
                   "--roughness", "rough.png", "--normal", "normal.png", "-o", "packed.png"},
                  place)
                  .exit_code,
              0);
    EXPECT_THAT(run({"texture", "pack", "--preset", "mine.toml", "--list"}, place).out,
                HasSubstr("wetness | 0"));
    ASSERT_EQ(
        run({"texture", "unpack", "packed.png", "--preset", "mine.toml", "-o", "u_%d.png"}, place)
            .exit_code,
        0);
    EXPECT_EQ(texproc::read_raw(place / "u_roughness.png").bytes,
              texproc::read_raw(place / "rough.png").bytes);
    EXPECT_EQ(texproc::read_raw(place / "u_wetness.png").bytes,
              texproc::read_raw(place / "rough.png").bytes);
}

double largest_angle(const std::string& a, const std::string& b, const Workplace& place)
{
    const Outcome made = run({"texture", "compare", a, b, "--kind", "normal", "--json"}, place);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    if (made.exit_code != 0) return 180.0;
    return json::parse(made.out)["angle_degrees"]["max"].get<double>();
}

// Many maps are shorter than 1 (JPEG, filters). z made from x and y alone would lean less.
TEST(TextureTools, TwoChannelsKeepTheDirectionOfShortNormals)
{
    const Workplace place("texture_short_normals");
    Image normal = texproc::generate_material(texproc::MaterialKind::Cobble, 32, 1, 1).normal;
    texproc::write_image(place / "long.png", normal, {.bits = 16});
    for (float& v : normal.pixels) v = 0.5f + 0.7f * (v - 0.5f);
    texproc::write_image(place / "short.png", normal, {.bits = 16});
    texproc::write_image(place / "rough.png", Image(32, 32, 1, ColorSpace::Data, 0.5f));
    write_file(place / "r.toml",
               "[inputs]\nnormal = \"short.png\"\nroughness = \"rough.png\"\n[[output]]\n"
               "file = \"{name}_n\"\nchannels = [\"normal.r\", \"normal.g\"]\n"
               "format = \"dds\"\ncompression = \"bc5\"\n");
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"build", "r.toml", "-o", "."},
             {"prefilter", "--normal", "short.png", "--roughness", "rough.png", "-o", "p_r.dds",
              "--normal-out", "p_n.dds", "--normal-format", "bc5"},
             {"convert", "short.png", "-o", "c_n.dds", "--format", "bc5", "--mips", "--normals"},
             {"normal", "short.png", "--to-layout", "ag", "-o", "ag.png"},
             {"normal", "ag.png", "--from-layout", "ag", "-o", "back.png"}}) {
        std::vector<std::string> all{"texture"};
        all.insert(all.end(), command.begin(), command.end());
        const Outcome made = run(all, place);
        ASSERT_EQ(made.exit_code, 0) << command[0] << made.err;
    }
    for (const char* file : {"r_n.dds", "p_n.dds", "c_n.dds"}) {
        EXPECT_LT(largest_angle("long.png", file, place), 6.0) << file;  // blocks
    }
    EXPECT_LT(largest_angle("long.png", "back.png", place), 0.1);
}

// No code of 8 bits is straight up. Still water of 16 bits leans a little in level 0 then, and as much in the
// others: neither turned to where level 0 does not mirror, nor made rough so as to reach there.
TEST(TextureTools, EightBitLevelsMirrorWhereTheirLevel0Does)
{
    const Workplace place("texture_water");
    Image normal(64, 64, 3, ColorSpace::Data), rough(64, 64, 1, ColorSpace::Data);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool water = x < 32;
            const float slope = water ? 0.0f : 0.3f * std::sin(0.9f * static_cast<float>(x + 2 * y));
            const float length = std::sqrt(1.0f + slope * slope);
            normal.at(x, y, 0) = 0.5f - 0.5f * slope / length;
            normal.at(x, y, 1) = 0.5f;
            normal.at(x, y, 2) = 0.5f + 0.5f / length;
            rough.at(x, y, 0) = water ? 0.05f : 0.5f;
        }
    }
    texproc::write_image(place / "n.png", normal, {.bits = 16});
    texproc::write_image(place / "r.png", rough, {.bits = 16});
    write_file(place / "m.toml",
               "[inputs]\nnormal = \"n.png\"\nroughness = \"r.png\"\n[prefilter]\nrule = \"overlap\"\n"
               "[[output]]\nfile = \"{name}_n\"\nchannels = [\"normal.r\", \"normal.g\", \"normal.b\"]\n"
               "format = \"png\"\nbits = 8\nlevel_files = true\n[[output]]\nfile = \"{name}_r\"\n"
               "channels = [\"roughness\"]\nformat = \"png\"\nbits = 8\nlevel_files = true\n");
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"texture", "prefilter", "--normal", "n.png", "--roughness", "r.png", "--rule", "overlap", "--quality",
              "quick", "--bits", "8", "-o", "p_r_%d.png", "--normal-out", "p_n_%d.png"},
             {"texture", "build", "m.toml", "--no-score", "-o", "."}}) {
        const Outcome made = run(command, place);
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    for (const std::string what : {"p_n_", "p_r_", "m_n_", "m_r_"}) {
        const auto codes = [&](int level) {
            const texproc::RawImage image = texproc::read_raw(place / (what + std::to_string(level) + ".png"));
            EXPECT_EQ(image.type, texproc::PixelType::U8) << what << level;
            const auto middle = static_cast<std::size_t>((image.height / 2 * image.width + image.width / 4) * image.channels);
            return std::vector<std::byte>(image.bytes.begin() + static_cast<std::ptrdiff_t>(middle),
                                          image.bytes.begin() + static_cast<std::ptrdiff_t>(middle) + image.channels);
        };
        for (int level = 1; level <= 3; ++level) EXPECT_EQ(codes(level), codes(0)) << what << level;
    }
    // Both sides of straight up lean alike (the waves go to either side): not the nearest codes.
    const texproc::RawImage map = texproc::read_raw(place / "n.png");
    for (const char* file : {"p_n_0.png", "m_n_0.png"}) {
        EXPECT_EQ(texproc::read_raw(place / file).bytes, texproc::normals_in_8_bits(map).bytes) << file;
        EXPECT_NE(texproc::read_raw(place / file).bytes, texproc::in_8_bits(map).bytes) << file;
    }
}

TEST(TextureTools, GeneratedSetsAreRecognisedByBuild)
{
    const Workplace place("texture_generate");
    ASSERT_EQ(
        run({"texture", "generate", "brick", "snow_mask", "--size", "32", "-o", "made"}, place)
            .exit_code,
        0);
    const json facts = json::parse(read_file(place / "made/brick.json"));
    EXPECT_GT(facts["tile_m"].get<double>(), 0.1);
    EXPECT_EQ(texproc::read_raw(place / "made/brick_height.png").type, texproc::PixelType::U16);
    EXPECT_EQ(texproc::read_raw(place / "made/snow_mask.png").channels, 4);
    const Outcome built =
        run({"texture", "build", "made", "--engine", "unity-hdrp", "-o", "out"}, place);
    EXPECT_EQ(built.exit_code, 0) << built.err;
    EXPECT_TRUE(fs::exists(place / "out/brick_MaskMap.dds"));
}

TEST(TextureTools, APresetMakesTheMaterialAgain)
{
    const Workplace place("texture_presets");
    const Outcome listed = run({"texture", "generate", "--list"}, place);
    EXPECT_THAT(listed.out, HasSubstr("old_road"));
    EXPECT_THAT(run({"texture", "generate", "--list", "old_road"}, place).out, HasSubstr("patches"));
    const Outcome made = run({"texture", "generate", "old_road", "--size", "64", "--set", "wear=0.3", "--color",
                              "#6e6a64", "-o", "made"},
                             place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(json::parse(read_file(place / "made/old_road.json"))["kind"], "asphalt");
    const std::string written = read_file(place / "made/old_road.toml");
    EXPECT_THAT(written, HasSubstr("wear = 0.3"));
    EXPECT_THAT(written, HasSubstr("color = \"#6e6a64\""));
    const Outcome again =
        run({"texture", "generate", "made/old_road.toml", "--size", "64", "-o", "again"}, place);
    ASSERT_EQ(again.exit_code, 0) << again.err;
    for (const char* file : {"old_road_albedo.png", "old_road_height.png", "old_road_roughness.png", "old_road.toml"})
        EXPECT_EQ(read_file(place / "made" / file), read_file(place / "again" / file)) << file;
}

TEST(TextureTools, EveryPresetOfTheProjectIsMade)
{
    const Workplace place("texture_all");
    const Outcome made = run({"texture", "generate", "all", "--size", "32", "-o", "made"}, place);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    for (const char* name : {"gravel", "slate", "moss", "mud", "snow", "river_gravel", "rusty_sheet", "farm_track"})
        EXPECT_TRUE(fs::exists(place / "made" / (std::string(name) + "_albedo.png"))) << name;
}

// Normals say how deep a height map is, whichever way their green points.
TEST(TextureBake, TakesItsDepthFromTheNormals)
{
    const Workplace place("bake_depth");
    Image height(64, 64, 1, ColorSpace::Data);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            height.at(x, y, 0) =
                0.5f + 0.4f * static_cast<float>(((x * y) % 16 < 8 ? 1 : -1) * (y % 32) / 32.0);
        }
    }
    texproc::write_image(place / "h.png", height, {.bits = 16});
    EXPECT_EQ(run({"texture", "normal", "h.png", "--from-height", "--depth", "0.02", "--bits", "16",
                   "-o", "up.png"},
                  place)
                  .exit_code,
              0);
    EXPECT_EQ(run({"texture", "normal", "up.png", "--flip-green", "--bits", "16", "-o", "down.png"},
                  place)
                  .exit_code,
              0);
    for (const char* normal : {"up.png", "down.png"}) {
        const Outcome made = run({"texture", "bake", "--height", "h.png", "--normal", normal,
                                  "--width-m", "2", "-o", "b_%d.png"},
                                 place);
        ASSERT_EQ(made.exit_code, 0) << made.err;
        EXPECT_THAT(made.out, testing::HasSubstr("depth 0.0")) << normal;
        EXPECT_THAT(made.out, testing::HasSubstr(", fitted")) << normal;
        EXPECT_EQ(made.out.find("green down") != std::string::npos,
                  std::string(normal) == "down.png");
    }
    const Outcome both = run({"texture", "bake", "--height", "h.png", "--normal", "up.png",
                              "--depth", "0.1", "-o", "b_%d.png"},
                             place);
    EXPECT_EQ(both.exit_code, 2);
}

}  // namespace
}  // namespace petrichor::cli
