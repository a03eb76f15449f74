// Rain, snow and the glow of lamps in the picture.
#include <algorithm>
#include <cmath>

#include "formulas/light/lamp_glow.h"
#include "scene/drips/drip_points.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using FallingTest = GpuTest;

// A dark wall 12 m away under an overcast sky, clear air.
Scene wall(float distance_m = 12.0f)
{
    return scene_of({quad({-40, -20, -distance_m}, {80, 0, 0}, {0, 40, 0}),
                     quad({-40, -1.6f, 10}, {80, 0, 0}, {0, 0, -60})},
                    {plain_material(glm::vec3(0.04f))});
}

Frame downpour()
{
    Frame frame;
    frame.camera = look({0, 0, 0}, {0, 0, -1}, 0.65f);
    frame.sky.cloud_cover = 1.0f;
    frame.weather.rain_kg_m2_s = 30.0f / 3600.0f;
    frame.weather.rain = 0.0f;  // the ground stays dry: only the air is looked at
    frame.weather.visibility_m = 1e9f;
    frame.weather.wind_m_s = {3.0f, 0.0f};
    frame.falling.air_m = {1.0, 0.0};
    FrameSettings& s = frame.settings;
    s.width = 256;
    s.height = 144;
    s.samples = 2;
    s.time_s = 1.0;
    s.exposure = 1e-4f;
    return frame;
}

int changed_pixels(const RenderResult& a, const RenderResult& b)
{
    int count = 0;
    for (std::size_t i = 0; i < a.beauty.size(); i += 4)
        count += !std::equal(&a.beauty[i], &a.beauty[i] + 3, &b.beauty[i]);
    return count;
}

RenderResult without(Renderer& renderer, Frame frame)
{
    frame.settings.falling = false;
    return renderer.render(frame);
}

TEST_F(FallingTest, RainIsSeenBeforeAWallAndLabelsDoNotSeeIt)
{
    renderer->load(wall(), {});
    Frame frame = downpour();
    frame.settings.aovs = {"depth", "normal"};
    const RenderResult dry = without(*renderer, frame);
    const RenderResult wet = renderer->render(frame);
    EXPECT_GT(wet.falling.drawn, 1000u);
    EXPECT_EQ(dry.falling.drawn, 0u);
    EXPECT_GT(changed_pixels(wet, dry), 256 * 144 / 20);
    for (std::size_t i = 3; i < wet.beauty.size(); i += 4)
        ASSERT_EQ(wet.beauty[i], dry.beauty[i]) << "alpha counts surfaces";
    EXPECT_EQ(wet.aovs[0].pixels, dry.aovs[0].pixels);
    EXPECT_EQ(wet.aovs[1].pixels, dry.aovs[1].pixels);
    // Drops show the sky before a dark wall: brighter, and not all alike.
    double more = 0.0;
    double most = 0.0;
    for (int y = 0; y < 144; ++y) {
        for (int x = 0; x < 256; ++x) {
            const auto d = static_cast<double>(pixel(wet, x, y).g - pixel(dry, x, y).g);
            more += d;
            most = std::max(most, d);
        }
    }
    EXPECT_GT(more, 0.0);
    EXPECT_GT(most, 8.0 * more / (256 * 144));
}

TEST_F(FallingTest, AFrameAloneIsTheFrameOfARun)
{
    renderer->load(wall(), {});
    Frame frame = downpour();
    frame.weather.snowfall_kg_m2_s = 1.0f / 3600.0f;
    const RenderResult alone = renderer->render(frame);
    for (int i = 0; i < 3; ++i) {
        Frame other = downpour();
        other.settings.time_s = 0.3 * i;
        other.falling.air_m.x = 2.0 * i;
        other.falling.budget = 400 * (i + 1);
        renderer->render(other);
    }
    EXPECT_EQ(renderer->render(frame).beauty, alone.beauty);
    frame.settings.time_s += 1.0 / 24.0;
    EXPECT_GT(changed_pixels(renderer->render(frame), alone), 1000);
}

TEST_F(FallingTest, NothingFallsUnderARoof)
{
    Scene scene = wall();
    scene.meshes[0].primitives.push_back(quad({-40, 4, 20}, {80, 0, 0}, {0, 0, -60}));
    renderer->load(scene, {});
    Frame frame = downpour();
    frame.weather.wind_m_s = {0.0f, 0.0f};
    const RenderResult under = renderer->render(frame);
    EXPECT_GT(under.falling.drawn, 1000u);
    EXPECT_EQ(changed_pixels(under, without(*renderer, frame)), 0);
    frame.settings.shelter = false;
    EXPECT_GT(changed_pixels(renderer->render(frame), under), 1000) << "roofs are let through";
}

