// Drops on what water does not spread on.
#include <gtest/gtest.h>

#include <cmath>

#include "formulas/light/wet_lens.h"
#include "formulas/weather/beads.h"

namespace petrichor::shared {
namespace {

constexpr float kFine_m = 0.0001f;  // pixels that show every bead

// Share of a plane of 20 x 20 cm through the origin that is covered.
float covered(glm::vec3 normal, float amount, float pouring, float time_s, float pixel_m = kFine_m)
{
    const glm::vec3 u = glm::normalize(glm::cross(normal, glm::vec3(0.2f, 0.9f, 0.1f)));
    const glm::vec3 v = glm::cross(normal, u);
    float sum = 0.0f;
    constexpr int kSide = 200;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const glm::vec3 at = 0.001f * (static_cast<float>(x) * u + static_cast<float>(y) * v);
            sum += beads_on(at, normal, amount, pouring, pixel_m, time_s).cover;
        }
    }
    return sum / (kSide * kSide);
}

TEST(Beads, GrowWithTheFilmAndLeaveRoomBetween)
{
    for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1),
                              glm::normalize(glm::vec3(1, 2, -0.5))}) {
        EXPECT_EQ(covered(n, 0.0f, 0.0f, 0.0f), 0.0f);
        float before = 0.0f;
        for (const float amount : {0.25f, 0.5f, 0.75f, 1.0f}) {
            const float now = covered(n, amount, 0.0f, 0.0f);
            EXPECT_GT(now, before) << amount;
            before = now;
        }
        EXPECT_GT(before, 0.12f);
        EXPECT_LT(before, 0.55f);
    }
}

// As much of every plane, however it lies: there is no lattice to be seen.
TEST(Beads, AreAsManyOnEveryPlane)
{
    const float one = covered(glm::vec3(0, 0, 1), 1.0f, 0.0f, 0.0f);
    for (const glm::vec3 n : {glm::vec3(1, 0, 0), glm::normalize(glm::vec3(1, 0, 1)),
                              glm::normalize(glm::vec3(3, 0, -1))})
        EXPECT_NEAR(covered(n, 1.0f, 0.0f, 0.0f), one, 0.3f * one);
}

TEST(Beads, LeanAlongTheSurfaceAndAwayFromTheirMiddle)
{
    const glm::vec3 n = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
    int inside = 0;
    glm::vec3 sum(0.0f);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 at =
            0.3f * glm::vec3(std::fmod(0.618034f * static_cast<float>(i), 1.0f), 0.0f,
                             std::fmod(0.754878f * static_cast<float>(i), 1.0f));
        const glm::vec3 on = at - n * glm::dot(at, n);
        const Beads b = beads_on(on, n, 1.0f, 0.0f, kFine_m, 0.0f);
        if (b.cover < 0.5f) continue;
        ++inside;
        sum += b.lean;
        EXPECT_NEAR(glm::dot(b.lean, n), 0.0f, 1e-4f);
        EXPECT_LE(glm::length(b.lean), kBeadLean * 1.001f);
        EXPECT_NEAR(glm::length(bead_normal(b, n)), 1.0f, 1e-5f);
        EXPECT_GT(glm::dot(bead_normal(b, n), n), 0.5f);
    }
    EXPECT_GT(inside, 2000);
    EXPECT_LT(glm::length(sum) / static_cast<float>(inside), 0.03f);  // to all sides alike
}

TEST(Beads, StayWhereTheyAreAndDropsRunDown)
{
    const glm::vec3 wall(0, 0, 1);
    EXPECT_EQ(covered(wall, 1.0f, 0.0f, 0.0f), covered(wall, 1.0f, 0.0f, 7.0f));
    EXPECT_GT(covered(wall, 1.0f, 1.0f, 0.0f), covered(wall, 1.0f, 0.0f, 0.0f) * 0.8f);
    EXPECT_EQ(covered(glm::vec3(0, 1, 0), 1.0f, 1.0f, 0.0f),
              covered(glm::vec3(0, 1, 0), 1.0f, 0.0f, 0.0f));
    // The head of a drop is where it was, a little lower.
    for (std::uint32_t seed = 1; seed < 20; ++seed) {
        const auto head_m = [&](float time_s) {
            float lowest = 1.0f;
            for (int k = 0; k < 1800; ++k) {
                const float y = 0.0005f * static_cast<float>(k);
                for (int x = 0; x < 45; ++x) {
                    if (running_drop({0.001f * static_cast<float>(x), y}, time_s, 2.0f, seed)
                            .cover > 0.5f)
                        lowest = std::min(lowest, y);
                }
            }
            return lowest;
        };
        const float now = head_m(1.0f), later = head_m(1.1f);
        if (now > 0.1f && now < 0.85f) {
            EXPECT_LE(later, now) << seed;
            EXPECT_GT(later, now - 0.05f) << seed;
        }
    }
}

TEST(Beads, AreAFilmFromAfarAndOnWhatDrinksThem)
{
    EXPECT_EQ(covered(glm::vec3(0, 1, 0), 1.0f, 0.0f, 0.0f, 0.02f), 0.0f);
    EXPECT_EQ(bead_seen(kMiddleBead_m, 0.0f), 1.0f);
    EXPECT_EQ(beading_share(1.0f, 0.0f), 1.0f);
    EXPECT_EQ(beading_share(1.0f, 1.0f), 0.0f);
}

TEST(LensDrops, AreThereWhileItIsWetAndTurnThePictureRound)
{
    const auto share = [](float amount, float time_s) {
        int inside = 0;
        for (int i = 0; i < 10000; ++i) {
            const glm::vec2 p(static_cast<float>(i % 100) / 100.0f - 0.5f,
                              static_cast<float>(i / 100) / 100.0f - 0.5f);
            const LensDrop d = lens_drops(p, amount, time_s);
            EXPECT_LE(glm::length(d.shift), kLensDropShift * 1.001f);
            EXPECT_GE(d.bright, 0.5f);
            inside += d.cover > 0.5f;
        }
        return static_cast<float>(inside) / 10000.0f;
    };
    for (const float time_s : {0.0f, 3.1f, 100.0f}) {
        EXPECT_EQ(share(0.0f, time_s), 0.0f);
        EXPECT_GT(share(1.0f, time_s), 0.02f);
        EXPECT_LT(share(1.0f, time_s), 0.5f);
    }
}

}  // namespace
}  // namespace petrichor::shared
