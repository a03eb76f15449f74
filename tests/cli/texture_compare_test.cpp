// compare, inspect and bench from outside: what they tell people and machines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "film/frames/film.h"
#include "tests/cli/texture_inputs.h"
#include "tests/support/program.h"
#include "texproc/generate/generate.h"

namespace petrichor::cli {
namespace {

using testing::HasSubstr;
using namespace testing_program;
using namespace testing_texture;
namespace fs = std::filesystem;
using nlohmann::json;

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

}  // namespace
}  // namespace petrichor::cli