// An edge right before the wall, 2 m up, under a roof that keeps all rain off.
TEST_F(FallingTest, DropsComeOffEdgesWhileAndAfterItRains)
{
    Scene scene = wall(6.0f);
    scene.meshes[0].primitives.push_back(quad({-40, 4, 20}, {80, 0, 0}, {0, 0, -60}));
    renderer->load(scene, {});
    auto points = std::make_shared<std::vector<scene::DripPoint>>();
    for (std::uint32_t i = 0; i < 100; ++i)
        points->push_back({{-2.0f + 0.04f * static_cast<float>(i), 1.5f, -4.0f}, -1.6f, 0.3f, i * 7919u});
    Frame frame = downpour();
    frame.weather.film_mm = 1.0f;
    const RenderResult none = without(*renderer, frame);
    EXPECT_EQ(changed_pixels(renderer->render(frame), none), 0) << "no edges yet, and a roof";
    renderer->set_drips(points);
    const RenderResult raining = renderer->render(frame);
    EXPECT_GT(changed_pixels(raining, none), 300);
    EXPECT_EQ(changed_pixels(without(*renderer, frame), none), 0);
    frame.settings.time_s = 9.0;
    renderer->render(frame);
    frame.settings.time_s = 1.0;
    EXPECT_EQ(renderer->render(frame).beauty, raining.beauty) << "whatever was drawn before";
    Frame after = frame;
    after.weather.rain_kg_m2_s = 0.0f;
    EXPECT_GT(changed_pixels(renderer->render(after), without(*renderer, after)), 50);
    after.weather.film_mm = 0.0f;
    EXPECT_EQ(changed_pixels(renderer->render(after), without(*renderer, after)), 0) << "dry";
    renderer->load(scene, {});
    EXPECT_EQ(changed_pixels(renderer->render(frame), none), 0) << "another scene has edges of its own";
}

TEST_F(FallingTest, WhatIsBehindASurfaceIsHidden)
{
    renderer->load(wall(0.29f), {});
    const RenderResult covered = renderer->render(downpour());
    EXPECT_EQ(changed_pixels(covered, without(*renderer, downpour())), 0);
}

TEST_F(FallingTest, TheBudgetBoundsWhatIsDrawn)
{
    renderer->load(wall(), {});
    Frame frame = downpour();
    frame.falling.budget = 0;
    EXPECT_EQ(changed_pixels(renderer->render(frame), without(*renderer, frame)), 0);
    frame.falling.budget = 200;
    const std::uint32_t few = renderer->render(frame).falling.drawn;
    EXPECT_GT(few, 100u);
    EXPECT_LT(few, 320u);
}

// Where much is drawn the air dims less: the two together are what the visibility says.
TEST_F(FallingTest, DrawnDropsAreNoHaze)
{
    renderer->load(wall(), {});
    Frame frame = downpour();
    frame.weather.snowfall_kg_m2_s = 4.0f / 3600.0f;
    frame.weather.rain_kg_m2_s = 0.0f;
    frame.weather.air_temperature_k = 263.0f;
    frame.weather.visibility_m = 200.0f;
    const auto mean = [&](int budget) {
        frame.falling.budget = budget;
        const RenderResult r = renderer->render(frame);
        double sum = 0.0;
        for (int y = 0; y < 60; ++y) {
            for (int x = 0; x < 256; ++x) sum += static_cast<double>(pixel(r, x, y).g);
        }
        return sum;
    };
    const RenderResult bare = without(*renderer, frame);
    const double haze = mean(0);
    frame.settings.falling = false;
    frame.fog.mode = FogMode::Off;
    const double clear = mean(0);
    frame.settings.falling = true;
    frame.fog.mode = FogMode::Metres;
    const double flakes = mean(20000);
    // Flakes are not as bright as the horizon: about, not exactly.
    EXPECT_GT(haze, 1.2 * clear);
    EXPECT_NEAR((flakes - clear) / (haze - clear), 1.0, 0.4);
}

