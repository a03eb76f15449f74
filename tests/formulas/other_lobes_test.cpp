// Skin, hair, light that comes through, and the lobes of other programs: known values and laws.
#include "formulas/light/other_lobes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formulas/light/skin.h"
#include "formulas/light/translucent.h"

namespace petrichor::shared {
namespace {

using glm::vec3;

const vec3 kUp(0, 0, 1);

vec3 direction(float up, float turn)
{
    const float level = std::sqrt(std::max(1.0f - up * up, 0.0f));
    return {level * std::cos(turn), level * std::sin(turn), up};
}

// Share of the light from all around that goes towards the eye.
template <class F>
double albedo_of(const F& shade)
{
    const int rows = 400, columns = 400;
    double sum = 0.0;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const float up = (static_cast<float>(i) + 0.5f) / rows;
            const float turn = (static_cast<float>(j) + 0.5f) / columns * 6.2831853f;
            sum += static_cast<double>(shade(direction(up, turn)));
        }
    }
    return sum * 2.0 * 3.14159265358979 / (rows * columns);
}

struct Random {
    std::mt19937 numbers{11};
    float operator()() { return static_cast<float>(numbers() >> 8) / 16777216.0f; }
};

TEST(OtherLobes, TheMinimalistOneHasItsKnownAlbedo)
{
    struct Row {
        float roughness, low, middle, high;  // at nv = 0.2, 0.5, 1
    };
    for (const Row& row : {Row{0.3f, 0.851f, 1.583f, 1.626f}, Row{0.5f, 0.807f, 1.046f, 1.097f},
                           Row{0.7f, 0.643f, 0.641f, 0.612f}, Row{1.0f, 0.403f, 0.300f, 0.205f}}) {
        for (const auto& [nv, expected] :
             {std::pair{0.2f, row.low}, std::pair{0.5f, row.middle}, std::pair{1.0f, row.high}}) {
            const double all = albedo_of([&, v = direction(nv, 0.3f)](const vec3& l) {
                return shade_lwrp(kUp, v, l, vec3(0.0f), vec3(1.0f), row.roughness * row.roughness).x;
            });
            EXPECT_NEAR(all, expected, 0.01) << row.roughness << " " << nv;
        }
    }
}

TEST(OtherLobes, BurleysDiffuseHasItsKnownAlbedo)
{
    for (const auto& [nv, expected] : {std::pair{1.0f, 1.04}, std::pair{0.1f, 1.38}}) {
        const double all = albedo_of([&, v = direction(nv, 0.0f)](const vec3& l) {
            return shade_burley(kUp, v, l, vec3(1.0f), vec3(0.0f), 1.0f).x;
        });
        EXPECT_NEAR(all, expected, 0.01) << nv;
    }
}

TEST(OtherLobes, LuxIsItsFormulaAndWithoutRedHasNoHighlight)
{
    // nl = nv = nh = lh = 1, p = 0.5: alpha 0.25; D = 1 / (pi alpha^2), V = 0.5 / (2 + 1e-5).
    const vec3 seen = shade_lux(kUp, kUp, kUp, vec3(0.6f), vec3(0.04f), 0.5f);
    const float a2 = 0.0625f;
    const float distribution = a2 / (3.14159265f * (a2 * a2 + 1e-7f));
    const float expected = 0.6f + 0.04f * 3.14159265f * distribution * 0.25f;
    EXPECT_NEAR(seen.x * 3.14159265f, expected, 1e-3f);
    const vec3 grass = shade_lux(kUp, kUp, kUp, vec3(0.6f), vec3(0.0f, 0.04f, 0.04f), 0.5f);
    EXPECT_NEAR(grass.y * 3.14159265f, 0.6f, 1e-5f) << "red alone decides";
}

TEST(OtherLobes, AreReciprocal)
{
    Random unit;
    for (int k = 0; k < 10000; ++k) {
        const vec3 v = direction(0.05f + 0.95f * unit(), 6.2831853f * unit());
        const vec3 l = direction(0.05f + 0.95f * unit(), 6.2831853f * unit());
        const vec3 t = direction(0.0f, 6.2831853f * unit());
        const float rough = 0.2f + 0.8f * unit();
        const float shift = 0.3f * unit();
        const vec3 grey(0.3f, 0.5f, 0.7f);
        const auto both = [&](const vec3& eye, const vec3& light) {
            return (shade_lwrp(kUp, eye, light, grey, vec3(0.04f), rough * rough) +
                    shade_burley(kUp, eye, light, grey, vec3(0.04f), rough) +
                    shade_hair(kUp, t, eye, light, grey, grey, vec3(0.04f, 0.3f, 0.6f), rough, shift)) /
                   light.z;
        };
        const vec3 there = both(v, l), back = both(l, v);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(there[c], back[c], 2e-3f * there[c] + 1e-5f) << k;
    }
}

