// petrichor scene: its report, its pictures, what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.h"
#include "texproc/codecs/files/io.h"

namespace petrichor {
namespace {

using testing_program::Outcome;
using testing_program::run_petrichor;
using testing_program::Workplace;

struct SceneCommand : testing::Test {
    SceneCommand() : place("scene_command")
    {
        testing_program::write_file(place / "tiny.glb", testing_program::tiny_scene_glb());
    }
    Outcome run(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "scene");
        const std::string cache = "PETRICHOR_CACHE=" + (place / "cache").string();
        return run_petrichor({.arguments = arguments, .environment = {cache}}, place.path());
    }
    Workplace place;
};

TEST_F(SceneCommand, SaysWhatItSees)
{
    const Outcome cold = run({"tiny.glb", "--json"});
    ASSERT_EQ(cold.exit_code, 0) << cold.err;
    const auto first = nlohmann::json::parse(cold.out);
    EXPECT_GT(first["triangles"].get<int>(), 0);
    EXPECT_GT(first["patches"]["count"].get<int>(), 0);
    EXPECT_TRUE(first["ground"].is_object());
    EXPECT_FALSE(first["kept"].get<bool>());
    auto warm = nlohmann::json::parse(run({"tiny.glb", "--json", "--threads", "1"}).out);
    EXPECT_TRUE(warm["kept"].get<bool>());
    EXPECT_EQ(warm["patches"], first["patches"]);
    const Outcome words = run({"tiny.glb"});
    EXPECT_NE(words.out.find("ground"), std::string::npos);
    EXPECT_NE(words.out.find("found in the cache"), std::string::npos);
}

// A tiny scene whose text ends in blanks.
std::string long_file(std::size_t blanks)
{
    std::string glb = testing_program::tiny_scene_glb();
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, &glb[at], sizeof value);
        return value;
    };
    const auto add = [&](std::size_t at) {
        const std::uint32_t value = number(at) + static_cast<std::uint32_t>(blanks);
        std::memcpy(&glb[at], &value, sizeof value);
    };
    const std::size_t end = 20 + std::size_t{number(12)};
    add(8);
    add(12);
    return glb.insert(end, blanks, ' ');
}

TEST_F(SceneCommand, ALargeFileIsSaidBeforeItIsRead)
{
    testing_program::write_file(place / "large.glb", long_file(std::size_t{33} << 20));
    const Outcome large = run({"large.glb"});
    ASSERT_EQ(large.exit_code, 0) << large.err;
    EXPECT_EQ(large.err.find("info scene: reading 33 MiB"), 0u) << large.err;
    EXPECT_EQ(run({"large.glb", "--json"}).err.find("reading"), std::string::npos);
    EXPECT_EQ(run({"tiny.glb"}).err.find("reading"), std::string::npos);
    EXPECT_NE(run({"tiny.glb", "--fresh"}).err.find("info scene: what is close"), std::string::npos);
}

TEST_F(SceneCommand, WritesADemoSceneForOtherPrograms)
{
    const Outcome written = run({"demo:stage", "--glb", "stage.glb"});
    ASSERT_EQ(written.exit_code, 0) << written.err;
    const auto told = nlohmann::json::parse(run({"demo:stage", "--json"}).out);
    const auto read = nlohmann::json::parse(run({"stage.glb", "--json"}).out);
    EXPECT_EQ(read["triangles"], told["triangles"]);
    EXPECT_EQ(read["patches"]["count"], told["patches"]["count"]);
    const std::vector<std::vector<std::string>> mistakes{{"tiny.glb", "--glb", "copy.glb"}, {"demo:stage", "--glb", "stage.txt"},
                                                         {"demo:stage", "--glb", "copy.glb", "--json"}};
    for (const auto& mistake : mistakes) {
        EXPECT_EQ(run(mistake).exit_code, 2) << mistake[2];
        EXPECT_FALSE(std::filesystem::exists(place / mistake[2])) << mistake[2];
    }
}

