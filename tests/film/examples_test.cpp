// The examples in data/scenarios: what they say of materials, seen on small scenes.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "film/scenario/material_keys.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::film {
namespace {

namespace fs = std::filesystem;
using gpu::aov;
using gpu::luminance;
using gpu::pixel;

class Examples : public gpu::GpuTest {
protected:
    static Scenario example(const char* name)
    {
        return read_scenario(fs::path(PETRICHOR_SOURCE_DIR) / "data/scenarios" / name);
    }
    /// A scene whose only material has this name, as the example has it, or as it is without.
    static scene::Scene with(std::vector<scene::Primitive> primitives, const std::string& material,
                             const Scenario* scenario)
    {
        scene::Material m = gpu::plain_material(glm::vec3(0.2f, 0.5f, 0.1f), 0.7f);
        m.name = material;
        scene::Scene scene = gpu::scene_of(std::move(primitives), {m});
        if (scenario) apply_material_overrides(scenario->materials, scenario->folder, scene);
        return scene;
    }
};

TEST_F(Examples, AreAllRead)
{
    int count = 0;
    for (const auto& file : fs::directory_iterator(fs::path(PETRICHOR_SOURCE_DIR) / "data/scenarios")) {
        EXPECT_NO_THROW(read_scenario(file.path())) << file.path();
        ++count;
    }
    EXPECT_GE(count, 2);
}

// A leaf between the eye and the sun: lit through, from either side.
TEST_F(Examples, LeavesLetLightThroughFromBothSides)
{
    const Scenario windy = example("windy-street.toml");
    const auto leaf = gpu::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    gpu::Frame frame;
    frame.settings.width = frame.settings.height = 24;
    frame.settings.samples = 1;
    frame.settings.exposure = 1.0f;
    frame.settings.image_based_light = false;
    frame.settings.aovs = {"depth"};
    frame.sky.sun_elevation_rad = 0.4f;
    for (const float side : {1.0f, -1.0f}) {
        frame.camera = gpu::look({0, 0, 3.0f * side}, {0, 0, 0}, 0.5f);
        frame.sky.sun_azimuth_rad = side > 0 ? 0.0f : 3.14159265f;  // behind the leaf
        renderer->load(with({leaf}, "plants", nullptr), {});
        const float plain = luminance(pixel(renderer->render(frame), 12, 12));
        renderer->load(with({leaf}, "plants", &windy), {});
        const gpu::RenderResult seen = renderer->render(frame);
        EXPECT_TRUE(std::isfinite(aov(seen, "depth", 12, 12))) << "both sides are drawn";
        EXPECT_GT(luminance(pixel(seen, 12, 12)), 100.0f) << side;
        if (side > 0) {
            EXPECT_LT(plain, 0.2f * luminance(pixel(seen, 12, 12)));
        }
    }
}

TEST_F(Examples, LeavesFlutterInTheWind)
{
    const Scenario windy = example("windy-street.toml");
    renderer->load(with({gpu::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, "plants", &windy), {});
    gpu::Frame frame;
    frame.camera = gpu::look({0, 0, 3}, {0, 0, 0}, 0.9f);
    frame.settings.width = frame.settings.height = 96;
    frame.settings.samples = 1;
    const auto calm = renderer->render(frame).beauty;
    frame.weather.wind_m_s = {9.0f, 0.0f};
    const auto first = renderer->render(frame).beauty;
    frame.settings.time_s = 0.1;
    const auto later = renderer->render(frame).beauty;
    EXPECT_NE(first, calm);
    EXPECT_NE(first, later);
}

// Snow on blades goes by their colour, not by their slope: it lies on what stands upright.
TEST_F(Examples, SnowLiesOnUprightBlades)
{
    const Scenario windy = example("windy-street.toml");
    gpu::Frame frame;
    frame.camera = gpu::look({0, 0, 3}, {0, 0, 0}, 0.5f);
    frame.settings.width = frame.settings.height = 24;
    frame.settings.samples = 1;
    frame.settings.aovs = {"snow"};
    frame.weather.snow_amount = 1.0f;
    const auto snow = [&](const Scenario* scenario) {
        renderer->load(with({gpu::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}, "plants", scenario), {});
        return aov(renderer->render(frame), "snow", 12, 12);
    };
    EXPECT_GT(snow(&windy), snow(nullptr) + 0.2f);
}

// A level plate under a high sun: the highlight of brushed metal is longer across the brush.
TEST_F(Examples, BrushedZincStretchesHighlights)
{
    const Scenario windy = example("windy-street.toml");
    scene::Scene scene = with({gpu::quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8})}, "galvanised zinc", &windy);
    scene.materials[0].metallic = 1.0f;
    scene.materials[0].roughness = 0.45f;
    gpu::Frame frame;
    frame.camera = gpu::look({0, 3, 0}, {0, 0, 0}, 1.6f);
    frame.settings.width = frame.settings.height = 65;
    frame.settings.samples = 1;
    frame.settings.exposure = 1.0f;
    frame.settings.image_based_light = false;
    frame.sky.sun_elevation_rad = 1.5707963f;
    const auto lengths = [&](float strength) {
        scene.materials[0].anisotropy = strength;
        renderer->load(scene, {});
        const gpu::RenderResult r = renderer->render(frame);
        const float half = 0.5f * luminance(pixel(r, 32, 32));
        int across = 0, down = 0;
        for (int i = 0; i < 65; ++i) {
            across += luminance(pixel(r, i, 32)) > half ? 1 : 0;
            down += luminance(pixel(r, 32, i)) > half ? 1 : 0;
        }
        return std::pair(across, down);
    };
    const auto [round_across, round_down] = lengths(0.0f);
    EXPECT_NEAR(round_across, round_down, 1);
    const float strength = [&] {
        scene::Scene again = with({}, "galvanised zinc", &windy);
        return again.materials[0].anisotropy;
    }();
    EXPECT_FLOAT_EQ(strength, 0.75f);
    const auto [across, down] = lengths(strength);
    EXPECT_GT(std::max(across, down), 1.4f * static_cast<float>(std::min(across, down)));
}

}  // namespace
}  // namespace petrichor::film
