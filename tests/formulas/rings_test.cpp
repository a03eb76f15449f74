// Rings of drops that are smaller than a pixel: what smaller levels of their map lose is kept. tests/gpu/parity_test.cpp shows that the device
// computes the same, Surface.RingsTooSmallToSeeAreRoughness that it draws so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "formulas/codec/octahedral.h"
#include "formulas/codec/rough_normal.h"
#include "formulas/weather/drop_births.h"
#include "formulas/weather/ring_sizes.h"
#include "formulas/weather/ripple.h"
#include "formulas/weather/weather_maps.h"

namespace petrichor::shared {
namespace {

using Level = std::vector<RingSlopes>;

float eight_bits(float x) { return std::floor(x * 255.0f + 0.5f) / 255.0f; }
glm::vec2 kept(glm::vec2 lean) { return 2.0f * glm::vec2(eight_bits(0.5f * lean.x + 0.5f), eight_bits(0.5f * lean.y + 0.5f)) - 1.0f; }
float as_kept(float square)
{
    const glm::vec2 code = rings_square_code(square);
    return rings_square_of({eight_bits(code.x), eight_bits(code.y)});
}

// The map of a moment, as ripple.comp.glsl draws it, in numbers of eight bits.
Level rings_of(float rain, int size, float spread = 0.2f, float time_s = 3.7f)
{
    Level level;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / static_cast<float>(size);
            glm::vec2 slope(0.0f);
            for (int i = 0; i < kRippleLayers; ++i) {
                const RippleLayer layer = ripple_layer(i, rain, time_s, 1.0f);
                glm::vec4 drop = rain_drops(glm::fract(uv + layer.offset), 0u);
                drop.w = eight_bits(drop.w);
                slope += layer.weight * sized_ripple_slope(drop, layer, i, spread);
            }
            level.push_back({kept(glm::vec2(glm::normalize(glm::vec3(slope, 1.0f)))), 0.0f});
        }
    }
    return level;
}

Level above(const Level& fine)
{
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(fine.size()))));
    Level coarse;
    for (std::size_t y = 0; y < side; y += 2) {
        for (std::size_t x = 0; x < side; x += 2) {
            const RingSlopes all = rings_of_four(fine[y * side + x], fine[y * side + x + 1], fine[(y + 1) * side + x], fine[(y + 1) * side + x + 1]);
            coarse.push_back({kept(all.lean), as_kept(all.square)});
        }
    }
    return coarse;
}

struct Means {
    double seen = 0.0, lost = 0.0;
};

Means means_of(const Level& level)
{
    Means sum;
    for (const RingSlopes& r : level) {
        sum.seen += static_cast<double>(glm::dot(r.lean, r.lean));
        sum.lost += static_cast<double>(rings_unseen(r.square, r.lean, 1.0f));
    }
    return {sum.seen / static_cast<double>(level.size()), sum.lost / static_cast<double>(level.size())};
}

TEST(Rings, LevelsLoseNothingButWhatIsSeen)
{
    for (const float rain : {0.25f, 0.5f, 1.0f}) {
        Level level = rings_of(rain, 256);
        const Means first = means_of(level);
        ASSERT_GT(first.seen, 1e-4);
        EXPECT_EQ(first.lost, 0.0) << "close up all of them are seen";
        double lost = 0.0;
        while (level.size() > 1) {
            level = above(level);
            const Means here = means_of(level);
            EXPECT_NEAR(here.seen + here.lost, first.seen, 0.01 * first.seen + 1e-5) << rain << ", " << level.size();
            EXPECT_GE(here.lost, 0.98 * lost) << "the farther, the more is lost";
            lost = here.lost;
        }
        EXPECT_GT(lost, 0.95 * first.seen) << "at last all of it";
    }
}

TEST(Rings, AreSteeperTheHarderItRains)
{
    double before = 0.0;
    for (const float rain : {0.0f, 0.05f, 0.15f, 0.3f, 0.5f, 0.75f, 1.0f}) {
        Level level = rings_of(rain, 256);
        while (level.size() > 1) level = above(level);
        const auto all = static_cast<double>(rings_unseen(level[0].square, level[0].lean, 1.0f));
        EXPECT_GE(all, before) << rain;
        if (rain == 0.0f) {
            EXPECT_LT(all, 5e-5) << "a calm pool is a mirror, but for the last of eight bits";
        }
        before = all;
    }
    RecordProperty("all_lost", std::to_string(before));
    EXPECT_GT(before, 0.006);
}

// Drops differ as the largest of a spectrum do; small ones draw weak rings that end early.
TEST(Rings, AreOfDropsOfManySizes)
{
    double before = 0.0;
    for (const float rate : {1.0f, 5.0f, 20.0f, 50.0f, 150.0f}) {
        const float spread = ring_drop_spread(rate, 83.0f * std::min(rate / 12.5f, 4.0f));
        EXPECT_GT(spread, 0.1f) << rate;
        EXPECT_LT(spread, 0.45f) << rate;
        // The least of them, by its definition: as many larger ones meet the water as there are rings.
        const float least_mm = 1.0f / (spread * rain_slope_per_mm(rate));
        if (least_mm > 0.51f) {
            EXPECT_NEAR(rain_hits_per_m2_s(rate, least_mm) / (83.0f * std::min(rate / 12.5f, 4.0f)), 1.0f, 0.01f) << rate;
        }
        EXPECT_GT(least_mm, before) << "the harder it rains, the larger they are";
        before = static_cast<double>(least_mm);
    }
    EXPECT_EQ(ring_drop_spread(0.0f, 80.0f), 0.0f);
    EXPECT_EQ(ring_drop_spread(10.0f, 0.0f), 0.0f);
    float strength = 0.0f, reach = 0.0f;
    for (int i = 0; i < 100; ++i) {
        const RingSize size = ring_size(0.01f * static_cast<float>(i), 0.2f);
        EXPECT_GT(size.strength, strength);
        EXPECT_GE(size.reach, reach);
        EXPECT_LE(size.reach, 1.0f);
        strength = size.strength;
        reach = size.reach;
    }
    EXPECT_GT(strength, 2.5f * ring_size(0.0f, 0.2f).strength);
    EXPECT_LT(ring_size(0.0f, 0.2f).reach, 0.85f);
    const RingSize alike = ring_size(0.7f, 0.0f);
    EXPECT_EQ(alike.strength, 1.0f);
    EXPECT_EQ(alike.reach, 1.0f);
}

