// Where lamps end: by what the exposure of the frame shows, so that nothing of it is seen.
#include <algorithm>
#include <cmath>

#include "formulas/color/tone_map.h"
#include "formulas/light/exposure.h"
#include "gpu/passes/lights/lights.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr float kPi = 3.14159265f;
constexpr ToneMap kCurves[] = {ToneMap::Linear, ToneMap::Filmic, ToneMap::Agx, ToneMap::Aces, ToneMap::Neutral};

float codes(ToneMap curve, float exposed)
{
    return 255.0f * shared::srgb_encode(shared::display_light(static_cast<int>(curve), glm::vec3(exposed)).g);
}

float exposure_of(float ev100) { return shared::exposure_of_ev100(ev100); }

TEST(LampReach, GrowsAsTheExposureValueFalls)
{
    for (const ToneMap curve : kCurves) {
        FrameSettings settings;
        settings.tone_map = curve;
        Light lamp;
        lamp.intensity = 800.0f;
        Light ranged = lamp;
        ranged.range_m = 12.0f;
        float before = 0.0f;
        for (float ev100 = 20.0f; ev100 >= -6.0f; ev100 -= 0.25f) {
            const float least = least_lux(settings, exposure_of(ev100));
            const float reach = light_radius_m(lamp, least);
            EXPECT_GE(reach, before) << ev100;
            EXPECT_GE(least, kFaintestLux);
            EXPECT_LE(light_radius_m(ranged, least), 12.0f);
            before = reach;
        }
        EXPECT_EQ(before, light_radius_m(lamp)) << "by night they end where they always did";
        EXPECT_EQ(light_radius_m(ranged, kFaintestLux), 12.0f);
        EXPECT_LT(light_radius_m(lamp, least_lux(settings, exposure_of(15.0f))), 0.5f * before);
    }
}

// What the window takes from a lamp is at most what it would give at its reach.
TEST(LampReach, WhitePaperInAnyLightIsTheSameToASixteenthOfACode)
{
    for (const ToneMap curve : kCurves) {
        FrameSettings settings;
        settings.tone_map = curve;
        const float exposure = exposure_of(12.0f);
        const float more = least_lux(settings, exposure) / kPi * exposure;
        float most = 0.0f;
        for (float light = 0.0f; light < 2.0f; light = 1.02f * light + 1e-5f)
            most = std::max(most, codes(curve, light + more) - codes(curve, light));
        EXPECT_LE(most, 1.05f * kUnseenCodes) << static_cast<int>(curve);
        EXPECT_GE(most, 0.5f * kUnseenCodes) << static_cast<int>(curve);
    }
}

TEST(LampReach, AScenariosOwnEndIsTaken)
{
    FrameSettings settings;
    settings.least_lux = 0.3f;
    EXPECT_EQ(least_lux(settings, exposure_of(16.0f)), 0.3f);
    EXPECT_EQ(least_lux(settings, exposure_of(-3.0f)), 0.3f);
    settings.least_lux = 0.0f;
    EXPECT_EQ(least_lux(settings, 0.0f), kFaintestLux) << "an exposure that nobody knows";
}

using LampReachTest = GpuTest;

// A long hall, wet and dry, lamps of all kinds along it and panes that glow.
Scene hall()
{
    Material pane = plain_material(glm::vec3(0.0f));
    pane.emissive = glm::vec3(60.0f, 50.0f, 40.0f);
    return scene_of({quad({-3, 0, 0}, {6, 0, 0}, {0, 0, -60}), quad({-3, 0, 0}, {0, 0, -60}, {0, 4, 0}, 1),
                     quad({2.9f, 1, -8}, {0, 0, 1.5f}, {0, 1, 0}, 2), quad({2.9f, 1, -20}, {0, 0, 1.5f}, {0, 1, 0}, 2)},
                    {plain_material(glm::vec3(0.3f), 0.3f), plain_material(glm::vec3(0.9f), 0.8f), pane});
}

Frame in_the_hall(float ev100)
{
    Frame frame;
    frame.camera = look({0, 1.6f, 1}, {0, 1, -20}, 0.9f);
    frame.sky.sun_elevation_rad = 0.1f;
    frame.settings.width = 96;
    frame.settings.height = 64;
    frame.settings.samples = 1;
    frame.settings.dither = false;
    frame.settings.exposure = exposure_of(ev100);
    Light point;
    point.position_m = {1, 3, -5};
    point.intensity = 800.0f;
    Light ball = point;
    ball.position_m = {-1, 3, -15};
    ball.radius_m = 0.1f;
    Light pane;
    pane.kind = LightKind::Rectangle;
    pane.position_m = {0, 3.9f, -25};
    pane.direction = {0, -1, 0};
    pane.half_u_m = {0.5f, 0, 0};
    pane.half_v_m = {0, 0, 0.5f};
    pane.intensity = 700.0f;
    pane.shaped = true;
    frame.extra_lights = {point, ball, pane};
    return frame;
}

