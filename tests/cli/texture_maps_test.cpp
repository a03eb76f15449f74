// pack, mips, normal, bake, unpack, compare, inspect, generate from outside: what they make of good
// maps, and what they say about bad ones. Whatever goes wrong, files that were there stay as they
// were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/sanitized.h"
#include "film/frames/film.h"
#include "tests/support/assets.h"
#include "tests/support/program.h"
#include "texproc/generate/generate.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using testing::Not;
using namespace testing_program;
namespace fs = std::filesystem;
using nlohmann::json;

// Good and bad maps of one small material, and an old output.
void write_maps(const Workplace& place)
{
    const texproc::MaterialMaps soil =
        texproc::generate_material(texproc::MaterialKind::Soil, 32, 1, 1);
    texproc::write_image(place / "normal.png", soil.normal);
    texproc::write_image(place / "rough.png", soil.roughness);
    texproc::write_image(place / "height.png", soil.height, {.bits = 16});
    texproc::write_image(place / "color.png", soil.albedo);
    texproc::write_image(place / "other.png", Image(16, 32, 1, ColorSpace::Data, 0.5f));
    texproc::write_image(place / "line.png", Image(1, 32, 1, ColorSpace::Data, 0.5f));
    texproc::write_image(place / "zero.png", Image(32, 32, 3, ColorSpace::Data, 0.5f));
    Image nan(32, 32, 1, ColorSpace::Data, 0.5f);
    nan.pixels[7] = std::nanf("");
    texproc::write_image(place / "nan.exr", nan, {.bits = 32});
    write_file(place / "text.png", "this is no picture");
    write_file(place / "file", "x");
    write_file(place / "bad.toml", "channels = [\"a\", \"b\", \"c\", \"d\", \"e\"]\n");
    for (const char* name : {"out.png", "out_0.png", "out_1.png", "out_occlusion.png"})
        write_file(place / name, "old");
}

struct Mistake {
    const char* name;
    std::vector<std::string> arguments;
    const char* message;
};
void PrintTo(const Mistake& m, std::ostream* out)
{
    *out << m.name;
}

