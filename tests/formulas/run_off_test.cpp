// Water that runs down walls.
#include "formulas/weather/run_off.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formulas/weather/soaked_walls.h"

namespace petrichor::shared {
namespace {

constexpr int kPlaces = 60000;

struct Place {
    float x, y;
};

Place place(int i) { return {300.0f * hash_f(static_cast<uint>(i)), 30.0f * hash_f(static_cast<uint>(i) + 777777u)}; }

TEST(RunOff, IsInTheMeanWhatItIsFromAfar)
{
    double sum = 0.0;
    glm::dvec2 lean(0.0);
    for (int i = 0; i < kPlaces; ++i) {
        const Place p = place(i);
        const RunOff off = run_off(p.x, p.y, 3.0f, 0.0f);
        EXPECT_GE(off.thick, 0.0f);
        EXPECT_LE(off.thick, 1.3f);
        sum += static_cast<double>(off.thick) / kPlaces;
        lean += glm::dvec2(off.lean) / static_cast<double>(kPlaces);
        const RunOff far = run_off(p.x, p.y, 3.0f, 1.0f);
        EXPECT_EQ(far.thick, kRunOffMean);
        EXPECT_EQ(far.lean, glm::vec2(0.0f));
    }
    EXPECT_NEAR(sum, static_cast<double>(kRunOffMean), 0.02);
    EXPECT_NEAR(lean.x, 0.0, 0.01);
    EXPECT_NEAR(lean.y, 0.0, 0.01);
}

TEST(RunOff, StandsInRivuletsWithNothingBetween)
{
    int dry = 0, wet = 0;
    double across = 0.0, down = 0.0;
    for (int i = 0; i < kPlaces; ++i) {
        const Place p = place(i);
        const RunOff here = run_off(p.x, p.y, 3.0f, 0.0f);
        if (here.thick == 0.0f) {
            ++dry;
            EXPECT_EQ(here.lean, glm::vec2(0.0f)) << "no water leans where there is none";
        }
        wet += here.thick > 0.8f ? 1 : 0;
        across += std::abs(static_cast<double>(run_off(p.x + 0.03f, p.y, 3.0f, 0.0f).thick - here.thick));
        down += std::abs(static_cast<double>(run_off(p.x, p.y + 0.03f, 3.0f, 0.0f).thick - here.thick));
    }
    EXPECT_GT(dry, kPlaces / 8);
    EXPECT_GT(wet, kPlaces / 8);
    EXPECT_GT(across, 3.0 * down);
}

// After 0.3 s the waves are where they were, that much lower; up the wall they are not.
TEST(RunOff, CarriesItsWavesDown)
{
    constexpr float kLater_s = 0.3f;
    double below = 0.0, above = 0.0;
    for (int i = 0; i < kPlaces; ++i) {
        const Place p = place(i);
        const float now = run_off(p.x, p.y, 3.0f, 0.0f).lean.y;
        below += std::abs(static_cast<double>(run_off(p.x, p.y - kRunOff_m_s * kLater_s, 3.0f + kLater_s, 0.0f).lean.y - now));
        above += std::abs(static_cast<double>(run_off(p.x, p.y + kRunOff_m_s * kLater_s, 3.0f + kLater_s, 0.0f).lean.y - now));
    }
    EXPECT_LT(below, 0.5 * above);
}

// Bumps of a wall that faces an axis of the world within 45 degrees leave a place along it where it is.
TEST(RunOff, KnowsWallsByTheAxisThatTheyFaceMost)
{
    EXPECT_EQ(along_wall({1.0f, 0.1f, 0.6f}), glm::vec3(0, 0, 1));
    EXPECT_EQ(along_wall({-1.0f, 0.1f, -0.6f}), glm::vec3(0, 0, 1));
    EXPECT_EQ(along_wall({0.3f, -0.2f, 0.9f}), glm::vec3(1, 0, 0));
    EXPECT_EQ(upright(0.0f), 1.0f);
    EXPECT_EQ(upright(-0.8f), 0.0f);
}

}  // namespace
}  // namespace petrichor::shared
