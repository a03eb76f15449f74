// What the levels hold that `petrichor texture build` writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/texture_inputs.h"
#include "tests/support/program.h"
#include "texproc/codecs/files/texture.h"
#include "texproc/generate/generate.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using namespace testing_program;
using namespace testing_texture;
namespace fs = std::filesystem;
using nlohmann::json;

// Level 0 of an image beside what a file holds of it.
double psnr_of(const fs::path& file, const texproc::RawImage& source)
{
    const texproc::RawImage read = texproc::decode_level(texproc::read_texture(file), 0);
    double sum = 0.0;
    const std::size_t texels = source.values() / 3;
    for (std::size_t i = 0; i < texels; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto code = [](const texproc::RawImage& of, std::size_t at) {
                return std::to_integer<int>(of.bytes[at]);
            };
            sum += std::pow(code(read, 4 * i + c) - code(source, 3 * i + c), 2);
        }
    return 10.0 * std::log10(65025.0 * 3.0 * static_cast<double>(texels) / sum);
}

// What zstd packs repeats blocks by default; a recipe and the command line say how much.
TEST(TextureBuild, BlocksRepeatForSmallerFilesWithinABound)
{
    const Workplace place("build_rdo");
    Image soft(128, 128, 3, ColorSpace::Data);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x)
            for (int c = 0; c < 3; ++c)
                soft.at(x, y, c) =
                    0.5f + 0.3f * std::sin(0.04f * static_cast<float>(x + y * (c + 1))) +
                    0.004f * static_cast<float>((x * 7919 + y * 104729 + c * 31) % 3);
    texproc::write_image(place / "in/Wall_albedo.png", soft);
    const texproc::RawImage source = texproc::read_raw(place / "in/Wall_albedo.png");
    const auto built = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"texture", "build"});
        more.insert(more.end(), {"-o", "out", "--force"});
        const Outcome done = run(more, place);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return place / "out/Wall_baseColor.ktx2";
    };
    const auto error_of = [](double db) { return 65025.0 * std::pow(10.0, -0.1 * db); };
    std::uintmax_t size = 0;
    double psnr = 0.0;
    for (const char* rdo : {"0", "0.25", "1", "16"}) {  // each costs more and saves more
        const fs::path file = built({"in", "--engine", "gltf", "--rdo", rdo, "--rdo-most", "255"});
        if (size > 0) {
            EXPECT_LT(fs::file_size(file), size) << rdo;
            EXPECT_LT(psnr_of(file, source), psnr) << rdo;
        }
        size = fs::file_size(file);
        psnr = psnr_of(file, source);
    }
    // No block gets farther off than one code, root mean square.
    const double best = error_of(psnr_of(built({"in", "--engine", "gltf", "--rdo", "0"}), source));
    const fs::path bounded = built({"in", "--engine", "gltf", "--rdo", "16"});
    EXPECT_LE(error_of(psnr_of(bounded, source)), best + 1.0);
    EXPECT_GT(error_of(psnr_of(bounded, source)), best);
    const std::string most = read_file(bounded);
    const std::string one = read_file(built({"in", "--engine", "gltf", "--rdo", "1"}));
    EXPECT_EQ(read_file(built({"in", "--engine", "gltf"})), one) << "the default";
    EXPECT_LT(one.size(), read_file(built({"in", "--engine", "gltf", "--rdo", "0"})).size());
    EXPECT_LT(read_file(built({"in", "--engine", "gltf", "--rdo", "16", "--rdo-most", "4"})).size(), most.size());
    const auto recipe = [&](const std::string& lines) {
        write_file(place / "r.toml",
                   "name = \"Wall\"\n[inputs]\nalbedo = \"in/Wall_albedo.png\"\n[[output]]\n"
                   "file = \"{name}_baseColor\"\nchannels = [\"albedo.r\", \"albedo.g\", "
                   "\"albedo.b\", \"1\"]\nsrgb = true\nformat = \"ktx2\"\ncompression = \"uastc\"\n" +
                       lines);
        return read_file(built({"r.toml"}));
    };
    EXPECT_EQ(recipe("rdo = 16\n"), most);
    EXPECT_GT(recipe("rdo = 0\n").size(), one.size());
    EXPECT_LT(recipe("rdo = 16\nrdo_most = 4\n").size(), most.size());
    const Outcome none = run({"texture", "build", "in", "--engine", "unreal", "--rdo", "1", "-o", "out"}, place);
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.err, HasSubstr("no output is one for --rdo"));
}

