// Clouds that bring rain look like it, and light the land as those that do not.
#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using RainClouds = GpuTest;

float luminance_at(const RenderResult& r, int x, int y)
{
    const std::size_t i = (static_cast<std::size_t>(y) * static_cast<std::size_t>(r.width) + static_cast<std::size_t>(x)) * 4;
    return 0.2126f * glm::unpackHalf1x16(r.beauty[i]) + 0.7152f * glm::unpackHalf1x16(r.beauty[i + 1]) +
           0.0722f * glm::unpackHalf1x16(r.beauty[i + 2]);
}

Frame up_into_the_sky(float rain, float time_s)
{
    Frame frame;
    frame.camera = look({0, 1.7f, 0}, {0, 9.7f, -10}, 1.0f);
    frame.sky.sun_elevation_rad = 0.6f;
    frame.sky.cloud_cover = 1.0f;
    frame.weather.rain = rain;
    frame.weather.wind_m_s = {12.0f, 5.0f};
    frame.weather.visibility_m = 50000.0f;
    frame.settings.time_s = static_cast<double>(time_s);
    frame.settings.falling = false;
    frame.settings.width = 96;
    frame.settings.height = 64;
    frame.settings.samples = 1;
    return frame;
}

Scene small_ground()
{
    return scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2})}, {plain_material(glm::vec3(0.2f), 1.0f)});
}

TEST_F(RainClouds, LightTheGroundAsDryOnes)
{
    renderer->load(small_ground(), {});
    for (const float time_s : {0.0f, 90.0f, 400.0f, 1700.0f}) {
        // The exposure of a frame that is given none follows from the light on level ground alone.
        const float dry = renderer->render(up_into_the_sky(0.0f, time_s)).exposure;
        for (const float rain : {0.3f, 1.0f})
            EXPECT_NEAR(renderer->render(up_into_the_sky(rain, time_s)).exposure / dry, 1.0f, 0.03f) << time_s << " " << rain;
    }
}

TEST_F(RainClouds, AreDarkBelowWithLightBetween)
{
    renderer->load(small_ground(), {});
    struct Range {
        float low, high;
    };
    const auto range = [&](float rain) {
        const RenderResult r = renderer->render(up_into_the_sky(rain, 0.0f));
        std::vector<float> seen;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 96; ++x) seen.push_back(luminance_at(r, x, y));
        std::sort(seen.begin(), seen.end());
        return Range{seen[seen.size() / 20], seen[seen.size() - seen.size() / 20]};
    };
    const Range dry = range(0.0f), wet = range(1.0f);
    EXPECT_LT(wet.low, 0.8f * dry.low);
    EXPECT_GT(wet.high / wet.low, 1.5f * dry.high / dry.low);
}

// A strip over the horizon, seen from open land through a cloudburst's own air.
TEST_F(RainClouds, AreSeenLowOverOpenLand)
{
    renderer->load(small_ground(), {});
    const auto contrast = [&](float rain) {
        std::vector<float> seen;
        for (const float turned : {0.0f, 2.1f, 4.2f}) {
            Frame frame = up_into_the_sky(rain, 0.0f);
            frame.camera = look({0, 1.7f, 0}, {10 * std::sin(turned), 2.7f, -10 * std::cos(turned)}, 1.0f);
            frame.weather.rain_kg_m2_s = rain * 7.0f / 3600.0f;
            frame.weather.visibility_m = 3800.0f;
            const RenderResult r = renderer->render(frame);
            for (int y = 20; y < 36; ++y)
                for (int x = 0; x < 96; ++x) seen.push_back(luminance_at(r, x, y));
        }
        std::sort(seen.begin(), seen.end());
        return seen[seen.size() - seen.size() / 20] / seen[seen.size() / 20];
    };
    EXPECT_GT(contrast(0.5f), 1.6f);
    EXPECT_LT(contrast(0.0f), 1.3f);
}

// Where no cloud is, rain changes nothing of the sky.
TEST_F(RainClouds, AreNoneInAClearSky)
{
    renderer->load(small_ground(), {});
    Frame dry = up_into_the_sky(0.0f, 0.0f), wet = up_into_the_sky(1.0f, 0.0f);
    dry.sky.cloud_cover = wet.sky.cloud_cover = 0.0f;
    EXPECT_EQ(renderer->render(dry).beauty, renderer->render(wet).beauty);
}

}  // namespace
}  // namespace petrichor::gpu