class TextureMistake : public testing::TestWithParam<Mistake> {};
TEST_P(TextureMistake, ExitsWithTwoSaysWhatAndKeepsWhatWasThere)
{
    const Workplace place(std::string("texture_") + GetParam().name);
    write_maps(place);
    std::vector<std::string> arguments{"texture"};
    arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    const Outcome outcome = run(arguments, place);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
    EXPECT_THAT(outcome.err, HasSubstr("\n  ")) << "says what to do";
    for (const char* name : {"out.png", "out_0.png", "out_1.png", "out_occlusion.png"}) {
        EXPECT_EQ(read_file(place / name), "old") << name;
    }
}
INSTANTIATE_TEST_SUITE_P(
    Table, TextureMistake,
    testing::Values(
        Mistake{"pack_no_file",
                {"pack", "--preset", "gltf-orm", "--roughness", "gone.png", "-o", "out.png"},
                "gone.png"},
        Mistake{"pack_no_picture",
                {"pack", "--preset", "gltf-orm", "--roughness", "text.png", "-o", "out.png"},
                "text.png"},
        Mistake{"pack_sizes",
                {"pack", "--preset", "gltf-orm", "--roughness", "rough.png", "--metallic",
                 "other.png", "-o", "out.png"},
                "16 x 32"},
        Mistake{"pack_preset",
                {"pack", "--preset", "gltf-rom", "--roughness", "rough.png", "-o", "out.png"},
                "gltf-rom"},
        Mistake{"pack_role",
                {"pack", "--preset", "gltf-orm", "--height", "height.png", "-o", "out.png"},
                "no channel for 'height'"},
        Mistake{
            "pack_nothing", {"pack", "--preset", "gltf-orm", "-o", "out.png"}, "no map was given"},
        Mistake{"pack_own",
                {"pack", "--preset", "bad.toml", "--map", "a=rough.png", "-o", "out.png"},
                "bad.toml:1"},
        Mistake{"pack_channel",
                {"pack", "--preset", "gltf-orm", "--roughness", "rough.png:b", "-o", "out.png"},
                "'b' is not one"},
        Mistake{"pack_folder",
                {"pack", "--preset", "gltf-orm", "--roughness", "rough.png", "-o", "file/out.png"},
                "file"},
        Mistake{"pack_format",
                {"pack", "--preset", "gltf-orm", "--roughness", "rough.png", "--format", "bc7",
                 "-o", "out.png"},
                "no blocks"},
        Mistake{"mips_pattern", {"mips", "color.png", "-o", "out.png"}, "%d"},
        Mistake{
            "mips_normals", {"mips", "rough.png", "--normals", "-o", "out_%d.png"}, "3 channels"},
        Mistake{"mips_alpha",
                {"mips", "color.png", "--alpha-cutoff", "0.5", "-o", "out_%d.png"},
                "4 channels"},
        Mistake{"mips_nan", {"mips", "nan.exr", "-o", "out_%d.png"}, "not numbers"},
        Mistake{"normal_channels",
                {"normal", "rough.png", "--flip-green", "-o", "out.png"},
                "3 channels"},
        Mistake{"normal_layout",
                {"normal", "normal.png", "--from-layout", "ag", "-o", "out.png"},
                "4 channels"},
        Mistake{
            "normal_nan", {"normal", "nan.exr", "--from-height", "-o", "out.png"}, "not numbers"},
        Mistake{"normal_nothing", {"normal", "normal.png"}, "--out"},
        Mistake{"normal_blend",
                {"normal", "normal.png", "--blend", "other.png", "-o", "out.png"},
                "other.png"},
        Mistake{"normal_detect",
                {"normal", "normal.png", "--detect", "--height", "other.png"},
                "16 x 32"},
        Mistake{"bake_nan", {"bake", "--height", "nan.exr", "-o", "out_%d.png"}, "not numbers"},
        Mistake{"bake_sizes",
                {"bake", "--height", "height.png", "--roughness", "rough.png", "--metallic",
                 "other.png", "-o", "out_%d.png"},
                "16 x 32"},
        Mistake{"bake_reach",
                {"bake", "--height", "height.png", "--reach", "0.9", "-o", "out_%d.png"},
                "reach"},
        Mistake{"bake_folder", {"bake", "--height", "height.png", "-o", "file/out_%d.png"}, "file"},
        Mistake{"unpack_channels",
                {"unpack", "rough.png", "--preset", "unity-hdrp-mask", "-o", "out_%d.png"},
                "unity-hdrp-mask holds maps in the first 4"},
        Mistake{"unpack_pattern",
                {"unpack", "color.png", "--preset", "gltf-orm", "-o", "out.png"},
                "%d"},
        Mistake{"compare_sizes", {"compare", "rough.png", "other.png", "-o", "out.png"}, "16 x 32"},
        Mistake{"compare_fails",
                {"compare", "color.png", "zero.png", "--fail-psnr", "60"},
                "differ by more"},
        Mistake{"score_json", {"score", "--picture", "quick", "--json"}, "--csv"},
        Mistake{"inspect_text", {"inspect", "text.png", "rough.png"}, "text.png"},
        Mistake{"sheet_maps", {"inspect", "rough.png", "--sheet", "out.png"}, "--sheet and --film need"},
        Mistake{"film_kind", {"inspect", "normal.png", "rough.png", "--film", "out.gif"}, ".mp4"},
        Mistake{"generate_kind", {"generate", "cobbel", "-o", "made"}, "Did you mean \"cobble\"?"},
        Mistake{"generate_parameter", {"generate", "brick", "--set", "joints_m=0.01", "-o", "made"}, "Did you mean \"joint_m\"?"},
        Mistake{"generate_range", {"generate", "brick", "--set", "joint_m=1", "-o", "made"}, "0.002 to 0.025"},
        Mistake{"generate_number", {"generate", "brick", "--set", "joint_m=wide", "-o", "made"}, "NAME=NUMBER"},
        Mistake{"generate_color", {"generate", "brick", "--color", "#12345", "-o", "made"}, "#rrggbb"},
        Mistake{"generate_preset", {"generate", "bad.toml", "-o", "made"}, "bad.toml"},
        Mistake{"generate_twice", {"generate", "brick", "brick", "-o", "made"}, "two materials"},
        Mistake{"generate_ripple_set", {"generate", "ripple", "--set", "tile_m=1", "-o", "made"}, "has no parameters"},
        Mistake{"generate_none", {"generate", "-o", "made"}, "no material was named"},
        Mistake{"generate_size", {"generate", "cobble", "--size", "4", "-o", "made"}, "--size"}),
    [](const auto& test) { return test.param.name; });

TEST(TextureTools, AFullDiskLeavesTheOldFile)
{
    const Workplace place("texture_full");
    write_maps(place);
    write_file(place / "out.dds", "old");
    // 32 x 32 x 2 bytes are read, four times that cannot be written.
    const Outcome outcome = run_petrichor(
        {.arguments = {"texture", "pack", "--preset", "gltf-orm", "--roughness", "height.png",
                       "--occlusion", "height.png", "--metallic", "height.png", "-o", "out.dds"},
         .file_limit_bytes = 3500},
        place.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("cannot write"));
    EXPECT_EQ(read_file(place / "out.dds"), "old");
}

