// Rings of drops that are smaller than a pixel: what smaller levels of their map lose is kept. tests/gpu/parity_test.cpp shows that the device
// computes the same, Surface.RingsTooSmallToSeeAreRoughness that it draws so.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "formulas/codec/octahedral.h"
#include "formulas/codec/rough_normal.h"
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
Level rings_of(float rain, int size)
{
    Level level;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / static_cast<float>(size);
            glm::vec2 slope(0.0f);
            for (int i = 0; i < kRippleLayers; ++i) {
                const RippleLayer layer = ripple_layer(i, rain, 3.7f, 1.0f);
                slope += layer.weight * ripple_slope(rain_drops(glm::fract(uv + layer.offset), 0u), layer.clock, layer.weight);
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
        if (rain == 0.0f) EXPECT_LT(all, 5e-5) << "a calm pool is a mirror, but for the last of eight bits";
        before = all;
    }
    RecordProperty("all_lost", std::to_string(before));
    EXPECT_GT(before, 0.006);
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