TEST_F(SceneCommand, HollowsAreCountedAndDrawn)
{
    const Outcome full = run({"tiny.glb", "--json", "--map", "basins", "-o", "full.png"});
    ASSERT_EQ(full.exit_code, 0) << full.err;
    const auto json = nlohmann::json::parse(full.out);
    EXPECT_GE(json["hollows"]["capacity_m3"].get<double>(), 0.0);
    const Image image = texproc::read_image(place / "full.png");
    EXPECT_EQ(image.width, json["hollows"]["cells"][0].get<int>());
    EXPECT_EQ(run({"tiny.glb", "--map", "basins", "--rain-mm", "5", "-o", "wet.png"}).exit_code, 0);
    const Outcome refused = run({"tiny.glb", "--map", "sky", "--rain-mm", "5", "-o", "sky.png"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("--map basins"), std::string::npos);
}

TEST_F(SceneCommand, DrawsEveryMap)
{
    std::vector<std::string> seen;
    for (const std::string map : {"sky", "rain", "sun", "patches", "lights"}) {
        const Outcome done = run({"tiny.glb", "--map", map, "-o", map + ".png", "--size", "160x90"});
        ASSERT_EQ(done.exit_code, 0) << done.err;
        const Image image = texproc::read_image(place / (map + ".png"));
        EXPECT_EQ(image.width, 160);
        EXPECT_GT(image.height, 90) << "a legend below";
        seen.push_back(testing_program::read_file(place / (map + ".png")));
        for (std::size_t i = 0; i + 1 < seen.size(); ++i) EXPECT_NE(seen[i], seen.back());
        run({"tiny.glb", "--map", map, "-o", "again.png", "--size", "160x90", "--threads", "1",
             "--fresh"});
        EXPECT_EQ(testing_program::read_file(place / "again.png"), seen.back()) << map;
    }
}

// Yellow lines over the picture, where lamps are; other maps have none.
TEST_F(SceneCommand, DrawsTheShapesOfLamps)
{
    const auto yellow = [&](const std::string& map) {
        const std::string file = map + "_stage.png";
        const Outcome done = run({"demo:stage", "--map", map, "-o", file, "--size", "240x135", "--cell", "1",
                                  "--rays", "16"});
        EXPECT_EQ(done.exit_code, 0) << done.err;
        const Image image = texproc::read_image(place / file);
        int count = 0;
        for (int i = 0; i < image.width * 135; ++i) {
            const float* p = image.pixels.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(image.channels);
            count += p[0] > 2.0f * p[2] && p[1] > 1.6f * p[2] && p[0] > 0.5f ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(yellow("lights"), 100);
    EXPECT_EQ(yellow("sky"), 0);
}

// From the scene to its light maps and from them to the picture: light that was baked twice as strong
// is twice as strong.
TEST_F(SceneCommand, BakesLightMapsThatLightThePicture)
{
    std::vector<float> seen;
    for (const std::string lux : {"10000", "20000"}) {
        const std::string folder = "maps" + lux;
        const Outcome done = run({"tiny.glb", "--bake", "light_map", "-o", folder, "--map-size", "32",
                                  "--gather", "64", "--sky-lux", lux});
        ASSERT_EQ(done.exit_code, 0) << done.err;
        EXPECT_NE(done.out.find("several surfaces"), std::string::npos)
            << "floor and wall lie over each other: " << done.out;
        const std::string keys = testing_program::read_file(place / (folder + "/light_maps.toml"));
        ASSERT_NE(keys.find("[materials.\"stone\"]"), std::string::npos) << keys;
        testing_program::write_file(
            place / (folder + "/s.toml"),
            "[scene]\nfile = \"../tiny.glb\"\n[sun]\nsource = \"scene\"\n"
            "[render]\nimage_based_light = false\nshadows = false\ndraw_sky = false\n"
            "[output]\nwidth = 48\nheight = 32\nsamples = 1\nframes = 1\n" +
                keys);
        const Outcome drawn = run_petrichor(
            {.arguments = {"render", folder + "/s.toml", "-o", folder + "/out"}}, place.path());
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        double sum = 0.0;
        for (const auto& file : std::filesystem::directory_iterator(place / (folder + "/out"))) {
            if (file.path().extension() != ".exr") continue;
            for (const float v : texproc::read_image(file.path()).pixels)
                sum += std::isfinite(v) && v != 1.0f ? static_cast<double>(v) : 0.0;
        }
        seen.push_back(static_cast<float>(sum));
    }
    EXPECT_GT(seen[0], 0.0f);
    EXPECT_NEAR(seen[1] / seen[0], 2.0f, 0.02f);
}

TEST_F(SceneCommand, RefusesWhatItCannotDo)
{
    const struct {
        std::vector<std::string> arguments;
        const char* says;
    } cases[] = {
        {{"none.glb"}, "none.glb"},
        {{"demo:stret"}, "demo:street"},
        {{"tiny.glb", "--map", "skye", "-o", "x.png"}, "sky"},
        {{"tiny.glb", "--map", "sky"}, "-o"},
        {{"tiny.glb", "--map", "sky", "-o", "x.exr"}, ".png"},
        {{"tiny.glb", "-o", "x.png"}, "--map"},
        {{"tiny.glb", "--rays", "3"}, "--rays"},
        {{"tiny.glb", "--bake", "light_map"}, "-o"},
        {{"tiny.glb", "--bake", "lightmap", "-o", "x.png"}, "light_map"},
        {{"tiny.glb", "--bake", "indirect", "-o", "x.png", "--map", "sky"}, "--map"},
        {{"tiny.glb", "--snow", "0.5"}, "--bake"},
        {{"tiny.glb", "--bake", "light_map", "-o", "x.png", "--sky-lux", "-1"}, "--sky-lux"},
        {{"tiny.glb", "--size", "0x4", "--map", "sky", "-o", "x.png"}, "0x4"},
        {{"tiny.glb", "--camera", "nobody", "--map", "sky", "-o", "x.png"}, "nobody"},
    };
    for (const auto& c : cases) {
        const Outcome done = run(c.arguments);
        EXPECT_EQ(done.exit_code, 2) << c.arguments.back();
        EXPECT_NE(done.err.find(c.says), std::string::npos) << done.err;
        EXPECT_FALSE(std::filesystem::exists(place / "x.png"));
    }
}

}  // namespace
}  // namespace petrichor