TEST(TextureTools, AWordThatIsNoCommandIsNamed)
{
    const Workplace place("texture_words");
    for (const auto& [word, said] : {std::pair{"prepare", "no command \"prepare\""}, {"biuld", "Did you mean \"build\"?"}}) {
        const Outcome outcome = run({"texture", word, "x.png"}, place);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_THAT(outcome.err, HasSubstr(said));
        EXPECT_THAT(outcome.err, HasSubstr("prefilter"));
    }
    EXPECT_THAT(run({"texture"}, place).err, HasSubstr("a command is missing"));
    EXPECT_THAT(run({"texture", "mips", "a.png", "-o", "b_%d.png", "more"}, place).err, HasSubstr("not expected: more"));
}

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

TEST(TextureTools, CompareAndInspectSpeakToMachines)
{
    const Workplace place("texture_json");
    write_maps(place);
    const json same =
        json::parse(run({"texture", "compare", "color.png", "color.png", "--json"}, place).out);
    EXPECT_TRUE(same["psnr_db"].is_null());
    EXPECT_EQ(same["flip"]["mean"].get<double>(), 0.0);
    ASSERT_EQ(
        run({"texture", "normal", "normal.png", "--flip-green", "-o", "dx.png", "--bits", "8"},
            place)
            .exit_code,
        0);
    const Outcome turned =
        run({"texture", "compare", "normal.png", "dx.png", "--json", "-o", "d.png"}, place);
    EXPECT_EQ(json::parse(turned.out)["kind"].get<std::string>(), "normal") << turned.out;
    EXPECT_GT(json::parse(turned.out)["angle_degrees"]["max"].get<double>(), 10.0);
    EXPECT_EQ(texproc::read_raw(place / "d.png").channels, 3);
    const json facts = json::parse(run({"texture", "inspect", "dx.png", "--json"}, place).out);
    EXPECT_EQ(facts[0]["green"]["direction"].get<std::string>(), "down");
    EXPECT_EQ(run({"texture", "inspect", "normal.png", "rough.png", "--sheet", "sheet.png"}, place)
                  .exit_code,
              0);
    EXPECT_GT(texproc::read_raw(place / "sheet.png").width, 400);
}

// Five lights, three pictures each: the strip has the first frame of the film.
TEST(TextureTools, AFilmShowsHowAMaterialHoldsStill)
{
    const Workplace place("texture_film");
    write_maps(place);
    const auto film = [&](const char* name) {
        return run({"texture", "inspect", "normal.png", "rough.png", "--film", name, "--frames", "3"}, place);
    };
    ASSERT_EQ(film("strip.png").exit_code, 0);
    const texproc::RawImage strip = texproc::read_raw(place / "strip.png");
    EXPECT_GT(strip.width, 3 * 600);
    EXPECT_GT(strip.height, 5 * 220);
    // Paper, and three pictures of the first light that are not the same.
    const auto at = [&](int x, int y) { return static_cast<int>(strip.bytes[static_cast<std::size_t>((y * strip.width + x) * strip.channels)]); };
    EXPECT_EQ(at(4, 100), 255);
    int differ = 0;
    for (int y = 70; y < 280; y += 4) {
        for (int x = 20; x < 600; x += 4) differ += std::abs(at(x, y) - at(x + 1220, y)) > 6 ? 1 : 0;
    }
    EXPECT_GT(differ, 50) << "plain mips are not the truth";
    if (petrichor::film::find_ffmpeg().empty()) {
        EXPECT_EQ(film("wall.mp4").exit_code, 2);
        return;
    }
    EXPECT_EQ(film("wall.mp4").exit_code, 0);
    const std::string bytes = read_file(place / "wall.mp4");
    EXPECT_GT(bytes.size(), 10000u);
    EXPECT_EQ(bytes.substr(4, 4), "ftyp");
    const std::size_t sizes = bytes.find("stsz");  // version, size of all, count of samples
    ASSERT_NE(sizes, std::string::npos);
    EXPECT_EQ(static_cast<int>(bytes.at(sizes + 15)), 3);
}

TEST(TextureTools, PsnrAloneIsThatOfTheWholeComparison)
{
    const Workplace place("texture_psnr");
    write_maps(place);
    const auto report = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"texture", "compare", "color.png", "zero.png", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return json::parse(run(words, place).out);
    };
    const json whole = report({}), alone = report({"--psnr-only"});
    EXPECT_EQ(alone["psnr_db"], whole["psnr_db"]);
    EXPECT_EQ(alone.size(), 1u);
    EXPECT_EQ(
        run({"texture", "compare", "color.png", "zero.png", "--psnr-only", "--fail-psnr", "60"},
            place)
            .exit_code,
        2);
}

