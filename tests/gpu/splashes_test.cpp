// Crowns of drops and the rings around them begin together.
#include "gpu/passes/falling/splashes.h"

#include <algorithm>
#include <cmath>

#include "formulas/weather/drop_births.h"
#include "formulas/weather/falling.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

using shared::FallingSplash;

FallingView above_ground()
{
    FallingView view;
    view.eye_m = {3.7f, 1.6f, -2.2f};
    view.focal_px = 700.0f;
    return view;
}

Frame raining(float rate_mm_h, float rain)
{
    Frame frame;
    frame.weather.rain_kg_m2_s = rate_mm_h / 3600.0f;
    frame.weather.rain = rain;
    frame.settings.time_s = 7.3;
    return frame;
}

std::vector<FallingSplash> splashes_of(const Frame& frame)
{
    FallingPlan plan;
    plan.drawn_reach_m = 20.0f;
    return falling_splashes(plan, frame, above_ground(), {});
}

// Whether the map of rings has a drop at a place of the world that has hit so long ago.
bool ring_begins(const Frame& frame, const glm::vec3& place, float age_s)
{
    for (int layer = 0; layer < shared::kRippleLayers; ++layer) {
        const auto rings = shared::ripple_layer(layer, frame.weather.rain, static_cast<float>(frame.settings.time_s), frame.look.ripple_speed);
        const glm::vec2 uv = glm::vec2(place.x, place.z) * frame.look.ripple_tiling + rings.offset;
        const glm::vec4 drop = shared::rain_drops(uv - glm::floor(uv), 0u);
        const float period_s = 1.0f / (shared::kRippleBirths_per_s * frame.look.ripple_speed * shared::ripple_rate(layer));
        const float since_s = glm::fract(drop.w + rings.clock) * period_s;
        if (rings.weight > 0.0f && drop.x > 0.99f && std::abs(since_s - age_s) < 2e-4f) return true;
    }
    return false;
}

TEST(Splashes, LargeDropsHitWhereRingsBegin)
{
    for (const auto& [rate, rain] : {std::pair{2.0f, 0.6f}, std::pair{25.0f, 1.0f}}) {
        for (const float tiling : {0.8f, 1.7f}) {
            Frame frame = raining(rate, rain);
            frame.look.ripple_tiling = tiling;
            frame.look.ripple_speed = 1.3f;
            std::size_t over_rings = 0, small = 0;
            float least = 1.0f, most = 0.0f;
            for (const FallingSplash& one : splashes_of(frame)) {
                if (one.diameter_m < 0.0f) {
                    ++over_rings;
                    least = std::min(least, -one.diameter_m);
                    EXPECT_TRUE(ring_begins(frame, one.above_m, one.age_s)) << one.above_m.x << " " << one.above_m.z;
                } else {
                    ++small;
                    most = std::max(most, one.diameter_m);
                }
            }
            EXPECT_GT(over_rings, 50u) << rate;
            if (small > 0) {
                EXPECT_LE(most, least + 1e-6f) << "those without rings are the smaller ones";
            }
        }
    }
}

TEST(Splashes, AreAsManyAsDropsHit)
{
    const auto mean_of = [](float rain) {
        double sum = 0.0;
        for (int i = 0; i < 40; ++i) {
            Frame frame = raining(10.0f, rain);
            frame.settings.time_s = 0.137 * i;
            sum += static_cast<double>(splashes_of(frame).size());
        }
        return sum / 40.0;
    };
    // Without rings they are of the other births alone.
    EXPECT_NEAR(mean_of(1.0f) / mean_of(0.0f), 1.0, 0.06);
    EXPECT_NEAR(mean_of(0.4f) / mean_of(0.0f), 1.0, 0.06);
}

TEST(Splashes, DoNotRepeatAsTheMapOfRingsDoes)
{
    Frame frame = raining(40.0f, 1.0f);
    const float repeat_m = 1.0f / frame.look.ripple_tiling;
    std::vector<glm::vec2> places;
    for (const FallingSplash& one : splashes_of(frame))
        if (one.diameter_m < 0.0f) places.emplace_back(one.above_m.x, one.above_m.z);
    ASSERT_GT(places.size(), 200u);
    double again = 0.0;
    for (const glm::vec2& p : places) {
        again += std::any_of(places.begin(), places.end(), [&](const glm::vec2& q) {
            return glm::distance(q, p + glm::vec2(0.0f, -repeat_m)) < 1e-3f;
        });
    }
    EXPECT_LT(again / static_cast<double>(places.size()), 0.6);
}

