// Where water stands, snow lies and hoar grows: laws and table values.
// tests/gpu/parity_test.cpp shows that the device computes the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formulas/weather/falls_here.h"
#include "formulas/weather/ground_relief.h"
#include "formulas/weather/surface_weather.h"
#include "formulas/weather/weather_maps.h"

namespace petrichor::shared {
namespace {

TEST(WaterCover, FillsFromTheLowestPlaceUp)
{
    for (float level = 0.0f; level <= 1.0f; level += 0.1f) {
        float before = 2.0f;
        for (float height = 0.0f; height <= 1.0f; height += 0.05f) {
            const WaterCover c = water_cover(glm::vec2(level, 0.0f), height, 1.0f, 1.0f, 0.5f);
            EXPECT_LE(c.anywhere, before);
            EXPECT_GE(c.anywhere, 0.0f);
            before = c.anywhere;
        }
    }
    EXPECT_EQ(water_cover(glm::vec2(0.0f), 0.0f, 1.0f, 1.0f, 0.5f).anywhere, 0.0f);
    EXPECT_EQ(water_cover(glm::vec2(1.0f), 0.0f, 1.0f, 1.0f, 0.5f).anywhere, 1.0f);
}

TEST(WaterCover, APondHasAShoreAsRaggedAsItsGround)
{
    for (float stands = 0.0f; stands <= 0.03f; stands += 0.005f) {
        EXPECT_EQ(pond_cover(0.0f, stands).anywhere, 0.0f);
        EXPECT_EQ(pond_cover(-1.0f, -0.5f).anywhere, 0.0f) << "none above the water, however low the relief";
        float before = 0.0f;
        for (float depth = 0.0f; depth <= 0.06f; depth += 0.001f) {
            const WaterCover c = pond_cover(depth, stands);
            EXPECT_GE(c.anywhere, before);
            EXPECT_LE(c.deep, c.anywhere + 1e-6f) << "what is deep stands";
            EXPECT_LE(c.anywhere, pond_cover(depth, 0.0f).anywhere) << "hollows of the relief fill first";
            if (depth <= stands) {
                EXPECT_EQ(c.anywhere, 0.0f) << "stones stand out";
            }
            if (depth >= stands + 0.0095f) {
                EXPECT_EQ(c.deep, 1.0f) << "and drown";
            }
            before = c.anywhere;
        }
    }
}

TEST(WaterCover, HandComputedValues)
{
    // cracks 0.6 - 0.2 = 0.4; puddles (0.8 - 0.2) / 0.4 = 1 after clamping.
    const WaterCover c = water_cover(glm::vec2(0.6f, 0.8f), 0.2f, 1.0f, 1.0f, 0.5f);
    EXPECT_FLOAT_EQ(c.anywhere, 1.0f);
    EXPECT_FLOAT_EQ(c.deep, 1.0f);
    // No puddle mask: cracks alone.
    const WaterCover d = water_cover(glm::vec2(0.6f, 0.8f), 0.2f, 0.0f, 1.0f, 0.5f);
    EXPECT_FLOAT_EQ(d.anywhere, 0.4f);
    EXPECT_FLOAT_EQ(d.deep, 0.04f);
    // A wall sheds its water: slope factor 1 - damp = 0 at full damp.
    EXPECT_EQ(water_cover(glm::vec2(1.0f), 0.0f, 1.0f, 0.0f, 1.0f).anywhere, 0.0f);
}

// From afar the hollows of the ground are no wider than a pixel, whose mean is dry: it has their water all the same.
TEST(WaterCover, OfAWidePixelIsThatOfItsPlaces)
{
    double worst = 0.0, worst_by_mean = 0.0;
    for (float flood = 0.2f; flood <= 2.0f; flood += 0.2f) {
        double places = 0.0, parts = 0.0;
        const int count = 20000;
        for (int i = 0; i < count; ++i) {
            const vec2 at(4000.0f * hash_f(static_cast<uint>(i)), 4000.0f * hash_f(static_cast<uint>(i) + 55555u));
            const auto water = [&](float relief, float blurred) {
                return static_cast<double>(water_cover_of_mean(vec2(0.0f, flood), 0.25f + kGroundRelief * relief, 1.0f, 1.0f,
                                                               0.5f, kGroundRelief * blurred).anywhere);
            };
            places += water(ground_relief(at), 0.0f);
            parts += water(ground_relief_seen(at, 2.2f, 1.0f), ground_relief_blurred(2.2f));
        }
        const auto wide = [&](float blurred) {
            return static_cast<double>(water_cover_of_mean(vec2(0.0f, flood), 0.25f + kGroundRelief * 0.498f, 1.0f, 1.0f, 0.5f,
                                                           kGroundRelief * blurred).anywhere);
        };
        places /= count;
        EXPECT_NEAR(wide(ground_relief_blurred(100.0f)), places, 0.04) << flood;
        EXPECT_NEAR(parts / count, places, 0.04) << flood;
        worst = std::max(worst, std::abs(wide(ground_relief_blurred(100.0f)) - places));
        worst_by_mean = std::max(worst_by_mean, std::abs(wide(0.0f) - places));
    }
    EXPECT_LT(worst, 0.3 * worst_by_mean);
    EXPECT_EQ(ground_relief_seen(vec2(3.0f, 7.0f), 0.0f, 1.0f), 0.498f + (ground_relief(vec2(3.0f, 7.0f)) - 0.498f));
    EXPECT_EQ(ground_relief_blurred(0.0f), 0.0f);
}

TEST(SnowCover, NothingWithoutSnowEverythingWithMuch)
{
    for (float noise = 0.0f; noise <= 1.0f; noise += 0.1f) {
        EXPECT_EQ(snow_cover(0.0f, 1.0f, 1.0f, 0.75f, 1.0f, noise, 1.0f, 0.0f, 0.0f).snow, 0.0f);
    }
    EXPECT_NEAR(snow_cover(1.0f, 1.0f, 1.0f, 0.75f, 1.0f, 0.5f, 0.5f, 0.0f, 0.0f).snow, 1.0f, 1e-6f);
    EXPECT_EQ(snow_cover(1.0f, 0.0f, 1.0f, 0.75f, 1.0f, 0.9f, 0.9f, 0.0f, 0.0f).snow, 0.0f)
        << "below the snow line";
    EXPECT_EQ(snow_cover(1.0f, 1.0f, 1.0f, 0.75f, 0.0f, 0.9f, 0.9f, 0.0f, 0.0f).snow, 0.0f)
        << "masked out";
}

// The masks that a pixel sees from afar are means; its cover must be that of the places below it all the same.
TEST(SnowCover, OfAWidePixelIsThatOfItsPlaces)
{
    const vec2 tiling(0.09f, 0.83f);
    double worst = 0.0, worst_by_mean = 0.0;
    for (int k = 1; k < 10; ++k) {
        const float amount = 0.1f * static_cast<float>(k);
        double places = 0.0, detail_lost = 0.0;
        const int count = 20000;
        for (int i = 0; i < count; ++i) {
            const vec2 at(111.0f * hash_f(static_cast<uint>(i)), 111.0f * hash_f(static_cast<uint>(i) + 99999u));
            const float mask = snow_texel(at * tiling.x, 1.0f / 512.0f).z;
            const float detail = snow_texel(at * tiling.y, 1.0f / 512.0f).z;
            places += static_cast<double>(snow_cover(amount, 1.0f, 1.0f, 0.75f, 1.0f, mask, detail, 0.0f, 0.0f).snow);
            detail_lost += static_cast<double>(snow_cover(amount, 1.0f, 1.0f, 0.75f, 1.0f, mask, 0.7067f, 0.0f,
                                                          snow_mask_blurred(1.0f, vec2(0.0f, tiling.y))).snow);
        }
        places /= count;
        detail_lost /= count;
        const auto wide = [&](float blurred) {
            return static_cast<double>(snow_cover(amount, 1.0f, 1.0f, 0.75f, 1.0f, 0.7067f, 0.7067f, 0.0f, blurred).snow);
        };
        EXPECT_NEAR(wide(snow_mask_blurred(300.0f, tiling)), places, 0.05) << amount;
        EXPECT_NEAR(detail_lost, places, 0.05) << amount;
        worst = std::max(worst, std::abs(wide(snow_mask_blurred(300.0f, tiling)) - places));
        worst_by_mean = std::max(worst_by_mean, std::abs(wide(0.0f) - places));
    }
    EXPECT_LT(worst, 0.3 * worst_by_mean);
    EXPECT_LT(snow_mask_blurred(0.01f, tiling), 0.01f) << "near the eye nothing is lost";
}

// Ground flatter than repose holds snow as level ground does; a wall has no more than it had.
TEST(SnowCover, RestsOnSlopesUnderRepose)
{
    const auto at = [](float degrees) {
        const float up = std::cos(degrees * 0.017453293f);
        return snow_cover(0.5f, 1.0f, up + snow_rests(up), 0.75f, 1.0f, 0.7f, 0.7f, 0.0f, 0.0f).snow;
    };
    EXPECT_FLOAT_EQ(at(39.9f), at(0.0f));
    float before = at(0.0f);
    for (float degrees = 0.0f; degrees <= 90.0f; degrees += 1.0f) {
        EXPECT_LE(at(degrees), before + 1e-6f);
        before = at(degrees);
    }
    EXPECT_GT(at(50.0f), 0.5f * at(0.0f));
    EXPECT_EQ(at(70.0f), 0.0f);
    EXPECT_NEAR(snow_rests(0.0f), 0.0f, 1e-6f);
}

// Over a wide land at one height the line runs up and down: as often snow as none at its middle, never beyond its reach.
TEST(SnowCover, TheLineIsRaggedWithinItsReach)
{
    int above = 0, below = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 at(9.7f * static_cast<float>(i), 500.0f, 61.0f * static_cast<float>(i % 31));
        const float z = snow_line_factor(at, 500.0f, 20.0f, 1.0f);
        above += z > 0.0f ? 1 : 0;
        below += z == 0.0f ? 1 : 0;
        EXPECT_EQ(snow_line_factor(at, 561.0f, 20.0f, 1.0f), 0.0f);
        EXPECT_EQ(snow_line_factor(at, 439.0f, 20.0f, 1.0f), 1.0f);
        EXPECT_EQ(snow_line_factor(at, 490.0f, 20.0f, 0.0f), snow_height_factor(500.0f, 490.0f, 20.0f));
        EXPECT_LE(std::abs(snow_line_noise(glm::vec2(at.x, at.z), 20.0f)), 1.0f);
        // It is steady: no step from one centimetre to the next.
        const glm::vec3 next = at + glm::vec3(0.01f, 0.0f, 0.0f);
        EXPECT_NEAR(snow_line_noise(glm::vec2(at.x, at.z), 20.0f), snow_line_noise(glm::vec2(next.x, next.z), 20.0f), 0.01f);
    }
    EXPECT_GT(above, 700);
    EXPECT_GT(below, 700);
}

TEST(SnowCover, GrowsWithAmountAndFlatness)
{
    float before = 0.0f;
    for (float amount = 0.0f; amount <= 1.0f; amount += 0.02f) {
        const float now = snow_cover(amount, 1.0f, 1.0f, 0.75f, 1.0f, 0.7f, 0.8f, 0.0f, 0.0f).snow;
        EXPECT_GE(now, before - 1e-6f);
        before = now;
    }
    before = 0.0f;
    for (float up = -1.0f; up <= 1.0f; up += 0.05f) {
        const float now = snow_cover(0.7f, 1.0f, up, 1.0f, 1.0f, 0.8f, 0.9f, 0.0f, 0.0f).snow;
        EXPECT_GE(now, before - 1e-6f);
        before = now;
    }
}

TEST(FallsHere, SharesAreWholeInTheOpenAndNoneWhereNothingFalls)
{
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    EXPECT_EQ(facing_share(up, glm::normalize(glm::vec3(0.5f, 1.0f, 0.2f))), 1.0f);
    // scene-weather 2: k = .91505, roof of 30 degrees windward 1.3236 R, lee .4085, wall .9151.
    const glm::vec3 from = glm::normalize(glm::vec3(0.91505f, 1.0f, 0.0f));
    EXPECT_NEAR(facing_share({0.5f, 0.866025f, 0.0f}, from), 1.3236f, 1e-3f);
    EXPECT_NEAR(facing_share({-0.5f, 0.866025f, 0.0f}, from), 0.4085f, 1e-3f);
    EXPECT_NEAR(facing_share({1.0f, 0.0f, 0.0f}, from), 0.9151f, 1e-3f);
    EXPECT_EQ(facing_share({-1.0f, 0.0f, 0.0f}, from), 0.0f);
    for (const auto share : {film_share, flood_share}) {
        EXPECT_EQ(share(0.0f), 0.0f);
        EXPECT_NEAR(share(1.0f), 1.0f, 1e-4f);
        EXPECT_GT(share(0.3f), 0.3f) << "wet sooner than in proportion";
    }
    for (const float share : {0.0f, 0.02f, 0.3f, 1.0f, 2.5f}) {
        const FallShares both = fall_shares(share);
        EXPECT_NEAR(both.film, film_share(share), 1e-6f);
        EXPECT_NEAR(both.flood, flood_share(share), 1e-6f);
    }
    EXPECT_NEAR(cover_of_share(0.6f, 1.0f), 0.6f, 1e-6f);
    EXPECT_EQ(cover_of_share(0.6f, 0.0f), 0.0f);
    // Half the snow: the cover of half the depth, by 1 - exp(-depth).
    EXPECT_NEAR(cover_of_share(0.75f, 0.5f), 0.5f, 1e-6f);
}

TEST(LevelGround, HoldsWaterAndSlopesShedIt)
{
    const auto up = [](float degrees) { return std::cos(degrees * 0.017453293f); };
    EXPECT_EQ(level_ground(up(0.0f)), 1.0f);
    EXPECT_GT(level_ground(up(1.4f)), 0.99f);
    EXPECT_EQ(level_ground(up(6.1f)), 0.0f);
    EXPECT_EQ(level_share(up(10.0f), 1.0f), 1.0f) << "a stone below the water does not tilt it";
    EXPECT_EQ(level_share(up(60.0f), 1.0f), 0.0f);
    EXPECT_EQ(level_share(1.0f, 0.0f), 0.0f);
}

// Wide ground has its snow shared out, none lost; where a model stands nothing changes.
TEST(GroundRelief, WindSharesOutTheSnowOfWideGround)
{
    EXPECT_EQ(drifted_share(vec2(0.0f)), 1.0f);
    EXPECT_EQ(drifted_share(vec2(20.0f, -15.0f)), 1.0f);
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (float x = -9000.0f; x < 9000.0f; x += 41.0f) {
        for (float z = 200.0f; z < 9000.0f; z += 41.0f) {
            const double share = static_cast<double>(drifted_share(vec2(x, z)));
            ASSERT_GE(share, 0.399);
            ASSERT_LE(share, 1.601);
            sum += share;
            squares += share * share;
            ++count;
        }
    }
    const double mean = sum / count;
    EXPECT_NEAR(mean, 1.0, 0.02);
    EXPECT_GT(std::sqrt(squares / count - mean * mean), 0.15);
}

// Deep snow hides the ground wherever the wind left some of it.
TEST(GroundRelief, DeepSnowCoversWhatTheWindHasThinned)
{
    for (float x = -9000.0f; x < 9000.0f; x += 407.0f) {
        const vec2 at(x, 700.0f);
        float before = drifted_share(at);
        EXPECT_EQ(drifted_cover(at, 0.0f), before);
        for (const float deep_m : {0.01f, 0.03f, 0.06f, 0.11f}) {
            const float cover = drifted_cover(at, deep_m);
            EXPECT_GE(cover, before);
            before = cover;
        }
        EXPECT_GE(before, 1.0f);
    }
}

// Fresh snow swells, and is smooth where a hand is wide: most of its slope is of waves of half a metre.
TEST(SnowRelief, IsSmoothAtTheWidthOfAHand)
{
    double fine = 0.0, all = 0.0;
    const float step = 1.0f / 512.0f, hand = 1.0f / 28.0f;  // of a tile of 2.9 m: 6 mm, 10 cm
    for (int k = 0; k < 4000; ++k) {
        const vec2 at(hash_f(static_cast<uint>(k)), hash_f(static_cast<uint>(k) + 77777u));
        const auto slope = [&](float over) {
            return static_cast<double>(snow_relief(at + vec2(0.5f * over, 0.0f), 0u) -
                                       snow_relief(at - vec2(0.5f * over, 0.0f), 0u)) /
                   static_cast<double>(over);
        };
        const double here = slope(step), wide = slope(hand);
        all += here * here;
        fine += (here - wide) * (here - wide);
    }
    EXPECT_LT(fine, 0.3 * all);
    EXPECT_NEAR(std::sqrt(all / 4000.0) * static_cast<double>(kSnowSteepness), 0.09, 0.03);
}

TEST(GroundRelief, SpreadsOverItsRangeAndLeavesAThirdToWater)
{
    int low = 0, below = 0;
    const int side = 160;
    for (int i = 0; i < side * side; ++i) {
        const float h = ground_relief(
            {0.37f * static_cast<float>(i % side) - 21.0f, 0.37f * static_cast<float>(i / side)});
        EXPECT_GE(h, 0.0f);
        EXPECT_LE(h, 1.0f);
        low += 0.25f + kGroundRelief * h < 1.0f ? 1 : 0;
        below += h < 0.5f ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<float>(below) / (side * side), 0.5f, 0.08f);
    const float wet = static_cast<float>(low) / (side * side);
    EXPECT_GT(wet, 0.1f);
    EXPECT_LT(wet, 0.4f);
}

TEST(FrostCover, IsThickestOnEdgesAndNoneWithoutFrost)
{
    for (const float crystals : {0.0f, 0.5f, 1.0f}) {
        EXPECT_EQ(frost_cover(0.0f, crystals, 1.0f), 0.0f);
        EXPECT_GE(frost_cover(0.5f, crystals, 1.0f), frost_cover(0.5f, crystals, 0.0f));
        EXPECT_GE(frost_cover(0.8f, crystals, 0.3f), frost_cover(0.4f, crystals, 0.3f));
    }
    EXPECT_EQ(frost_cover(1.0f, 0.5f, 1.0f), 1.0f);
    EXPECT_LT(frost_cover(1.0f, 0.1f, 0.0f), 0.3f) << "bare between the crystals of a smooth plate";
}

}  // namespace
}  // namespace petrichor::shared
