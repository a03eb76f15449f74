// The white in ice: its mean, its range, what is drawn of it.
#include "formulas/weather/ice_pattern.h"

#include <gtest/gtest.h>

#include "formulas/weather/apply_weather.h"

namespace petrichor::shared {
namespace {

struct Whites {
    double mean = 0.0;
    float least = 1.0f, most = 0.0f;
};

Whites whites(float pixel_m, const glm::vec3& toward)
{
    Whites w;
    constexpr int kAcross = 300;
    for (int i = 0; i < kAcross * kAcross; ++i) {
        const glm::vec2 at(0.0931f * static_cast<float>(i % kAcross) - 9.0f, 0.0873f * static_cast<float>(i / kAcross) - 9.0f);
        const float white = ice_white(at, toward, pixel_m);
        w.mean += static_cast<double>(white);
        w.least = std::min(w.least, white);
        w.most = std::max(w.most, white);
    }
    w.mean /= kAcross * kAcross;
    return w;
}

TEST(IcePattern, HasTheMeanOfIceHoweverWideAPixelIs)
{
    for (const float pixel_m : {0.0005f, 0.004f, 0.03f, 0.2f}) {
        for (const glm::vec3& toward : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0.8f, 0), glm::vec3(0, 0.1f, 0.995f)}) {
            const Whites w = whites(pixel_m, toward);
            EXPECT_NEAR(w.mean, kIceWhite, 0.02) << pixel_m << " " << toward.y;
            EXPECT_GE(w.least, 0.0f);
            EXPECT_LE(w.most, 1.0f);
        }
    }
}

// Cracks are nearly white lines in dark ice; a pixel of 20 cm shows haze alone.
TEST(IcePattern, CracksAreSeenFromNearby)
{
    EXPECT_GT(whites(0.0005f, {0, 1, 0}).most, 0.9f);
    EXPECT_LT(whites(0.0005f, {0, 1, 0}).least, 0.02f);
    EXPECT_LT(whites(0.2f, {0, 1, 0}).most, 0.62f);
}

// A sheet of air is a line from above, and a band where one looks into its side.
TEST(IcePattern, ACrackIsWiderFromTheSide)
{
    double above = 0.0, aside = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const glm::vec2 at(0.0137f * static_cast<float>(i % 500), 0.0151f * static_cast<float>(i / 500));
        above += static_cast<double>(ice_cracks(at, 0.62f, 0.004f, 1.0f, {0, 0}, 0.001f, 41u).y);
        aside += static_cast<double>(ice_cracks(at, 0.62f, 0.004f, 1.0f, {0.01f, 0.0f}, 0.001f, 41u).y);
    }
    EXPECT_EQ(above, 0.0);
    // The mean of |cos| over all ways of borders, 2 / pi, times what there is of them: 2 for each size of a cell.
    EXPECT_NEAR(aside / 200000.0, 0.01 / 0.62 * 2.0 * 0.637, 0.004);
}

TEST(IcePattern, IsWhatIceIsInTheMean)
{
    const glm::vec3 road(0.06f, 0.05f, 0.04f);
    WeatheredMaterial m{};
    m.albedo = road;
    for (const float ice : {0.0f, 0.4f, 1.0f}) {
        const glm::vec3 icy = apply_ice(m, ice).albedo;
        const glm::vec3 same = patterned_ice(icy, ice, kIceWhite), clear = patterned_ice(icy, ice, 0.0f), white = patterned_ice(icy, ice, 1.0f);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(same[c], icy[c], 1e-6f);
            EXPECT_NEAR(clear[c], road[c], 1e-6f);
            EXPECT_NEAR(white[c], road[c] + (ice_color()[c] - road[c]) * ice, 1e-6f);
        }
    }
}

}  // namespace
}  // namespace petrichor::shared
