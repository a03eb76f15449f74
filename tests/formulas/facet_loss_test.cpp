// Light that goes on between facets: what one facet loses, and that nothing is lost of all.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formulas/light/layers.h"

namespace petrichor::shared {
namespace {

using glm::vec3;

const vec3 kUp(0, 0, 1);

vec3 direction(float up, float turn)
{
    const float level = std::sqrt(std::max(1.0f - up * up, 0.0f));
    return {level * std::cos(turn), level * std::sin(turn), up};
}

// Share of light from all around that goes towards the eye.
float sent(const Lobe& lobe)
{
    const int rows = 300, columns = 400;
    double sum = 0.0;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const float up = (static_cast<float>(i) + 0.5f) / rows;
            sum += static_cast<double>(shade_lobe(lobe, direction(up, (static_cast<float>(j) + 0.5f) / columns * 6.2831853f)).g);
        }
    }
    return static_cast<float>(sum * 2.0 * 3.14159265358979 / (rows * columns));
}

Lobe metal(const vec3& f0, float roughness, float up)
{
    return make_lobe(kUp, direction(up, 0.0f), vec3(0.0f), f0, roughness * roughness);
}

TEST(FacetLoss, IsWhatOneFacetDoesNotSendOn)
{
    for (const float roughness : {0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 1.0f}) {
        const FacetLoss loss = facet_loss(roughness);
        double mean = 0.0;
        for (int i = 0; i < 1000; ++i) {
            const float up = (static_cast<float>(i) + 0.5f) / 1000.0f;
            mean += static_cast<double>(2.0f * up * lost_at(loss, up) / 1000.0f);
        }
        EXPECT_NEAR(lost_in_all(roughness) / static_cast<float>(mean), 1.0f, 0.05f) << roughness;
        for (const float up : {0.1f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f})
            EXPECT_NEAR(lost_at(loss, up), 1.0f - sent(metal(vec3(1.0f), roughness, up)), 0.014f) << roughness << " " << up;
    }
}

TEST(FacetLoss, AWhiteMetalSendsAllOfItBackAndAColouredOneNeverMore)
{
    for (const float roughness : {0.3f, 0.5f, 0.7f, 0.85f, 1.0f}) {
        for (const float up : {0.1f, 0.3f, 0.6f, 1.0f}) {
            EXPECT_NEAR(sent(with_all_light(metal(vec3(1.0f), roughness, up), roughness, lost_along_lobe(roughness))), 1.0f, 0.03f) << roughness << " " << up;
            for (const float f0 : {0.04f, 0.3f, 0.7f}) {
                const float alone = sent(metal(vec3(f0), roughness, up));
                const float all = sent(with_all_light(metal(vec3(f0), roughness, up), roughness, lost_along_lobe(roughness)));
                EXPECT_GE(all, alone);
                EXPECT_LE(all, 1.0f);
            }
        }
    }
}

TEST(FacetLoss, IsTheSameInBothDirections)
{
    std::mt19937 numbers{5};
    const auto unit = [&] { return static_cast<float>(numbers() >> 8) / 16777216.0f; };
    for (int k = 0; k < 5000; ++k) {
        const vec3 v = direction(0.03f + 0.97f * unit(), 6.2831853f * unit());
        const vec3 l = direction(0.03f + 0.97f * unit(), 6.2831853f * unit());
        const float roughness = 0.05f + 0.95f * unit();
        const vec3 f0(unit(), unit(), unit());
        const auto towards = [&](const vec3& eye, const vec3& light) {
            return shade_lobe(with_all_light(make_lobe(kUp, eye, vec3(0.2f), f0, roughness * roughness), roughness, lost_along_lobe(roughness)), light) / light.z;
        };
        const vec3 there = towards(v, l);
        const vec3 back = towards(l, v);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(there[c], back[c], 1e-3f * there[c] + 1e-5f) << k;
        Layers layers{};
        layers.anisotropy = unit();
        layers.tangent = direction(0.0f, 6.2831853f * unit());
        const auto along_grain = [&](const vec3& eye, const vec3& light) {
            const Lobe lobe = with_light_along_grain(make_lobe(kUp, eye, vec3(0.2f), f0, roughness * roughness), roughness, layers.tangent, layers.anisotropy);
            return shade_layered_lobe(lobe, light, roughness, layers).g / light.z;
        };
        ASSERT_NEAR(along_grain(v, l), along_grain(l, v), 2e-3f * along_grain(v, l) + 1e-5f) << k;
    }
}

// Share of light from all around that one facet each of a white metal with a grain sends to an eye.
float sent_along_grain(float along, float across, const vec3& eye)
{
    const int rows = 300, columns = 400;
    double sum = 0.0;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const vec3 l = direction((static_cast<float>(i) + 0.5f) / rows, (static_cast<float>(j) + 0.5f) / columns * 6.2831853f);
            sum += static_cast<double>(anisotropic_lobe(kUp, vec3(1, 0, 0), eye, l, along, across) * l.z);
        }
    }
    return static_cast<float>(sum * 2.0 * 3.14159265358979 / (rows * columns));
}

TEST(FacetLoss, AlongAGrainItIsLostByDirection)
{
    for (const float roughness : {0.4f, 0.6f}) {
        for (const float anisotropy : {0.5f, 0.75f, 1.0f}) {
            const float across = roughness * roughness, along = alpha_along(roughness, anisotropy);
            const FacetLoss loss = facet_loss(facet_roughness(roughness, anisotropy));
            for (const float up : {0.2f, 0.5f, 0.9f}) {
                for (const float turn : {0.0f, 0.785f, 1.5708f}) {
                    const vec3 eye = direction(up, turn);
                    EXPECT_NEAR(lost_at(loss, grain_cosine(eye, kUp, vec3(1, 0, 0), along, across / along)), 1.0f - sent_along_grain(along, across, eye), 0.04f)
                        << roughness << " " << anisotropy << " " << up << " " << turn;
                }
            }
        }
    }
    EXPECT_EQ(facet_roughness(0.3f, 0.0f), 0.3f);
    // One that is hardly there is as round.
    const vec3 eye = direction(0.6f, 0.3f);
    const Lobe lobe = make_lobe(kUp, eye, vec3(0.0f), vec3(1.0f), 0.25f);
    const Lobe round = with_light_along_grain(lobe, 0.5f, vec3(1, 0, 0), 0.0f), nearly = with_light_along_grain(lobe, 0.5f, vec3(1, 0, 0), 0.01f);
    EXPECT_NEAR(nearly.again.g, round.again.g, 1e-3f * round.again.g);
    EXPECT_NEAR(nearly.loss.along, round.loss.along, 1e-3f * round.loss.along);
}

TEST(FacetLoss, IsAShareOfWhatComesIn)
{
    for (float roughness = 0.03f; roughness <= 1.0f; roughness += 0.002f) {
        const FacetLoss loss = facet_loss(roughness);
        for (float up = 0.0f; up <= 1.0f; up += 0.002f) {
            ASSERT_GE(lost_at(loss, up), 0.0f) << roughness << " " << up;
            ASSERT_LE(lost_at(loss, up), 0.7f) << roughness << " " << up;
        }
    }
}

TEST(FacetLoss, IsNothingOnWhatMirrorsNothing)
{
    const Lobe matt = with_all_light(make_lobe(kUp, kUp, vec3(0.5f), vec3(0.0f), 0.8f), 0.9f, 0.0f);
    EXPECT_EQ(matt.again, vec3(0.0f));
}

}  // namespace
}  // namespace petrichor::shared
