// Tone curves, white balance: the values and laws of the texts that they come from.
#include <gtest/gtest.h>

#include "formulas/color/tone_map.h"
#include "formulas/color/white_balance.h"

namespace petrichor::shared {
namespace {

TEST(ToneMaps, AllRiseFromBlackToWhiteAndKeepGreyGrey)
{
    for (const int curve : {TONE_MAP_FILMIC, TONE_MAP_AGX, TONE_MAP_ACES, TONE_MAP_NEUTRAL}) {
        float before = -1.0f;
        for (float stops = -12.0f; stops < 12.0f; stops += 0.05f) {
            const glm::vec3 c = display_light(curve, glm::vec3(std::exp2(stops)));
            EXPECT_GE(c.y, before) << curve << " at " << stops;
            EXPECT_GE(c.y, 0.0f);
            EXPECT_LE(c.y, curve == TONE_MAP_FILMIC ? 1.04f : 1.0f + 1e-6f)
                << "filmic ends in the encoder";
            EXPECT_NEAR(c.x, c.y, 2e-3f) << curve << " at " << stops;
            EXPECT_NEAR(c.z, c.y, 2e-3f) << curve << " at " << stops;
            before = c.y;
        }
        EXPECT_LT(display_light(curve, glm::vec3(0.0f)).y, 1e-3f) << curve;
        EXPECT_GT(before, 0.98f) << curve;
    }
    EXPECT_EQ(display_light(TONE_MAP_LINEAR, glm::vec3(0.3f, 2.0f, 0.0f)),
              glm::vec3(0.3f, 2.0f, 0.0f));
}

TEST(ToneMaps, AgxPassesThroughItsPivotWithItsSlope)
{
    EXPECT_NEAR(agx(glm::vec3(0.18f)).y, 0.18f, 5e-4f);
    EXPECT_NEAR(agx_curve(0.0f), 0.0f, 1e-5f);
    EXPECT_NEAR(agx_curve(1.0f), 1.0f, 1e-5f);
    EXPECT_NEAR(agx_curve(kAgxPivot), kAgxPivotCode, 1e-5f);
    const float h = 0.002f;
    EXPECT_NEAR((agx_curve(kAgxPivot + h) - agx_curve(kAgxPivot - h)) / (2.0f * h), kAgxSlope,
                0.02f);
    // Bright blue bleaches: more red and green in it than a curve of each channel would leave.
    const glm::vec3 blue = agx(glm::vec3(0.0f, 0.0f, 20.0f));
    EXPECT_GT(blue.x, 0.3f);
}

TEST(ToneMaps, AcesHasTheValuesOfItsFit)
{
    EXPECT_NEAR(aces(glm::vec3(0.18f)).y, 0.1056f, 5e-4f);
    EXPECT_NEAR(aces(glm::vec3(1.0f)).y, 0.6191f, 1e-3f);
}

TEST(ToneMaps, NeutralOnlyTakesTheReflectionOffBaseColours)
{
    const glm::vec3 c(0.7f, 0.3f, 0.1f);
    const glm::vec3 shown = khronos_neutral(c);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(shown[i], c[i] - 0.04f, 1e-6f);
    // A dielectric's 4 % on black vanishes, and nothing jumps where the compression begins.
    EXPECT_NEAR(khronos_neutral(glm::vec3(0.04f)).x, 0.01f, 1e-6f);
    EXPECT_NEAR(khronos_neutral(glm::vec3(0.8f - 1e-4f)).x,
                khronos_neutral(glm::vec3(0.8f + 1e-4f)).x, 3e-4f);
}

TEST(WhiteBalance, MakesTheLightOfATemperatureWhite)
{
    // CIE: illuminant A is the black body of 2856 K.
    EXPECT_NEAR(planckian_xy(2856.0f).x, 0.4476f, 2e-3f);
    EXPECT_NEAR(planckian_xy(2856.0f).y, 0.4074f, 2e-3f);
    for (const float kelvin : {2000.0f, 2856.0f, 4000.0f, 5500.0f, 9000.0f, 20000.0f}) {
        const glm::vec3 light = rgb_from_cones(cones_of_white(kelvin));
        const glm::vec3 white = white_balanced(light, white_balance_gains(kelvin));
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1.0f, 1e-4f) << kelvin;
    }
    // D65 lies beside the black bodies, the nearest of them is 6504 K: little changes there.
    const glm::vec3 same =
        white_balanced(glm::vec3(0.2f, 0.5f, 0.9f), white_balance_gains(6504.0f));
    EXPECT_NEAR(same.x, 0.2f, 0.02f);
    EXPECT_NEAR(same.z, 0.9f, 0.05f);
    EXPECT_GT(white_balance_gains(3000.0f).z, 1.5f) << "lamplight lacks blue";
}

TEST(WhiteBalance, TakesAShareOfTheCastOfALight)
{
    const glm::vec3 lamp(1.6f, 0.9f, 0.35f);
    const glm::vec3 all = white_balanced(lamp, white_balance_gains_of_light(lamp, 1.0f));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(all[i], 1.0f, 1e-4f);
    const glm::vec3 none = white_balanced(lamp, white_balance_gains_of_light(lamp, 0.0f));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(none[i], lamp[i], 1e-4f);
    const glm::vec3 half = white_balanced(lamp, white_balance_gains_of_light(lamp, 0.5f));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(half[i], 0.5f * (1.0f + lamp[i]), 1e-4f) << "linear in the cones";
    EXPECT_TRUE(std::isfinite(white_balance_gains_of_light(glm::vec3(1.0f, 0.0f, 0.0f), 1.0f).z));
}

}  // namespace
}  // namespace petrichor::shared
