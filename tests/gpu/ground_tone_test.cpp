// Ground so wide that its colour varies over the land.
#include <algorithm>
#include <cmath>
#include <limits>

#include "formulas/weather/ground_fields.h"
#include "formulas/weather/ground_tone.h"
#include "formulas/weather/land_relief.h"
#include "gpu/upload/wide_ground.h"
#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr int kSize = 64;

Scene field(float width_m)
{
    return scene_of({quad({-0.5f * width_m, 0, 0.5f * width_m}, {width_m, 0, 0}, {0, 0, -width_m})},
                    {plain_material({0.2f, 0.3f, 0.1f})});
}

Frame from_above(float width_m, float variation)
{
    Frame frame;
    frame.camera = look({0, 50, 0}, {0, 0, 0});
    frame.camera.orthographic_height_m = width_m;
    frame.settings.width = frame.settings.height = kSize;
    frame.settings.samples = 1;
    frame.settings.aovs = {"base_color", "position"};
    frame.look.ground_variation = variation;
    return frame;
}

TEST(WideGround, IsWhatFacesUpOverAHectareOrTwo)
{
    EXPECT_FALSE(wide_ground(field(140.0f))[0]);
    EXPECT_TRUE(wide_ground(field(142.0f))[0]);
    // Walls are no ground, however wide; which way triangles turn does not count; many small pieces do.
    Scene walls = scene_of({quad({0, 0, 0}, {3000, 0, 0}, {0, 300, 0})}, {plain_material({1, 1, 1})});
    EXPECT_FALSE(wide_ground(walls)[0]);
    Scene turned = field(200.0f);
    std::reverse(turned.meshes[0].primitives[0].indices.begin(), turned.meshes[0].primitives[0].indices.end());
    EXPECT_TRUE(wide_ground(turned)[0]);
    Scene pieces = field(50.0f);
    for (int i = 1; i < 9; ++i)
        pieces.instances.push_back({"piece", 0, glm::translate(glm::mat4(1.0f), {60.0f * static_cast<float>(i), 0, 0})});
    EXPECT_TRUE(wide_ground(pieces)[0]);
    Scene damaged = field(200.0f);
    damaged.meshes[0].primitives[0].positions[0].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NO_THROW(wide_ground(damaged));
}

class GroundToneTest : public GpuTest {};

TEST_F(GroundToneTest, OfWideGroundIsThatOfTheFormulaAndOfSmallGroundNone)
{
    for (const float width_m : {400.0f, 1200.0f, 100.0f}) {
        renderer->load(field(width_m), {});
        const RenderResult plain = renderer->render(from_above(0.9f * width_m, 0.0f));
        const RenderResult varied = renderer->render(from_above(0.9f * width_m, 1.0f));
        const float pixel_m = 0.9f * width_m / kSize;
        float most = 0.0f;
        for (int y = 4; y < kSize; y += 7) {
            for (int x = 4; x < kSize; x += 7) {
                const glm::vec2 at(aov(varied, "position", x, y, 0), aov(varied, "position", x, y, 2));
                const float farmed = shared::farmed_share(at, 1.0f, {0.2f, 0.3f, 0.1f});
                if (width_m > 1000.0f && glm::length(at) > 400.0f) {
                    EXPECT_EQ(farmed, 1.0f);
                }
                const glm::vec3 plain_color(aov(plain, "base_color", x, y, 0), aov(plain, "base_color", x, y, 1), aov(plain, "base_color", x, y, 2));
                const glm::vec3 grass = width_m > 142.0f ? shared::meadow_tone(plain_color, 1.0f) : plain_color;
                const glm::vec3 tone = width_m > 142.0f ? shared::ground_tone(at, pixel_m, 1.0f) * shared::field_tone(at, pixel_m, farmed) : glm::vec3(1.0f);
                for (int c = 0; c < 3; ++c) {
                    const float is = aov(varied, "base_color", x, y, c);
                    // The G-buffer keeps roots in 8 bits.
                    EXPECT_NEAR(is, grass[c] * tone[c], 0.006f) << width_m << " m at " << at.x << ", " << at.y;
                    most = std::max(most, std::abs(is / grass[c] - 1.0f));
                }
            }
        }
        if (width_m > 142.0f) {
            EXPECT_GT(most, 0.08f);
        }
    }
}

