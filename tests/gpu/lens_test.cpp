// The lens and the shutter: blur as wide as optics and speed say; lamps' penumbras as wide as the lamps.
#include <algorithm>
#include <cmath>

#include "gpu/frame/sun.h"
#include "gpu/frame/view.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 96;

// Things that glow before black, straight ahead.
Frame dark(int samples)
{
    Frame frame;
    frame.camera = look({0, 0, 0}, {0, 0, -1}, 0.8f);
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = samples;
    frame.settings.image_based_light = false;
    frame.settings.shadows = false;
    frame.settings.draw_sky = false;
    frame.settings.exposure = 1.0f;
    frame.sky.sun_elevation_rad = -1.0f;
    frame.emissive_lights = false;
    frame.weather.visibility_m = 1e9f;
    return frame;
}

// Pixels that one metre covers at a distance of one.
float pixels_a_metre()
{
    return 0.5f * kSize / std::tan(0.4f);
}

Scene spark(float distance_m, float side_m)
{
    Material m = plain_material(glm::vec3(0.0f));
    m.specular = 0.0f;
    m.emissive = glm::vec3(1.0f);
    return scene_of({quad({-0.5f * side_m, -0.5f * side_m, -distance_m}, {side_m, 0, 0}, {0, side_m, 0})},
                    {m});
}

struct Spread {
    float light = 0.0f;
    glm::vec2 middle{0.0f};
    glm::vec2 deviation{0.0f};  // pixels
};

Spread spread_of(const RenderResult& r)
{
    Spread s;
    glm::vec2 second(0.0f);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float light = pixel(r, x, y).r;
            const glm::vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            s.light += light;
            s.middle += light * at;
            second += light * at * at;
        }
    }
    s.middle /= s.light;
    s.deviation = glm::sqrt(glm::max(second / s.light - s.middle * s.middle, glm::vec2(0.0f)));
    return s;
}

class LensTest : public GpuTest {
protected:
    Spread shot(const Scene& scene, const Frame& frame)
    {
        renderer->load(scene, {});
        return spread_of(renderer->render(frame));
    }
};

TEST_F(LensTest, TheCircleOfConfusionIsAsWideAsOpticsSay)
{
    for (const float distance_m : {1.0f, 4.0f, 8.0f}) {
        Frame frame = dark(64);
        const Scene scene = spark(distance_m, 0.05f * distance_m);
        const Spread sharp = shot(scene, frame);
        frame.lens = {0.1f, 2.0f};
        const Spread blurred = shot(scene, frame);
        EXPECT_NEAR(blurred.light, sharp.light, 0.03f * sharp.light) << distance_m;
        EXPECT_NEAR(blurred.middle.x, sharp.middle.x, 0.3f);
        // Aperture times the difference of the inverse distances; of an even disc half its radius.
        const float radius = 0.1f * std::abs(1.0f / distance_m - 0.5f) * pixels_a_metre();
        for (int axis = 0; axis < 2; ++axis) {
            const float own = std::sqrt(blurred.deviation[axis] * blurred.deviation[axis] -
                                        sharp.deviation[axis] * sharp.deviation[axis]);
            EXPECT_NEAR(own, 0.5f * radius, 0.05f * radius + 0.1f) << distance_m;
        }
    }
}

TEST_F(LensTest, WhatIsInFocusIsSharpAndLabelsAreOfTheMiddle)
{
    Frame frame = dark(16);
    frame.settings.aovs = {"depth"};
    const Scene scene = spark(2.0f, 0.2f);
    renderer->load(scene, {});
    const RenderResult sharp = renderer->render(frame);
    frame.lens = {0.1f, 2.0f};
    const RenderResult focused = renderer->render(frame);
    float worst = 0.0f;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x)
            worst = std::max(worst, std::abs(pixel(sharp, x, y).r - pixel(focused, x, y).r));
    }
    EXPECT_LT(worst, 0.1f);  // a sample on an edge may fall on its other side by rounding
    frame.lens.focus_m = 0.5f;
    const RenderResult blurred = renderer->render(frame);
    EXPECT_EQ(sharp.aovs[0].pixels, blurred.aovs[0].pixels);
    EXPECT_NE(sharp.beauty, blurred.beauty);
}

