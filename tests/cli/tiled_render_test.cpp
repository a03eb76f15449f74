// A picture in tiles is the picture in one piece.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "glm/gtc/packing.hpp"
#include "tests/support/device.h"
#include "tests/support/program.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;
using namespace testing_program;

// What looks across the picture is off, but for what the lens does.
constexpr const char* kScenario = R"(
[scene]
file = "scene.glb"
[camera]
bloom = 0.2
wet_lens = 1.0
white_balance_k = 5000
[sun]
elevation_degrees = 30
[weather]
keys = [{ time_s = 0, temperature_c = 10, rainfall = 1.0 }, { time_s = 60, temperature_c = 10, rainfall = 1.0 }]
[render]
reflections = false
ambient_occlusion = false
[output]
width = 200
height = 150
samples = 2
frames = 4
film = false
aovs = ["depth", "wetness_mm"]
)";

class TiledRender : public testing::Test {
protected:
    TiledRender() : place_(std::string("tiled") + testing::UnitTest::GetInstance()->current_test_info()->name())
    {
        write_file(place_ / "scene.glb", tiny_scene_glb());
        write_file(place_ / "s.toml", kScenario);
    }
    void SetUp() override { (void)testing_device::device_is_there(); }
    Outcome render(std::vector<std::string> more)
    {
        more.insert(more.begin(), {"render", "s.toml", "--frames", "3"});
        return run_petrichor({.arguments = more, .environment = {}}, place_.path());
    }
    Workplace place_;
};

// Share of values that are more than `most` apart.
double apart(const texproc::RawImage& a, const texproc::RawImage& b, float most)
{
    if (a.width != b.width || a.height != b.height || a.channels != b.channels || a.type != b.type) return 1.0;
    const auto value = [](const texproc::RawImage& image, std::size_t i) {
        if (image.type == texproc::PixelType::U8) return static_cast<float>(image.bytes[i]);
        if (image.type == texproc::PixelType::F16) {
            std::uint16_t half = 0;
            std::memcpy(&half, &image.bytes[2 * i], 2);
            return glm::unpackHalf1x16(half);
        }
        float f = 0.0f;
        std::memcpy(&f, &image.bytes[4 * i], 4);
        return f;
    };
    std::size_t others = 0;
    for (std::size_t i = 0; i < a.values(); ++i) {
        const float x = value(a, i), y = value(b, i);
        const float scale = a.type == texproc::PixelType::U8 ? 1.0f : std::max(std::abs(x), 1.0f);
        others += x != y && !(std::abs(x - y) <= most * scale) ? 1 : 0;
    }
    return static_cast<double>(others) / static_cast<double>(a.values());
}

TEST_F(TiledRender, IsThePictureInOnePiece)
{
    ASSERT_EQ(render({"-o", "whole"}).exit_code, 0);
    const Outcome tiled = render({"-o", "tiled", "--tile", "64"});
    ASSERT_EQ(tiled.exit_code, 0) << tiled.err;
    for (const auto& entry : fs::directory_iterator(place_ / "tiled"))
        EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path() << " was left behind";
    const auto read = [&](const char* folder, const char* name) { return texproc::read_raw(place_ / folder / name); };
    // Samples at edges of things may fall on the other side.
    EXPECT_LT(apart(read("whole", "frame_0003.exr"), read("tiled", "frame_0003.exr"), 0.005f), 0.002);
    EXPECT_LT(apart(read("whole", "frame_0003.png"), read("tiled", "frame_0003.png"), 1.0f), 0.002);
    EXPECT_EQ(read("tiled", "frame_0003.exr").channel_names, read("whole", "frame_0003.exr").channel_names);
    auto a = nlohmann::json::parse(read_file(place_ / "whole" / "frames.jsonl"));
    auto b = nlohmann::json::parse(read_file(place_ / "tiled" / "frames.jsonl"));
    EXPECT_NE(a["settings"], b["settings"]);
    for (const char* key : {"exposure", "camera", "falling", "light", "weather", "ground", "width"})
        EXPECT_EQ(a.value(key, nlohmann::json()), b.value(key, nlohmann::json())) << key;
}

TEST_F(TiledRender, IsTheSameAgainAndIsKept)
{
    ASSERT_EQ(render({"-o", "a", "--tile", "96"}).exit_code, 0);
    ASSERT_EQ(render({"-o", "b", "--tile", "96", "--threads", "1"}).exit_code, 0);
    for (const char* name : {"frame_0003.exr", "frame_0003.png", "frames.jsonl"})
        EXPECT_EQ(read_file(place_ / "a" / name), read_file(place_ / "b" / name)) << name;
    const Outcome kept = render({"-o", "a", "--tile", "96", "--verify"});
    EXPECT_EQ(kept.exit_code, 0);
    EXPECT_NE(kept.err.find("1 kept"), std::string::npos) << kept.err;
    const Outcome whole = render({"-o", "a", "--resume"});
    EXPECT_NE(whole.err.find("output settings changed"), std::string::npos) << whole.err;
}

}  // namespace
}  // namespace petrichor::cli