TEST(OtherLobes, HairSendsOutNoMoreThanComesInAndIsBrightAcrossItsStrands)
{
    for (const float up : {0.2f, 0.5f, 1.0f}) {
        for (const float rough : {0.3f, 0.6f, 1.0f}) {
            for (const float turn : {0.0f, 0.8f, 1.57f}) {
                const vec3 v = direction(up, turn);
                const double all = albedo_of([&](const vec3& l) {
                    return shade_hair(kUp, {1, 0, 0}, v, l, vec3(0.4f), vec3(1.0f), vec3(kHairReflectance), rough, 0.1f).x;
                });
                EXPECT_LE(all, 1.01) << up << " " << rough << " " << turn;
                EXPECT_GT(all, 0.3) << up << " " << rough << " " << turn;
            }
        }
    }
    // Light moved across the strands keeps the highlight, moved along them leaves it.
    const auto seen = [](float turn) {
        return shade_hair(kUp, {1, 0, 0}, kUp, direction(0.8f, turn), vec3(0.0f), vec3(0.0f), vec3(kHairReflectance), 0.4f, 0.05f).x;
    };
    EXPECT_GT(seen(1.5707963f), 3.0f * seen(0.0f));
}

TEST(OtherLobes, LazarovsFitIsItself)
{
    const vec2 ab = lazarov_split_sum(0.5f, 0.5f);
    EXPECT_NEAR(ab.x, 0.7032f, 1e-3f);
    EXPECT_NEAR(ab.y, 0.0218f, 1e-3f);
    // It was fitted to another visibility: darker than the table for rough metal (0.8349 + 0.0223 there).
    EXPECT_LT(ab.x + ab.y, 0.8f);
}

TEST(Skin, FlatSkinIsMattAndRoundSkinBleedsRed)
{
    for (const float nl : {-0.5f, 0.0f, 0.3f, 1.0f}) EXPECT_EQ(skin_ring(nl, 0.0f).x, std::max(nl, 0.0f));
    // Lux 2.02's table, 0..255, at the terminator and a quarter on either side.
    struct Row {
        float nl, curvature;
        vec3 expected;
    };
    for (const Row& row : {Row{0.0f, 1.0f, {40, 13, 8}}, Row{0.25f, 1.0f, {78, 65, 64}},
                           Row{-0.25f, 1.0f, {23, 2, 0}}, Row{0.0f, 0.5f, {26, 7, 5}}}) {
        const vec3 seen = 255.0f * skin_ring(row.nl, row.curvature);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], row.expected[c], 1.5f) << row.nl << " " << row.curvature << " " << c;
    }
}

TEST(Skin, LightThatBleedsIsNotGained)
{
    for (const float curvature : {0.05f, 0.3f, 1.0f}) {
        vec3 sum(0.0f);
        const int steps = 720;
        for (int i = 0; i < steps; ++i)
            sum += skin_ring(std::cos(6.2831853f * (static_cast<float>(i) + 0.5f) / steps), curvature);
        sum *= 6.2831853f / steps / 2.0f;  // around a ring a cosine is 2
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], 1.0f, 0.01f) << curvature << " " << c;
    }
}

TEST(Translucency, GlowsTowardsTheLampAndWrapsAroundLeaves)
{
    Translucency t{0.5f, 4.0f, 0.0f, 4.0f, 0.7f, vec3(1.0f)};
    // Straight through: 2^0; from the eye's side 2^-4.
    EXPECT_NEAR(light_through(t, kUp, kUp, -kUp) * 3.14159265f, 2.0f, 1e-5f);
    EXPECT_NEAR(light_through(t, kUp, kUp, kUp) * 3.14159265f, 2.0f / 16.0f, 1e-5f);
    EXPECT_NEAR(shadow_through(t, 0.0f), 0.15f, 1e-6f) << "(1 - 0.7) of a half";
    EXPECT_EQ(shadow_through(t, 1.0f), 1.0f);
    t.power = 0.0f;
    const float a2 = 0.49f;
    const float lobe = a2 / 3.14159265f / (a2 * a2);  // z = 1: (a2 - 1 + 1)^2
    EXPECT_NEAR(light_through(t, kUp, kUp, -kUp) * 3.14159265f, 1.5f / 2.25f * lobe * 2.0f, 1e-4f);
    EXPECT_NEAR(shadow_through(t, 0.0f), 0.3f, 1e-6f) << "whatever the strength";
}

TEST(Scattering, BrightensTheRimAndNeverBeyondWhite)
{
    const vec3 color(0.52f, 0.13f, 0.28f);
    const vec3 facing = scattered_albedo(vec3(0.1f), color, 0.2f, 2.0f, 1.0f);
    EXPECT_NEAR(facing.x, 0.1f + 0.52f * (0.25f + 0.2f), 1e-5f);
    const vec3 rim = scattered_albedo(vec3(0.1f), color, 0.2f, 2.0f, 0.0f);
    EXPECT_NEAR(rim.z, 0.1f + 0.28f * 1.2f, 1e-5f);
    EXPECT_LE(scattered_albedo(vec3(0.8f), vec3(1.0f), 0.5f, 1.0f, 0.0f).x, 1.0f);
}

}  // namespace
}  // namespace petrichor::shared