TEST_F(FallingTest, LampsLightTheRainAroundThem)
{
    Scene scene = wall();
    Light lamp;
    lamp.position_m = {0, 0.8f, -6};
    lamp.intensity = 400.0f;
    scene.lights.push_back(lamp);
    renderer->load(scene, {});
    Frame frame = downpour();
    frame.sky.sun_elevation_rad = -0.6f;
    frame.settings.exposure = 1.0f;
    const RenderResult dark = without(*renderer, frame);
    const RenderResult rain = renderer->render(frame);
    double near = 0.0, far = 0.0;
    for (int y = 0; y < 144; ++y) {
        for (int x = 0; x < 256; ++x) {
            const auto more = static_cast<double>(pixel(rain, x, y).g - pixel(dark, x, y).g);
            double& most = std::abs(x - 128) < 40 ? near : far;
            if (std::abs(x - 128) < 40 || std::abs(x - 128) > 90) most = std::max(most, more);
        }
    }
    EXPECT_GT(near, 3.0 * far);
}

// Where rain hits level ground near the camera it throws up crowns; not below a roof, not on snow's way.
TEST_F(FallingTest, DropsSplashWhereTheyHit)
{
    Scene scene = wall(30.0f);
    renderer->load(scene, {});
    Frame frame = downpour();
    frame.camera = look({0, 0, 0}, {0, -0.8f, -1.8f}, 0.65f);
    frame.weather.wind_m_s = {0.0f, 0.0f};
    frame.falling.budget = 1;  // hardly a drop in the air
    const RenderResult with = renderer->render(frame);
    const int splashed = changed_pixels(with, without(*renderer, frame));
    EXPECT_GT(splashed, 100);
    frame.falling.density = 0.1f;
    EXPECT_LT(changed_pixels(renderer->render(frame), without(*renderer, frame)), splashed / 4);
    frame.falling.density = 1.0f;
    frame.weather.snowfall_kg_m2_s = frame.weather.rain_kg_m2_s;
    frame.weather.air_temperature_k = 260.0f;
    frame.weather.rain_kg_m2_s = 0.0f;
    EXPECT_LT(changed_pixels(renderer->render(frame), without(*renderer, frame)), splashed / 10);
    scene.meshes[0].primitives.push_back(quad({-40, 4, 20}, {80, 0, 0}, {0, 0, -60}));
    renderer->load(scene, {});
    frame = downpour();
    frame.camera = look({0, 0, 0}, {0, -0.8f, -1.8f}, 0.65f);
    frame.weather.wind_m_s = {0.0f, 0.0f};
    EXPECT_EQ(changed_pixels(renderer->render(frame), without(*renderer, frame)), 0);
}

// The glow of a lamp beside the picture of it, by the closed form.
TEST_F(FallingTest, AirGlowsAroundALampAsTheClosedFormSays)
{
    Scene scene = wall(60.0f);
    scene.materials[0].base_color = glm::vec4(0, 0, 0, 1);
    Light lamp;
    lamp.position_m = {0, 0, -20};
    lamp.intensity = 1000.0f;
    scene.lights.push_back(lamp);
    renderer->load(scene, {});
    Frame frame = downpour();
    frame.weather.rain_kg_m2_s = 0.0f;
    frame.weather.visibility_m = 195.6f;
    frame.fog.height_m = 0.0f;
    frame.sky.sun_elevation_rad = -1.2f;
    const RenderResult with = renderer->render(frame);
    frame.settings.lamp_glow = false;
    const RenderResult bare = renderer->render(frame);
    // 0.02 1/m less what a clear day has.
    const float per_m = 0.02f - 3.912f / 20000.0f;
    const float focal_px = 72.0f / std::tan(0.325f);
    for (const int x : {88, 120, 138, 170, 230}) {
        const float aside = (static_cast<float>(x) + 0.5f - 128.0f) / focal_px;
        const float angle = std::atan(std::abs(aside));
        const float end = 60.0f * std::sqrt(1.0f + aside * aside);
        const shared::GlowRay ray =
            shared::glow_ray(per_m, 20.0f * std::cos(angle), 20.0f * std::sin(angle), end);
        const float expected =
            1000.0f * (ray.begin * shared::glow_tail(ray.u, ray.begin_v) -
                       ray.end * shared::glow_tail(ray.u, ray.end_v));
        const float got = pixel(with, x, 72).g - pixel(bare, x, 72).g;
        EXPECT_NEAR(got, expected, 0.06f * expected) << x;
    }
    frame.settings.lamp_glow = true;
    frame.weather.visibility_m = 20000.0f;
    const RenderResult clear = renderer->render(frame);
    frame.settings.lamp_glow = false;
    EXPECT_EQ(changed_pixels(clear, renderer->render(frame)), 0) << "a clear day has none";
}

}  // namespace
}  // namespace petrichor::gpu