struct Apart {
    int codes = 0;          // of the display, at most
    float exposed = 0.0f;   // of linear light, at most, times the exposure
    float brighter = 0.0f;  // the same, where what should be darker is not
};

Apart apart(const RenderResult& full, const RenderResult& cut)
{
    Apart a;
    for (std::size_t i = 0; i < full.display.size(); ++i)
        a.codes = std::max(a.codes, std::abs(int{full.display[i]} - int{cut.display[i]}));
    for (int y = 0; y < full.height; ++y) {
        for (int x = 0; x < full.width; ++x) {
            const glm::vec3 more = (pixel(full, x, y) - pixel(cut, x, y)) * full.exposure;
            a.exposed = std::max({a.exposed, more.r, more.g, more.b});
            a.brighter = std::max({a.brighter, -more.r, -more.g, -more.b});
        }
    }
    return a;
}

TEST_F(LampReachTest, NothingOfItIsSeenAndItNeverAddsLight)
{
    renderer->load(hall(), {});
    for (const float ev100 : {15.0f, 12.0f, 10.0f, 9.0f}) {
        // Beside the light of the sky a half may be too coarse for what is left out: without it, it is not.
        float ends_earlier = 0.0f;
        for (const bool sky : {true, false}) {
            Frame frame = in_the_hall(ev100);
            frame.settings.image_based_light = sky;
            const RenderResult cut = renderer->render(frame);
            frame.settings.least_lux = kFaintestLux;
            const RenderResult full = renderer->render(frame);
            const Apart a = apart(full, cut);
            EXPECT_LE(a.codes, 1) << ev100;
            EXPECT_EQ(a.brighter, 0.0f) << ev100;
            ends_earlier = std::max(ends_earlier, a.exposed);
        }
        EXPECT_GT(ends_earlier, 0.0f) << "it does end earlier, at " << ev100;
    }
}

TEST_F(LampReachTest, NightsKeepTheirBits)
{
    renderer->load(hall(), {});
    Frame frame = in_the_hall(0.0f);
    frame.sky.sun_elevation_rad = -0.3f;
    const RenderResult cut = renderer->render(frame);
    frame.settings.least_lux = kFaintestLux;
    EXPECT_EQ(renderer->render(frame).beauty, cut.beauty);
}

// Lamps come on while the light goes, in steps of a film. What the reach leaves out changes by less from frame to
// frame than a code, wherever it is.
TEST_F(LampReachTest, NothingPopsWhileTheExposureGoesDown)
{
    renderer->load(hall(), {});
    std::vector<float> before;
    float most = 0.0f;
    for (int i = 0; i <= 40; ++i) {
        const float ev100 = 13.0f - 0.25f * static_cast<float>(i);
        Frame frame = in_the_hall(ev100);
        frame.sky.sun_elevation_rad = 0.1f - 0.006f * static_cast<float>(i);
        for (Light& light : frame.extra_lights) light.intensity *= std::min(1.0f, 0.05f * static_cast<float>(i));
        frame.emissive_scale = std::min(1.0f, 0.05f * static_cast<float>(i));
        const RenderResult cut = renderer->render(frame);
        frame.settings.least_lux = kFaintestLux;
        const RenderResult full = renderer->render(frame);
        std::vector<float> now;
        for (int y = 0; y < full.height; ++y) {
            for (int x = 0; x < full.width; ++x)
                now.push_back(codes(ToneMap::Filmic, luminance(pixel(full, x, y)) * full.exposure) -
                              codes(ToneMap::Filmic, luminance(pixel(cut, x, y)) * cut.exposure));
        }
        for (std::size_t k = 0; k < before.size(); ++k) most = std::max(most, std::abs(now[k] - before[k]));
        before = now;
    }
    EXPECT_LT(most, 0.5f);
    EXPECT_GT(most, 0.0f);
}

// Shadow maps and loops of lamps that nothing in the picture can be lit by are left out: the same bits.
TEST_F(LampReachTest, LampsBeyondThePictureAreLeftOut)
{
    renderer->load(hall(), {});
    Frame frame = in_the_hall(4.0f);
    frame.extra_lights.resize(1);
    const RenderResult alone = renderer->render(frame);
    Light behind;
    behind.position_m = {0, 2, 80};
    behind.intensity = 20.0f;  // ends 45 m off
    behind.radius_m = 0.2f;
    frame.extra_lights.push_back(behind);
    const RenderResult both = renderer->render(frame);
    EXPECT_EQ(both.beauty, alone.beauty);
    const auto maps = [](const RenderResult& r) {
        return std::count_if(r.passes.begin(), r.passes.end(),
                             [](const PassTime& pass) { return pass.name == "lamp_shadows"; });
    };
    EXPECT_EQ(maps(both), 0) << "the other's are there already";
    frame.extra_lights.back().position_m.z = -30.0f;
    EXPECT_GT(maps(renderer->render(frame)), 0);
}

}  // namespace
}  // namespace petrichor::gpu