// Hedges of far fields stand out of the snow, as much as the formula says.
TEST_F(GroundToneTest, HedgesOfFarFieldsStandOutOfSnow)
{
    renderer->load(field(1200.0f), {});
    const auto snow = [&](float variation) {
        Frame frame = from_above(1080.0f, variation);
        frame.settings.aovs = {"snow", "position"};
        frame.settings.snow_body = false;
        frame.weather.snow_amount = 1.0f;
        frame.look.snow_line_ragged = 0.0f;
        return renderer->render(frame);
    };
    const RenderResult plain = snow(0.0f), varied = snow(1.0f);
    const float pixel_m = 1080.0f / kSize;
    float most = 0.0f;
    for (int y = 4; y < kSize; y += 3) {
        for (int x = 4; x < kSize; x += 3) {
            const glm::vec2 at(aov(varied, "position", x, y, 0), aov(varied, "position", x, y, 2));
            const float hedge = shared::field_at(at, pixel_m, shared::farmed_share(at, 1.0f, {0.2f, 0.3f, 0.1f})).hedge;
            const float was = aov(plain, "snow", x, y);
            EXPECT_GT(was, 0.9f);
            // The G-buffer keeps it in 8 bits.
            EXPECT_NEAR(aov(varied, "snow", x, y), shared::snow_beside_hedges(was, hedge), 0.006f) << at.x << ", " << at.y;
            most = std::max(most, hedge);
        }
    }
    EXPECT_GT(most, 0.1f);
}

// A dusting: small ground is bare until its snow closes, wide ground turns pale, the more the less it is inclined.
TEST_F(GroundToneTest, ThinSnowLiesAmongTheBladesOfWideGround)
{
    const auto white = [&](float width_m, float tilt_deg) {
        const float tilt = glm::radians(tilt_deg);
        const glm::vec3 up_slope(0, width_m * std::sin(tilt), -width_m * std::cos(tilt));
        renderer->load(scene_of({quad({-0.5f * width_m, 0, 0.5f * width_m}, {width_m, 0, 0}, up_slope)}, {plain_material({0.2f, 0.3f, 0.1f})}), {});
        Frame frame = from_above(0.4f * width_m, 1.0f);
        frame.camera = look({0, 3.0f * width_m, 0.3f * width_m}, {0, 0, 0.3f * width_m});
        frame.camera.orthographic_height_m = 0.2f * width_m;
        frame.settings.aovs = {"snow"};
        frame.weather.snow_amount = 0.2f;
        frame.settings.snow_body = false;
        const RenderResult r = renderer->render(frame);
        double sum = 0.0;
        float most = 0.0f;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                sum += static_cast<double>(aov(r, "snow", x, y, 0));
                most = std::max(most, aov(r, "snow", x, y, 0));
            }
        }
        if (width_m > 142.0f) {
            EXPECT_LT(most, 0.7f) << tilt_deg;
        }
        return sum / (kSize * kSize);
    };
    EXPECT_LT(white(40.0f, 0.0f), 0.07);
    const double level = white(400.0f, 0.0f), inclined = white(400.0f, 42.0f), steep = white(400.0f, 62.0f);
    EXPECT_GT(level, 0.15);
    EXPECT_LT(level, 0.35);
    EXPECT_GT(inclined, 0.05);
    EXPECT_LT(inclined, 0.8 * level);
    EXPECT_LT(steep, 0.02);
}

// A slope of 53 degrees seen from above: wide ground is bent over its relief, a small slope is flat.
TEST_F(GroundToneTest, SteepWideGroundIsBentOverItsRelief)
{
    for (const float width_m : {400.0f, 40.0f}) {
        Scene slope = scene_of({quad({-0.5f * width_m, 0, 0.5f * width_m}, {width_m, 0, 0}, {0, width_m, -0.75f * width_m})},
                               {plain_material({0.2f, 0.3f, 0.1f})});
        EXPECT_EQ(wide_ground(slope)[0], width_m > 142.0f);
        renderer->load(slope, {});
        Frame frame = from_above(0.5f * width_m, 1.0f);
        frame.camera = look({0, 3.0f * width_m, 0.1f * width_m}, {0, 0, 0.1f * width_m});
        frame.camera.orthographic_height_m = 0.5f * width_m;
        frame.settings.aovs = {"normal", "position"};
        const RenderResult bent = renderer->render(frame);
        frame.look.ground_variation = 0.0f;
        const RenderResult flat = renderer->render(frame);
        const glm::vec3 plain(0.0f, 0.6f, 0.8f);
        const float pixel_m = 0.5f * width_m / kSize / 0.6f;
        float most = 0.0f;
        for (int y = 4; y < kSize; y += 7) {
            for (int x = 4; x < kSize; x += 7) {
                const auto at = [&](const RenderResult& r, const char* name, int c) { return aov(r, name, x, y, c); };
                const glm::vec3 p(at(bent, "position", 0), at(bent, "position", 1), at(bent, "position", 2));
                const glm::vec3 expected =
                    width_m > 142.0f ? shared::land_normal(plain, shared::slope_relief(p, pixel_m).flatter,
                                                           shared::land_ribs(p, pixel_m), shared::land_relief_share(plain.y))
                                     : plain;
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(at(bent, "normal", c), expected[c], 0.01f) << width_m << " m at " << p.x << ", " << p.z;
                    EXPECT_NEAR(at(flat, "normal", c), plain[c], 0.001f);
                    most = std::max(most, std::abs(expected[c] - plain[c]));
                }
            }
        }
        EXPECT_EQ(most > 0.1f, width_m > 142.0f);
    }
}

}  // namespace
}  // namespace petrichor::gpu