class SplashesPicture : public GpuTest {};

// Rain that a wind drives hits elsewhere than below the point that it passes: crowns stand over the rings all the same.
TEST_F(SplashesPicture, CrownsStandWhereTheRingsAre)
{
    renderer->load(scene_of({quad({-40, -1.2f, 10}, {80, 0, 0}, {0, 0, -60})}, {plain_material(glm::vec3(0.04f))}), {});
    Frame frame = raining(1.0f, 1.0f);
    frame.camera = look({0, 0, 0}, {0, -1.0f, -0.9f}, 0.7f);
    frame.sky.cloud_cover = 1.0f;
    frame.weather.wind_m_s = {6.0f, 2.0f};
    frame.falling.budget = 1;
    frame.falling.density = 1.0f;
    frame.settings.width = 320;
    frame.settings.height = 180;
    frame.settings.samples = 1;
    frame.settings.exposure = 1e-4f;
    frame.settings.aovs = {"position"};
    int changed = 0, near = 0;
    for (int i = 0; i < 6; ++i) {
        frame.settings.time_s = 1.0 + 0.31 * i;
        const RenderResult with = renderer->render(frame);
        Frame dry = frame;
        dry.settings.falling = false;
        const RenderResult without = renderer->render(dry);
        std::vector<glm::vec2> births;
        for (int layer = 0; layer < shared::kRippleLayers; ++layer) {
            for (int n = 0; n < 60 * 60; ++n) {
                const auto birth = shared::ring_birth({n % 60 - 30, n / 60 - 30}, layer, static_cast<float>(frame.settings.time_s), 1.0f);
                if (birth.age / (shared::kRippleBirths_per_s * shared::ripple_rate(layer)) < shared::kSplashLife_s)
                    births.push_back(birth.place / frame.look.ripple_tiling);
            }
        }
        for (int y = 0; y < with.height; ++y) {
            for (int x = 0; x < with.width; ++x) {
                const glm::vec3 d = pixel(with, x, y) - pixel(without, x, y);
                if (std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)}) < 0.02f * luminance(pixel(without, x, y))) continue;
                const glm::vec2 at(aov(with, "position", x, y, 0), aov(with, "position", x, y, 2));
                ++changed;
                near += std::any_of(births.begin(), births.end(), [&](const glm::vec2& b) { return glm::distance(b, at) < 0.04f; });
            }
        }
    }
    EXPECT_GT(changed, 40);
    // By chance some four in a hundred would be.
    EXPECT_GT(near, 0.7 * changed);
}

// From above a sheet shows them; from below it hides them, however thin it is.
TEST_F(SplashesPicture, NoneAreSeenThroughARoof)
{
    Material sheet = plain_material(glm::vec3(0.04f));
    sheet.double_sided = true;
    const auto changed = [&](float height_m) {  // pixels
        renderer->load(scene_of({quad({-20, height_m, 20}, {40, 0, 0}, {0, 0, -40}), quad({-20, -2.5f, 20}, {40, 0, 0}, {0, 0, -40})}, {sheet}), {});
        Frame frame = raining(1.0f, 1.0f);
        frame.camera = look({0, 0, 0}, {0, height_m, -1.4f}, 0.9f);
        frame.sky.cloud_cover = 1.0f;
        frame.falling.budget = 1;
        frame.falling.density = 1.0f;
        frame.settings.width = 160;
        frame.settings.height = 90;
        frame.settings.samples = 1;
        frame.settings.exposure = 1e-4f;
        int count = 0;
        for (int i = 0; i < 4; ++i) {
            frame.settings.time_s = 1.0 + 0.31 * i;
            const RenderResult with = renderer->render(frame);
            Frame dry = frame;
            dry.settings.falling = false;
            const RenderResult without = renderer->render(dry);
            for (int y = 0; y < with.height; ++y) {
                for (int x = 0; x < with.width; ++x) {
                    const float before = luminance(pixel(without, x, y));
                    count += std::abs(luminance(pixel(with, x, y)) - before) > 0.02f * before ? 1 : 0;
                }
            }
        }
        return count;
    };
    EXPECT_GT(changed(-1.8f), 40);
    EXPECT_EQ(changed(1.8f), 0);
}

}  // namespace
}  // namespace petrichor::gpu