// Blocks turn the normals a little; the roughness beside them is chosen for what came out, and what
// ships is not worse than a rule that chooses nothing for the blocks.
TEST(TextureBuild, RoughnessIsAimedAtTheNormalsInTheFile)
{
    const Workplace place("build-aimed");
    const texproc::MaterialMaps metal =
        texproc::generate_material(texproc::MaterialKind::MetalPlate, 128, 3, 1);
    texproc::write_image(place / "metal_normal.png", metal.normal);
    texproc::write_image(place / "metal_roughness.png", metal.roughness);
    const auto built = [&](const std::string& name, const std::string& normals) {
        write_file(place / (name + ".toml"),
                   "[inputs]\nnormal = \"metal_normal.png\"\nroughness = "
                   "\"metal_roughness.png\"\n[[output]]\nfile = \"{name}_n\"\nchannels = "
                   "[\"normal.r\", \"normal.g\"]\n" +
                       normals +
                       "[[output]]\nfile = \"{name}_r\"\nchannels = [\"roughness\"]\n"
                       "format = \"dds\"\ncompression = \"bc4\"\n");
        return [&, name](const std::string& rule) {
            const Outcome made = run({"texture", "build", name + ".toml", "--rule", rule,
                                      "--quality", "full", "-o", name + rule},
                                     place);
            EXPECT_EQ(made.exit_code, 0) << made.err;
            return json::parse(read_file(place / (name + rule) / "manifest.json"))["sets"][0];
        };
    };
    const auto blocks = built("blocks", "format = \"dds\"\ncompression = \"bc5\"\n");
    const json ours = blocks("overlap"), median = blocks("median");
    for (const char* range : {"levels_1_to_5", "levels_6_up"}) {
        EXPECT_LE(ours["lobe_error"][range]["shipped"].get<double>(),
                  median["lobe_error"][range]["shipped"].get<double>() + 0.005)
            << range;
    }
    built("exact", "format = \"exr\"\nbits = 32\n")("overlap");
    EXPECT_NE(read_file(place / "blocksoverlap/blocks_r.dds"),
              read_file(place / "exactoverlap/exact_r.dds"));
    EXPECT_EQ(read_file(place / "blocksmedian/blocks_r.dds").size(),
              read_file(place / "exactoverlap/exact_r.dds").size());
}

// Full quality lights the maps as what their metallic map says: nothing metal as if there were no
// map, all of it as metal, some of it as neither.
TEST(TextureBuild, LevelsAreThoseOfWhatTheMetallicMapSays)
{
    const Workplace place("build-surface");
    const texproc::MaterialMaps plate =
        texproc::generate_material(texproc::MaterialKind::MetalPlate, 32, 3, 1);
    texproc::write_image(place / "normal.exr", plate.normal);
    texproc::write_image(place / "roughness.exr", plate.roughness);
    // share: how much of the map is metal, in a band; below 0 there is no map.
    const auto built = [&](const std::string& name, float share) {
        std::string recipe = "[inputs]\nnormal = \"normal.exr\"\nroughness = \"roughness.exr\"\n";
        std::string outputs =
            "[[output]]\nfile = \"{name}_n\"\nchannels = [\"normal.r\", \"normal.g\"]\n"
            "format = \"dds\"\ncompression = \"bc5\"\n[[output]]\nfile = \"{name}_r\"\n"
            "channels = [\"roughness\"]\nformat = \"dds\"\ncompression = \"bc4\"\n";
        if (share >= 0.0f) {
            Image metallic(32, 32, 1, ColorSpace::Data);
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x)
                    metallic.at(x, y, 0) = static_cast<float>(y) < 32.0f * share ? 1.0f : 0.0f;
            texproc::write_image(place / (name + "_metallic.png"), metallic);
            recipe += "metallic = \"" + name + "_metallic.png\"\n";
            outputs += "[[output]]\nfile = \"{name}_m\"\nchannels = [\"metallic\"]\n";
        }
        write_file(place / (name + ".toml"), recipe + outputs);
        const Outcome made = run({"texture", "build", name + ".toml", "--quality", "full",
                                  "--no-score", "-o", name},
                                 place);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return read_file(place / name / (name + "_n.dds")) +
               read_file(place / name / (name + "_r.dds"));
    };
    const std::string none = built("none", -1.0f), paint = built("paint", 0.0f),
                      some = built("some", 0.5f), metal = built("metal", 1.0f);
    EXPECT_TRUE(none == paint);
    EXPECT_FALSE(some == paint);
    EXPECT_FALSE(metal == paint);
    EXPECT_FALSE(metal == some);
}

