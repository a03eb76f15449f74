// Clear coat, sheen, anisotropy, thin sheets: laws that every reflectance keeps.
#include "formulas/light/layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace petrichor::shared {
namespace {

using glm::vec3;

vec3 direction(float up, float turn)
{
    const float level = std::sqrt(std::max(1.0f - up * up, 0.0f));
    return {level * std::cos(turn), level * std::sin(turn), up};
}

Layers none()
{
    return Layers{0.0f, 0.3f, vec3(0.0f), 0.5f, 0.0f, vec3(1, 0, 0), 0.0f, vec3(0.0f), vec3(0, 0, 1), 0.0f};
}

const vec3 kUp(0, 0, 1);

// Share of the light from all around that goes towards the eye.
template <class F>
double albedo_of(const vec3& v, const F& shade)
{
    const int rows = 160, columns = 240;
    double sum = 0.0;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const float up = (static_cast<float>(i) + 0.5f) / rows;
            const float turn = (static_cast<float>(j) + 0.5f) / columns * 6.2831853f;
            sum += static_cast<double>(shade(direction(up, turn)));
        }
    }
    static_cast<void>(v);
    return sum * 2.0 * 3.14159265358979 / (rows * columns);
}

struct Random {
    std::mt19937 numbers{11};
    float operator()() { return static_cast<float>(numbers() >> 8) / 16777216.0f; }
};

TEST(Layers, WithoutAnyIsThePlainModel)
{
    Random unit;
    for (int k = 0; k < 2000; ++k) {
        const vec3 v = direction(0.05f + 0.95f * unit(), 6.2831853f * unit());
        const vec3 l = direction(0.01f + 0.99f * unit(), 6.2831853f * unit());
        const float roughness = 0.2f + 0.8f * unit();
        const vec3 diffuse(unit(), unit(), unit());
        const vec3 a = shade_layers(kUp, v, l, diffuse, vec3(0.04f), roughness, none());
        const vec3 b = shade_direct(kUp, v, l, diffuse, vec3(0.04f), roughness * roughness);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 2e-3f * b[c] + 1e-6f);
    }
}

TEST(Layers, AreReciprocal)
{
    Random unit;
    for (int k = 0; k < 10000; ++k) {
        Layers layers = none();
        layers.coat = unit();
        layers.coat_roughness = 0.1f + 0.9f * unit();
        layers.sheen = vec3(unit(), unit(), unit());
        layers.sheen_roughness = 0.1f + 0.9f * unit();
        layers.anisotropy = k % 2 == 0 ? 0.0f : unit();
        layers.tangent = direction(0.0f, 6.2831853f * unit());
        layers.transmitted = unit();
        const vec3 v = direction(0.05f + 0.95f * unit(), 6.2831853f * unit());
        const vec3 l = direction(0.05f + 0.95f * unit(), 6.2831853f * unit());
        const float roughness = 0.2f + 0.8f * unit();
        const vec3 diffuse(0.3f, 0.5f, 0.7f);
        const vec3 there = shade_layers(kUp, v, l, diffuse, vec3(0.04f), roughness, layers) / l.z;
        const vec3 back = shade_layers(kUp, l, v, diffuse, vec3(0.04f), roughness, layers) / v.z;
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(there[c], back[c], 1e-3f * there[c] + 1e-5f) << k;
    }
}

TEST(Layers, CoatAndSheenNeverSendMoreThanComesIn)
{
    for (const float up : {0.1f, 0.3f, 0.6f, 1.0f}) {
        const vec3 v = direction(up, 0.4f);
        for (const float roughness : {0.35f, 0.6f, 1.0f}) {
            // A white matt base without a highlight of its own: 1 of 1.
            for (const float weight : {0.3f, 1.0f}) {
                Layers coated = none();
                coated.coat = weight;
                coated.coat_roughness = roughness;
                Layers cloth = none();
                cloth.sheen = vec3(weight);
                cloth.sheen_roughness = roughness;
                for (const Layers& layers : {coated, cloth}) {
                    const double all = albedo_of(v, [&](const vec3& l) {
                        return shade_layers(kUp, v, l, vec3(1.0f), vec3(0.0f), 0.5f, layers).y;
                    });
                    EXPECT_LE(all, 1.02) << up << " " << roughness << " " << weight;
                    EXPECT_GT(all, 0.4) << up << " " << roughness << " " << weight;
                }
            }
        }
    }
}