// Light beyond 1 is cut off before it is compared: "equal" is not to be taken for more than that.
TEST(TextureTools, CompareSaysWhereItCutsLightOff)
{
    const Workplace place("texture_bright");
    const auto write = [&](const char* name, float value) {
        texproc::write_image(place / name, Image(16, 16, 3, ColorSpace::Linear, value));
    };
    write("bright.exr", 107.5f);
    write("brighter.exr", 119.5f);
    write("dim.exr", 0.25f);
    const Outcome cut = run({"texture", "compare", "bright.exr", "brighter.exr"}, place);
    EXPECT_EQ(cut.exit_code, 0) << cut.err;
    for (const char* name : {"bright.exr", "brighter.exr"})
        EXPECT_THAT(cut.err, HasSubstr(std::string("note: ") + name +
                                       ": 768 of 768 numbers lie beyond 0..1"));
    EXPECT_THAT(run({"texture", "compare", "dim.exr", "dim.exr"}, place).err,
                testing::Not(HasSubstr("beyond")));
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
}

// Every damaged and every awkward file of the shared data in one command:
//   petrichor texture inspect $(find bad formats -type f)
TEST(TextureTools, InspectSurvivesEveryBadFile)
{
    NEED_ASSETS(assets);
    const Workplace place("texture_bad_files");
    std::vector<std::string> command{"texture", "inspect"};
    for (const char* folder : {"bad", "formats"}) {
        for (const auto& entry : fs::recursive_directory_iterator(assets / folder)) {
            const bool scene = entry.path().string().find("/gltf") != std::string::npos;
            if (entry.is_regular_file() && !scene) command.push_back(entry.path().string());
        }
    }
    ASSERT_GT(command.size(), 300u);
    const Outcome outcome = run(command, place);
    EXPECT_EQ(outcome.exit_code, 2) << "some are damaged";
    std::size_t pictures = 0, errors = 0;
    for (std::size_t i = 2; i < command.size(); ++i) {
        const bool shown = outcome.out.find(command[i] + ": ") != std::string::npos;
        const bool refused = outcome.err.find(command[i]) != std::string::npos;
        EXPECT_NE(shown, refused) << command[i];
        pictures += shown;
        errors += refused;
    }
    EXPECT_GE(pictures, 170u);
    EXPECT_GE(errors, 120u);
    struct rusage usage {};
    ASSERT_EQ(getrusage(RUSAGE_CHILDREN, &usage), 0);
#ifndef PETRICHOR_SANITIZED  // which keeps freed memory for a while
    EXPECT_LT(usage.ru_maxrss, 2l * 1024 * 1024) << "KiB";
#endif
    std::printf("%zu files: %zu pictures, %zu errors, at most %ld MiB\n", command.size() - 2,
                pictures, errors, usage.ru_maxrss / 1024);
}

// Blocks that have an alpha of their own are off by a few codes of 255 where all of it was opaque.
TEST(TextureTools, CompareIgnoresAnAlphaThatSaysNothing)
{
    const Workplace place("texture_idle_alpha");
    Image color(16, 16, 3, ColorSpace::Data, 0.4f);
    texproc::write_image(place / "rgb.png", color);
    const auto with_alpha = [&](int code) {
        Image rgba(16, 16, 4, ColorSpace::Data, 0.4f);
        for (std::size_t i = 3; i < rgba.pixels.size(); i += 4) rgba.pixels[i] = 1.0f;
        rgba.pixels[3 + 4 * 37] = static_cast<float>(code) / 255.0f;
        texproc::write_image(place / "rgba.png", rgba);
        return run({"texture", "compare", "rgb.png", "rgba.png"}, place);
    };
    EXPECT_EQ(with_alpha(255).exit_code, 0);
    EXPECT_EQ(with_alpha(250).exit_code, 0);
    const Outcome hole = with_alpha(249);
    EXPECT_EQ(hole.exit_code, 2);
    EXPECT_THAT(hole.err, HasSubstr("with 4 channels"));
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

// Rows for every task, ours always timed, others timed or named as missing.
TEST(TextureTools, BenchTimesOursBesideWhatIsInstalled)
{
    const Workplace place("bench_texture");
    const Outcome bench =
        run({"bench", "texture", "--size", "32", "--repeat", "1", "--json"}, place);
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    std::set<std::string> tasks;
    const json report = json::parse(bench.out);
    for (const json& row : report["rows"]) {
        tasks.insert(row["task"].get<std::string>());
        const std::string program = row["program"].get<std::string>();
        if (program.starts_with("petrichor")) {
            EXPECT_TRUE(row.contains("cpu_s")) << row.dump();
        } else {
            EXPECT_TRUE(row.contains("cpu_s") || row.contains("note")) << row.dump();
        }
    }
    EXPECT_EQ(tasks, (std::set<std::string>{"bc5", "bc7", "mips", "pack", "prefilter"}));
    const Outcome lone = run({"bench", "texture", "--normal", "n.png"}, place);
    EXPECT_EQ(lone.exit_code, 2);
    EXPECT_THAT(lone.err, HasSubstr("belong together"));
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
