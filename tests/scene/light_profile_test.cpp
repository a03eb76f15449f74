// Lamps light patches by their profiles: photometry, a spot's picture, the lantern around them.
#include "scene/light_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formulas/codec/octahedral.h"
#include "scene/patches/lamps.h"

namespace petrichor::scene {
namespace {

constexpr int kSide = kLightProfileSide;

Light lamp()
{
    Light light;
    light.kind = LightKind::Point;
    light.position_m = {0, 3, 0};
    light.direction = {0, -1, 0};
    light.up = {0, 0, -1};
    light.intensity = 100.0f;
    light.profile = 0;
    return light;
}

template <class Value>
LightProfile profile(Value value)
{
    LightProfile made;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) made.texels.push_back(value(x, y));
    return made;
}

// Lux of a plate that faces the lamp, so far that way.
float lux(const Light& light, const LightProfile& by, glm::vec3 away, float far_m = 2.0f)
{
    const std::vector<LightProfile> all{by};
    return lamp_irradiance(light, all, light.position_m + far_m * away, -away).y * far_m * far_m;
}

TEST(LightProfileOfPatches, PhotometryGoesByTheAngleFromTheAxis)
{
    // Nothing upwards; downwards the cosine of the angle.
    const LightProfile down = profile([](int, int y) {
        const float angle = 3.14159265f * static_cast<float>(y) / (kSide - 1);
        return glm::vec3(std::max(std::cos(angle), 0.0f));
    });
    const float straight = lux(lamp(), down, {0, -1, 0});
    EXPECT_GT(straight, 1.0f);
    for (const float angle : {0.2f, 0.7f, 1.2f}) {
        const glm::vec3 away(std::sin(angle), -std::cos(angle), 0.0f);
        EXPECT_NEAR(lux(lamp(), down, away) / straight, std::cos(angle), 2e-3f) << angle;
    }
    EXPECT_EQ(lux(lamp(), down, {0, 1, 0}), 0.0f);
    EXPECT_LT(lux(lamp(), down, glm::normalize(glm::vec3(1, 0.05f, 0))), 0.01f * straight);
}

TEST(LightProfileOfPatches, PhotometryTurnsAboutTheAxisFromUpAndWraps)
{
    const LightProfile quarters = profile([](int x, int) { return glm::vec3(static_cast<float>(x / (kSide / 4) + 1)); });
    Light light = lamp();
    light.intensity = 1.0f;
    const float whole = lux(light, profile([](int, int) { return glm::vec3(1.0f); }), {1, 0, 0});
    // Right of a lamp that looks down with its up to the north is the east.
    const glm::vec3 right = glm::cross(light.direction, light.up);
    const auto turned = [&](float turn) {
        const float angle = 6.2831853f * turn;
        return lux(light, quarters, std::cos(angle) * light.up + std::sin(angle) * right) / whole;
    };
    EXPECT_NEAR(turned(0.1f), 1.0f, 1e-4f);
    EXPECT_NEAR(turned(0.35f), 2.0f, 1e-4f);
    EXPECT_NEAR(turned(0.6f), 3.0f, 1e-4f);
    EXPECT_NEAR(turned(0.9f), 4.0f, 1e-4f);
    EXPECT_NEAR(turned(1.0f - 0.5f / kSide), 2.5f, 1e-3f) << "between the last column and the first";
}

TEST(LightProfileOfPatches, APictureStandsBeforeASpotAndNothingShinesBehindIt)
{
    Light spot = lamp();
    spot.kind = LightKind::Spot;
    spot.inner_cone_rad = 0.5f;
    spot.outer_cone_rad = 0.6f;
    LightProfile window = profile([](int x, int) { return x < kSide / 2 ? glm::vec3(1, 1, 1) : glm::vec3(0, 0.25f, 0); });
    window.picture = true;
    const glm::vec3 right = glm::cross(spot.direction, spot.up);
    const float left = lux(spot, window, glm::normalize(spot.direction - 0.2f * right));
    EXPECT_NEAR(lux(spot, window, glm::normalize(spot.direction + 0.2f * right)), 0.25f * left, 1e-3f * left);
    EXPECT_EQ(lux(spot, window, -spot.direction), 0.0f);
}

TEST(LightProfileOfPatches, ALanternsRoofKeepsItsLightFromWhatLiesAbove)
{
    LightProfile roof = profile([](int x, int y) {
        const glm::vec2 at((static_cast<float>(x) + 0.5f) * (2.0f / kSide) - 1.0f, (static_cast<float>(y) + 0.5f) * (2.0f / kSide) - 1.0f);
        const bool hidden = shared::octahedral_decode(at).y > 0.5f;
        return glm::vec3(hidden ? 0.0f : 1.0f, hidden ? 0.2f : 1e4f, 0.0f);
    });
    roof.lantern = true;
    Light light = lamp();
    light.in_lantern = true;
    EXPECT_GT(lux(light, roof, {0, -1, 0}), 1.0f);
    EXPECT_EQ(lux(light, roof, {0, 1, 0}), 0.0f);
    EXPECT_GT(lux(light, roof, {0, 1, 0}, 0.15f), 0.0f) << "below the roof, within the lantern";
}

TEST(LightProfileOfPatches, WithoutAProfileAllIsAsBefore)
{
    Light light = lamp();
    light.profile = -1;
    const LightProfile none = profile([](int, int) { return glm::vec3(0.0f); });
    EXPECT_GT(lux(light, none, {0, 1, 0}), 1.0f);
    light.profile = 7;
    EXPECT_GT(lux(light, none, {0, 1, 0}), 1.0f) << "of a scene that lost its profiles";
}

}  // namespace
}  // namespace petrichor::scene