// Without a spread they are those of one size; with one they are as steep all together.
TEST(Rings, OfManySizesAreAsSteepAllTogether)
{
    for (int i = 0; i < 200; ++i) {
        const float u = static_cast<float>(i) / 200.0f;
        const RippleLayer layer = ripple_layer(i % 4, 1.0f, 7.0f * u, 1.0f);
        const glm::vec4 drop(u, 0.5f + 0.5f * std::cos(9.0f * u), 0.5f + 0.5f * std::sin(9.0f * u), 0.3f);
        EXPECT_LT(glm::length(sized_ripple_slope(drop, layer, i % 4, 0.0f) - ripple_slope(drop, layer.clock, layer.weight)), 1e-6f);
    }
    double alike = 0.0, sized = 0.0;
    for (const float time_s : {0.3f, 1.7f, 3.1f, 8.4f, 12.0f, 20.9f, 31.3f, 44.0f}) {
        alike += means_of(rings_of(1.0f, 128, 0.0f, time_s)).seen;
        sized += means_of(rings_of(1.0f, 128, 0.2f, time_s)).seen;
    }
    EXPECT_NEAR(sized / alike, 1.0, 0.1);
}

// A place has a strong ring now and a weak one then.
TEST(Rings, OfAPlaceDifferFromDropToDrop)
{
    float least = 10.0f, most = 0.0f;
    for (int turn = 0; turn < 60; ++turn) {
        RippleLayer layer = ripple_layer(0, 1.0f, 0.0f, 1.0f);
        layer.clock = 0.2f;
        layer.begun = static_cast<float>(turn);
        const float slope = glm::length(sized_ripple_slope({0.87f, 1.0f, 0.5f, 0.0f}, layer, 0, 0.2f));
        least = std::min(least, slope);
        most = std::max(most, slope);
    }
    EXPECT_GT(least, 0.0f);
    EXPECT_GT(most, 2.2f * least);
}

TEST(Rings, OfTexelsThatAreAlikeNothingMoreIsLost)
{
    const RingSlopes same{{0.2f, -0.1f}, 0.09f};
    const RingSlopes all = rings_of_four(same, same, same, same);
    EXPECT_NEAR(all.square, 0.09f, 1e-7f);
    EXPECT_NEAR(rings_unseen(all.square, all.lean, 1.0f), 0.04f, 1e-7f);
    // What fades from afar goes where what is too small has gone.
    EXPECT_NEAR(rings_unseen(all.square, all.lean, 0.0f), 0.09f, 1e-7f);
    EXPECT_EQ(rings_unseen(0.01f, all.lean, 1.0f), 0.0f) << "never less than nothing";
}

TEST(RoughNormal, KeepsBothAndOfASmoothOneAllBits)
{
    for (int i = 0; i < 400; ++i) {
        const float turn = 0.37f * static_cast<float>(i);
        const float lean = 1.5f * static_cast<float>(i) / 400.0f;
        const glm::vec3 n = glm::normalize(glm::vec3(std::sin(lean) * std::cos(turn), std::cos(lean), std::sin(lean) * std::sin(turn)));
        const glm::vec2 octahedral = octahedral_encode(n);
        const auto kept = [](glm::vec2 code) { return glm::floor(code * 32767.0f + 0.5f) / 32767.0f; };
        for (int k = 0; k <= 255; k += 1 + i % 7) {
            const float roughness = static_cast<float>(k) / 255.0f;
            const glm::vec2 code = kept(rough_normal_code(octahedral, roughness));
            EXPECT_NEAR(roughness_of_normal(code), roughness, 1e-6f) << k;
            EXPECT_LT(glm::length(octahedral_decode(code) - n), k == 0 ? 2e-4f : 3e-3f);
            EXPECT_LE(std::abs(code.x - octahedral.x), (k == 0 ? 1.6f : 32.6f) / 32767.0f);
            EXPECT_LE(std::abs(code.y - octahedral.y), (k == 0 ? 0.6f : 16.6f) / 32767.0f);
        }
    }
    // Corners of the code, and what is no roughness.
    for (const float x : {-1.0f, 1.0f}) {
        EXPECT_EQ(roughness_of_normal(rough_normal_code({x, x}, 0.0f)), 0.0f);
        EXPECT_EQ(roughness_of_normal(rough_normal_code({x, x}, -3.0f)), 0.0f);
        EXPECT_EQ(roughness_of_normal(rough_normal_code({x, x}, 7.0f)), 1.0f);
        EXPECT_LE(std::abs(rough_normal_code({x, x}, 0.5f).x), 1.0f);
    }
}

}  // namespace
}  // namespace petrichor::shared