// A second lobe lies beside the normals of an engine, turned as they are, and is what is scored.
TEST(TextureBuild, ASecondLobeGoesWithTheNormals)
{
    const Workplace place("build-lobes");
    const texproc::MaterialMaps plate = texproc::generate_material(texproc::MaterialKind::MetalPlate, 64, 3, 1);
    texproc::write_image(place / "in/plate_normal.png", plate.normal);
    texproc::write_image(place / "in/plate_roughness.png", plate.roughness);
    texproc::write_image(place / "in/plate_metallic.png", Image(64, 64, 1, ColorSpace::Data, 1.0f));
    const auto built = [&](const std::string& lobes) {
        const Outcome made = run({"texture", "build", "in", "--engine", "unreal", "--quality", "full", "--lobes", lobes,
                                  "-o", "out" + lobes},
                                 place);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return json::parse(contents(place / ("out" + lobes)).at("manifest.json"))["sets"][0]["picture_error"];
    };
    const json one = built("1"), two = built("2");
    EXPECT_EQ(one["lobes"], 1);
    EXPECT_EQ(two["lobes"], 2);
    EXPECT_LT(two["shipped"]["rmse"].get<double>(), one["shipped"]["rmse"].get<double>());
    EXPECT_FALSE(fs::exists(place / "out1/plate_second_lobe.dds"));
    // Filament's normals are levels of PNG and a KTX2.
    EXPECT_EQ(run({"texture", "build", "in", "--engine", "filament", "--quality", "full", "--lobes", "2", "-o", "both"}, place).exit_code, 0);
    EXPECT_TRUE(fs::exists(place / "both/plate_second_lobe.ktx2"));
    EXPECT_TRUE(fs::exists(place / "both/plate_second_lobe_1.png"));
    const texproc::RawImage lobe = texproc::read_raw(place / "out2/plate_second_lobe.dds"),
                            normal = texproc::read_raw(place / "out2/T_plate_N.dds"),
                            rough = texproc::read_raw(place / "in/plate_roughness.png");
    ASSERT_EQ(lobe.channels, 4);
    const Image a = to_image(lobe, ColorSpace::Data), b = to_image(normal, ColorSpace::Data),
                r = to_image(rough, ColorSpace::Data);
    for (int i = 0; i < 64; ++i) {  // level 0: both lobes are the same
        EXPECT_NEAR(a.at(i, i, 0), b.at(i, i, 0), 0.003f);
        EXPECT_NEAR(a.at(i, i, 1), b.at(i, i, 1), 0.003f);
        EXPECT_NEAR(a.at(i, i, 2), r.at(i, i, 0), 0.003f);
        EXPECT_NEAR(a.at(i, i, 3), 0.5f, 0.003f);
    }
    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"--engine", "unreal", "--quality", "quick"},
          std::vector<std::string>{"--engine", "unreal", "--quality", "full", "--format", "png"}}) {
        std::vector<std::string> command{"texture", "build", "in", "--lobes", "2", "-o", "wrong"};
        command.insert(command.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run(command, place).exit_code, 2);
    }
}

// A scene gets them as an extension, from the one rule that fits them, for readers that know KTX2.
TEST(TextureBuild, TwoLobesOfASceneAskForTheirRule)
{
    const Workplace place("build-scene-lobes");
    std::ofstream(place / "in.gltf") << R"({"asset": {"version": "2.0"}})";
    const auto built = [&](const std::vector<std::string>& more) {
        std::vector<std::string> command{"texture", "build", "in.gltf", "-o", "out.gltf", "--lobes", "2"};
        command.insert(command.end(), more.begin(), more.end());
        return run(command, place).exit_code;
    };
    EXPECT_EQ(built({"--quality", "full"}), 0);
    EXPECT_EQ(built({}), 2);
    EXPECT_EQ(built({"--quality", "quick"}), 2);
    EXPECT_EQ(built({"--quality", "full", "--rule", "median"}), 2);
    EXPECT_EQ(built({"--quality", "full", "--fallback"}), 2);
}

// A leaf, green where its own opacity map says so and black elsewhere.
TEST(TextureBuild, AnOpacityMapKeepsBlackOutOfTheLevels)
{
    const Workplace place("petrichor-build-leaf");
    Image color(32, 32, 3, ColorSpace::Linear), opacity(32, 32, 1, ColorSpace::Data);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            if ((x / 3 + y / 3) % 3 == 0) continue;
            opacity.at(x, y, 0) = 1.0f;
            color.at(x, y, 1) = 0.5f;
        }
    }
    texproc::write_image(place / "Leaf_Color.png", color);
    texproc::write_image(place / "Leaf_Opacity.png", opacity);
    const std::string recipe =
        "name = \"Leaf\"\n[inputs]\nalbedo = \"Leaf_Color.png\"\n"
        "opacity = \"Leaf_Opacity.png\"\n[[output]]\n"
        "file = \"{name}\"\nchannels = [\"albedo.r\", \"albedo.g\", "
        "\"albedo.b\", \"opacity\"]\nsrgb = true\nlevel_files = true\n";
    const auto green_of_level_2 = [&](const std::string& more) {
        write_file(place / "leaf.toml", recipe + more);
        const Outcome made = run({"texture", "build", "leaf.toml", "-o", "out"}, place);
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return texproc::read_image(place / "out/Leaf_2.png", {.space = ColorSpace::Linear});
    };
    const Image weighted = green_of_level_2("");
    for (std::size_t i = 0; i < weighted.pixels.size(); i += 4) {
        EXPECT_NEAR(weighted.pixels[i + 1], 0.5f, 0.005f);
    }
    const Image plain = green_of_level_2("[mips]\nalpha_weighted = false\n");
    EXPECT_LT(plain.pixels[1], 0.45f);
}

}  // namespace
}  // namespace petrichor::cli