TEST_F(LensTest, AMovingCameraBlursByItsWay)
{
    Frame frame = dark(32);
    const Scene scene = spark(2.0f, 0.05f);
    const Spread still = shot(scene, frame);
    const float way_m = 0.3f;
    for (int i = 0; i < 32; ++i) {
        const float u = i == 0 ? 0.0f : static_cast<float>(std::fmod(0.5 + 0.618033988749895 * i, 1.0)) - 0.5f;
        ShutterMoment moment{.camera = frame.camera};
        moment.camera.to_world[3].x += u * way_m;
        frame.shutter.push_back(moment);
    }
    const Spread moved = shot(scene, frame);
    const float length = way_m / 2.0f * pixels_a_metre();
    const float own = std::sqrt(moved.deviation.x * moved.deviation.x -
                                still.deviation.x * still.deviation.x);
    EXPECT_NEAR(own, length / std::sqrt(12.0f), 0.08f * length);
    EXPECT_NEAR(moved.deviation.y, still.deviation.y, 0.1f);
    EXPECT_NEAR(moved.light, still.light, 0.05f * still.light);
    frame.shutter.pop_back();
    EXPECT_THROW(renderer->render(frame), Error);
}

TEST_F(LensTest, ImpossibleLensesAreRefused)
{
    renderer->load(spark(2.0f, 0.1f), {});
    for (const Lens lens : {Lens{-0.1f, 2.0f}, Lens{NAN, 2.0f}, Lens{0.1f, 0.0f}, Lens{0.1f, NAN}}) {
        Frame frame = dark(2);
        frame.lens = lens;
        EXPECT_THROW(renderer->render(frame), Error) << lens.radius_m << " " << lens.focus_m;
    }
    Frame level = dark(2);
    level.camera.orthographic_height_m = 2.0f;
    level.lens = {0.1f, 2.0f};
    EXPECT_THROW(renderer->render(level), Error);
}

// A plate half way between a round lamp and the ground: its edge's shadow is as wide as the lamp.
TEST_F(LensTest, APenumbraIsAsWideAsItsLamp)
{
    Scene scene = scene_of({quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}),
                            quad({0, 1, 2}, {2.5f, 0, 0}, {0, 0, -4})},
                           {plain_material(glm::vec3(0.8f), 1.0f)});
    scene.materials[0].double_sided = true;
    scene.materials[0].specular = 0.0f;
    Light lamp;
    lamp.position_m = {0, 2, 0};
    lamp.intensity = 1000.0f;
    lamp.radius_m = 0.3f;
    scene.lights = {lamp};
    renderer->load(scene, {});
    Frame frame = dark(48);
    frame.camera = look({-1.2f, 0.8f, 0}, {0.1f, 0, 0}, 0.9f);
    frame.settings.shadows = true;
    frame.settings.exposure = 1e-3f;
    // How much of the edge's surroundings is neither lit nor dark, along x on the ground.
    const auto widths = [&](bool soft) {
        frame.settings.soft_shadows = soft;
        frame.settings.aovs = {"position"};
        const RenderResult r = renderer->render(frame);
        const int row = kSize / 2;
        float low = 1e9f, high = -1e9f, bright = 0.0f;
        for (int pass = 0; pass < 2; ++pass) {
            for (int y = 0; y < kSize; ++y) {
                const float light = pixel(r, row, y).r;
                bright = std::max(bright, light);
                const float x = aov(r, "position", row, y, 0);
                if (pass == 0 || aov(r, "position", row, y, 1) > 0.5f || x < -0.8f || x > 0.8f) continue;
                if (light > 0.1f * bright && light < 0.8f * bright) {
                    low = std::min(low, x);
                    high = std::max(high, x);
                }
            }
        }
        return high - low;
    };
    const float hard = widths(false);
    const float soft = widths(true);
    EXPECT_LT(hard, 0.12f);
    // The lamp's width of 0.6 m is met again below the edge; the tenths at its ends are left out.
    EXPECT_GT(soft, 0.3f);
    EXPECT_LT(soft, 0.6f);
}