TEST(Layers, TheAlbedoOfTheSheenIsItsIntegral)
{
    for (const float up : {0.05f, 0.2f, 0.5f, 0.9f}) {
        for (const float roughness : {0.15f, 0.3f, 0.5f, 0.75f, 1.0f}) {
            const vec3 v = direction(up, 0.0f);
            const double sum = albedo_of(v, [&](const vec3& l) {
                const vec3 h = glm::normalize(v + l);
                return sheen_lobe(l.z, up, h.z, roughness) * l.z;
            });
            EXPECT_NEAR(sheen_albedo(up, roughness), sum, 0.03 * sum + 0.02) << up << " " << roughness;
        }
    }
}

TEST(Layers, AnAnisotropicLobeIsLongAlongItsTangentAndKeepsItsEnergy)
{
    const vec3 v = direction(0.8f, 1.0f);
    for (const float along : {0.3f, 0.6f, 1.0f}) {
        const double all = albedo_of(v, [&](const vec3& l) {
            return anisotropic_lobe(kUp, vec3(1, 0, 0), v, l, along, 0.3f) * l.z;
        });
        EXPECT_LE(all, 1.01) << along;
        EXPECT_GT(all, 0.45) << along;
    }
    const float round = anisotropic_lobe(kUp, vec3(1, 0, 0), kUp, direction(0.9f, 0.3f), 0.3f, 0.3f);
    const vec3 l = direction(0.9f, 0.3f);
    EXPECT_NEAR(round, ggx_distribution(glm::normalize(kUp + l).z, 0.3f) * ggx_visibility(0.9f, 1.0f, 0.3f),
                1e-4f * round);
    const auto highlight = [](float turn) {
        return anisotropic_lobe(kUp, vec3(1, 0, 0), kUp, direction(0.7f, turn), 0.7f, 0.1f);
    };
    EXPECT_GT(highlight(0.0f), 20.0f * highlight(1.5707963f));
}

TEST(Layers, AThinSheetSharesItsLightBetweenItsSides)
{
    Layers leaf = none();
    leaf.transmitted = 0.4f;
    leaf.through = vec3(0.1f, 0.7f, 0.0f);
    const vec3 v = direction(0.7f, 0.0f);
    const vec3 front = shade_layers(kUp, v, kUp, vec3(0.5f), vec3(0.0f), 0.5f, leaf);
    const vec3 behind = shade_layers(kUp, v, -kUp, vec3(0.5f), vec3(0.0f), 0.5f, leaf);
    EXPECT_NEAR(front.y * kPi, 0.5f * 0.6f, 1e-5f);
    EXPECT_NEAR(behind.x * kPi, 0.1f * 0.4f, 1e-5f);
    EXPECT_NEAR(behind.y * kPi, 0.7f * 0.4f, 1e-5f);
    EXPECT_EQ(behind.z, 0.0f);
    EXPECT_EQ(shade_layers(kUp, v, -kUp, vec3(0.5f), vec3(0.0f), 0.5f, none()), vec3(0.0f));
}

TEST(Layers, ATangentSurvivesItsCode)
{
    Random unit;
    for (int k = 0; k < 1000; ++k) {
        const vec3 n = direction(2.0f * unit() - 1.0f, 6.2831853f * unit());
        const vec3 t = tangent_at(n, 6.2831853f * unit());
        EXPECT_NEAR(glm::dot(t, n), 0.0f, 1e-5f);
        const float code = tangent_code(n, t);
        EXPECT_GE(code, 0.0f);
        EXPECT_LE(code, 1.0f);
        EXPECT_NEAR(std::abs(glm::dot(tangent_at(n, code * kPi), t)), 1.0f, 1e-4f);
    }
}

// An eye straight before a light that shines from straight behind has no half vector: nothing is lit, nothing is NaN.
TEST(Layers, ALightBehindIsDarkHoweverStraight)
{
    const vec3 n(0.0f, 0.0f, 1.0f);
    Layers layers{};
    layers.anisotropy = 0.9f;
    layers.tangent = vec3(1.0f, 0.0f, 0.0f);
    layers.coat = 1.0f;
    layers.coat_roughness = 0.1f;
    layers.sheen = vec3(1.0f);
    layers.sheen_roughness = 0.4f;
    layers.other_normal = n;
    const vec3 dark = shade_layers(n, n, -n, vec3(0.5f), vec3(0.04f), 0.4f, layers);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(dark[c], 0.0f);
}

}  // namespace
}  // namespace petrichor::shared