// A plate 40 m over the ground below a high sun: its edge's shadow spans what the sun does from there.
TEST_F(LensTest, ThePenumbraOfTheSunIsAsWideAsItsDisc)
{
    constexpr float kHeight = 40.0f;
    Scene scene = scene_of({quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}),
                            quad({0, kHeight, 1}, {2, 0, 0}, {0, 0, -2})},
                           {plain_material(glm::vec3(0.8f), 1.0f)});
    scene.materials[0].double_sided = true;
    scene.materials[0].specular = 0.0f;
    renderer->load(scene, {});
    Frame frame = dark(96);
    frame.sky.sun_elevation_rad = 1.5707963f;
    frame.camera = look({0, 4, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = 1.0f;
    frame.settings.shadows = true;
    frame.settings.exposure = 1e-4f;
    // Along the row across the edge: how far a tenth and nine tenths of the light are apart.
    const auto width_m = [&](bool soft) {
        frame.settings.soft_shadows = soft;
        const RenderResult r = renderer->render(frame);
        std::vector<float> row;
        for (int x = 0; x < kSize; ++x) row.push_back(pixel(r, x, kSize / 2).g);
        const float most = *std::max_element(row.begin(), row.end());
        int between = 0;
        for (const float light : row) between += light > 0.1f * most && light < 0.9f * most ? 1 : 0;
        return static_cast<float>(between) / kSize;
    };
    const float hard = width_m(false);
    const float soft = width_m(true);
    // Of a disc that an edge hides, 0.687 of its width lies between the two.
    const float wanted = 0.687f * kHeight * 2.0f * 0.00465f;
    EXPECT_LT(hard, 0.06f);
    EXPECT_NEAR(soft, wanted, 0.12f * wanted + 0.02f);
}

TEST(SunDisc, IsEvenAndBeginsInItsMiddle)
{
    const glm::vec3 middle = glm::normalize(glm::vec3(0.3f, 0.5f, -0.8f));
    EXPECT_LT(glm::length(toward_sun_disc(middle, 0, 64, 1) - middle), 1e-6f);
    int inner = 0;
    for (std::uint32_t i = 0; i < 1024; ++i) {
        const float off = glm::length(glm::cross(toward_sun_disc(middle, i, 1024, 1), middle));
        EXPECT_LT(off, 1.01f * kSunAngularRadius);
        inner += off < 0.5f * kSunAngularRadius ? 1 : 0;
    }
    EXPECT_NEAR(inner / 1024.0, 0.25, 0.01);
}

// From whichever side a lamp is seen, its points are an even disc.
TEST(LampOffsets, AreAnEvenDiscFromEverySide)
{
    Light lamp;
    lamp.radius_m = 2.0f;
    for (const glm::vec3& side : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, 0.8f)}) {
        double sum = 0.0;
        int inner = 0;
        constexpr int kCount = 4096;
        for (int i = 1; i <= kCount; ++i) {
            const glm::vec3 at = lamp_offset_m(lamp, static_cast<std::uint32_t>(i), kCount, 1);
            const float along = glm::dot(at, side);
            const float r2 = glm::dot(at, at) - along * along;
            EXPECT_LE(r2, 4.001f);
            sum += static_cast<double>(r2);
            inner += r2 < 1.0f ? 1 : 0;
        }
        EXPECT_NEAR(sum / kCount, 2.0, 0.05);
        EXPECT_NEAR(inner / static_cast<double>(kCount), 0.25, 0.02);
    }
}

}  // namespace
}  // namespace petrichor::gpu
