// Light, colour and codes: laws and table values of the shared formulas, on the CPU.
// tests/gpu/parity_test.cpp shows that the device computes the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/packing.hpp>

#include "formulas/codec/half.h"
#include "formulas/codec/octahedral.h"
#include "formulas/color/tone_map.h"
#include "formulas/light/atmosphere.h"
#include "formulas/light/brdf.h"
#include "formulas/light/spherical_harmonics.h"

namespace petrichor::shared {
namespace {

// Integral over the upper hemisphere by a midpoint rule in cosine and azimuth.
template <class F>
double over_hemisphere(int steps, const F& f)
{
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const double c = (i + 0.5) / steps;
            const double phi = 2.0 * M_PI * (j + 0.5) / steps;
            const double s = std::sqrt(1.0 - c * c);
            sum += static_cast<double>(f(glm::vec3(s * std::cos(phi), s * std::sin(phi), c)));
        }
    }
    return sum * 2.0 * M_PI / (static_cast<double>(steps) * steps);
}

TEST(Brdf, DistributionIntegratesToOne)
{
    for (const float alpha : {0.25f, 0.4f, 0.6f, 1.0f}) {
        const double sum = over_hemisphere(
            400, [&](const glm::vec3& h) { return ggx_distribution(h.z, alpha) * h.z; });
        EXPECT_NEAR(sum, 1.0, 0.01) << alpha;
    }
}

// Closed form at alpha = 1: E(v) = 1 - v ln(1 + 1 / v).
TEST(Brdf, DirectionalAlbedoAtFullRoughness)
{
    for (const float nv : {0.25f, 0.5f, 1.0f}) {
        const glm::vec3 v(std::sqrt(1.0f - nv * nv), 0.0f, nv);
        const double sum = over_hemisphere(300, [&](const glm::vec3& l) {
            return shade_direct(glm::vec3(0, 0, 1), v, l, glm::vec3(0), glm::vec3(1), 1.0f).x;
        });
        const double mu = static_cast<double>(nv);
        EXPECT_NEAR(sum, 1.0 - mu * std::log(1.0 + 1.0 / mu), 2e-3) << nv;
    }
}

TEST(Brdf, IsReciprocal)
{
    const glm::vec3 n(0, 0, 1);
    const glm::vec3 a = glm::normalize(glm::vec3(0.3f, 0.5f, 0.7f));
    const glm::vec3 b = glm::normalize(glm::vec3(-0.6f, 0.1f, 0.4f));
    const glm::vec3 f = shade_direct(n, a, b, glm::vec3(0.2f), glm::vec3(0.04f), 0.3f) / b.z;
    const glm::vec3 g = shade_direct(n, b, a, glm::vec3(0.2f), glm::vec3(0.04f), 0.3f) / a.z;
    EXPECT_NEAR(f.x, g.x, 1e-5f);
}

// The seed of grass: no F0, no highlight.
TEST(Brdf, NoHighlightWithoutReflectance)
{
    const glm::vec3 n(0, 0, 1);
    EXPECT_EQ(shade_direct(n, n, n, glm::vec3(0), glm::vec3(0), 0.1f), glm::vec3(0));
}

// The lobe as it is computed, against its three terms, from polished to matt and most of all round the
// mirror direction.
TEST(Brdf, TheLobeIsTheProductOfItsTerms)
{
    const glm::vec3 n(0, 0, 1);
    for (const float alpha : {0.045f * 0.045f, 0.01f, 0.05f, 0.3f, 1.0f}) {
        const double a2 = static_cast<double>(alpha) * static_cast<double>(alpha);
        for (int i = 0; i < 2000; ++i) {
            const auto share = [i](double step) { return std::fmod((i + 0.5) * step, 1.0); };
            const float slope = static_cast<float>(1.5 * share(0.618034));
            const glm::vec3 v = glm::normalize(glm::vec3(slope, 0.3f * slope, 1.0f));
            const float off = static_cast<float>(4.0 * share(0.754878)) * alpha;
            const double turn = 6.2831853 * share(0.569840);
            const glm::vec3 l = glm::normalize(
                glm::vec3(-v.x, -v.y, v.z) +
                off * glm::vec3(std::cos(turn), std::sin(turn), 0.3 * std::sin(2.0 * turn)));
            if (l.z <= 0.0f) continue;
            const glm::dvec3 h = glm::normalize(glm::dvec3(v) + glm::dvec3(l));
            const double nl = static_cast<double>(l.z);
            const double nv = static_cast<double>(v.z);
            const double d = h.x * h.x + h.y * h.y + h.z * h.z * a2;
            const double distribution = a2 / (M_PI * d * d);
            const double visibility = 0.5 / (nl * std::sqrt(nv * nv * (1.0 - a2) + a2) +
                                             nv * std::sqrt(nl * nl * (1.0 - a2) + a2));
            const double lh = glm::dot(glm::dvec3(l), h);
            const double fresnel = 0.04 + 0.96 * std::pow(1.0 - lh, 5.0);
            const double wanted = distribution * visibility * fresnel * nl;
            const double lobe =
                static_cast<double>(shade_direct(n, v, l, glm::vec3(0), glm::vec3(0.04f), alpha).x);
            // What single precision knows of how far h is from n.
            EXPECT_NEAR(lobe, wanted, wanted * (1.0e-4 + 1.0e-6 / a2)) << alpha << " " << i;
        }
    }
}

TEST(Brdf, LightWindowEndsAtTheRange)
{
    EXPECT_FLOAT_EQ(light_attenuation(2.0f, 0.0f), 0.25f);
    EXPECT_EQ(light_attenuation(5.0f, 5.0f), 0.0f);
    float before = light_attenuation(0.1f, 5.0f);
    for (float d = 0.2f; d <= 6.0f; d += 0.1f) {
        const float now = light_attenuation(d, 5.0f);
        EXPECT_LE(now, before);
        before = now;
    }
    EXPECT_FLOAT_EQ(spot_attenuation(1.0f, 0.9f, 0.8f), 1.0f);
    EXPECT_NEAR(spot_attenuation(0.85f, 0.9f, 0.8f), 0.25f, 1e-5f);
    EXPECT_FLOAT_EQ(spot_attenuation(0.7f, 0.9f, 0.8f), 0.0f);
}

TEST(Octahedral, RoundTrips)
{
    for (float y = -1.0f; y <= 1.0f; y += 0.05f) {
        for (float phi = 0.0f; phi < 6.2f; phi += 0.3f) {
            const float s = std::sqrt(std::max(0.0f, 1.0f - y * y));
            const glm::vec3 n(s * std::cos(phi), y, s * std::sin(phi));
            EXPECT_LT(glm::length(octahedral_decode(octahedral_encode(n)) - n), 2e-6f);
        }
    }
}

TEST(ToneMap, RisesFromBlackToWhite)
{
    EXPECT_EQ(filmic_channel(0.0f), 0.0f);
    EXPECT_NEAR(filmic_channel(0.18f), 0.18f, 0.002f);
    float before = -1.0f;
    for (float x = 0.0f; x < 64.0f; x += 0.05f) {
        const float now = filmic_channel(x);
        EXPECT_GT(now, before);
        before = now;
    }
    EXPECT_NEAR(srgb_encode(0.5f), 0.735357f, 1e-5f);
    EXPECT_NEAR(srgb_encode(0.002f), 0.02584f, 1e-6f);
}

TEST(Air, ReddensAndDimsTheLowSun)
{
    const glm::vec3 high = air_transmittance(2.0f, 1.0f, 2.5f);
    const glm::vec3 low = air_transmittance(2.0f, 0.05f, 2.5f);
    EXPECT_GT(high.x, 0.85f);
    EXPECT_GT(high.b, 0.6f);
    EXPECT_LT(low.b, low.g);
    EXPECT_LT(low.g, low.r);
    EXPECT_LT(low.g, 0.6f * high.g);
    EXPECT_EQ(air_transmittance(2.0f, -0.3f, 2.5f), glm::vec3(0.0f));
}

// Orthonormal over the sphere, and a constant sky of radiance 1 sends 1 in every direction.
TEST(Harmonics, AreOrthonormalAndKeepAConstantSky)
{
    for (int i = 0; i < kHarmonics; ++i) {
        for (int j = 0; j < kHarmonics; ++j) {
            const double both = over_hemisphere(64, [&](const glm::vec3& d) {
                return harmonic(i, d) * harmonic(j, d) + harmonic(i, -d) * harmonic(j, -d);
            });
            EXPECT_NEAR(both, i == j ? 1.0 : 0.0, 2e-3) << i << " " << j;
        }
    }
    const double constant =
        over_hemisphere(64, [&](const glm::vec3& d) { return harmonic(0, d) + harmonic(0, -d); });
    const float returned = harmonic(0, glm::vec3(0, 0, 1)) * cosine_band(0);
    EXPECT_NEAR(constant * static_cast<double>(returned), 1.0, 1e-3);
}

TEST(Harmonics, AxesShareADirection)
{
    const glm::vec3 one(1.0f), none(0.0f);
    for (int i = 0; i < 500; ++i) {
        const float y = -1.0f + static_cast<float>(i) / 250.0f, turn = 2.4f * static_cast<float>(i);
        const float side = std::sqrt(std::max(1.0f - y * y, 0.0f));
        const glm::vec3 n(side * std::cos(turn), y, side * std::sin(turn));
        EXPECT_NEAR(over_sky_axes(n, one, one, one, one, one, one).x, 1.0f, 1e-6f) << "a constant stays one";
    }
    for (int a = 0; a < kSkyAxes; ++a) {
        std::array<glm::vec3, 6> only{};
        only[static_cast<std::size_t>(a)] = one;
        for (int b = 0; b < kSkyAxes; ++b) {
            EXPECT_EQ(over_sky_axes(sky_axis(b), only[0], only[1], only[2], only[3], only[4], only[5]),
                      a == b ? one : none)
                << a << " " << b;
        }
    }
}

// Every half there is, what lies between two, and what is beyond them, as GLM packs them.
TEST(HalfCode, IsTheNearestHalf)
{
    for (std::uint32_t i = 0; i < 0x10000u; ++i) {
        const float exact = glm::unpackHalf2x16(i).x;
        if (std::isnan(exact)) continue;
        EXPECT_EQ(half_code(exact), i);
        if ((i & 0x7fffu) >= 0x7bffu) continue;
        const float next = glm::unpackHalf2x16(i + 1u).x;
        const float between = 0.5f * (exact + next);  // a tie: the even one of both
        EXPECT_EQ(half_code(between), (i & 1u) == 0u ? i : i + 1u) << i;
        EXPECT_EQ(half_code(std::nextafter(between, exact)), i);
        EXPECT_EQ(half_code(std::nextafter(between, next)), i + 1u);
    }
    EXPECT_EQ(half_code(65519.99f), 0x7bffu);
    EXPECT_EQ(half_code(65520.0f), 0x7c00u);
    EXPECT_EQ(half_code(-1e30f), 0xfc00u);
    EXPECT_EQ(half_code(std::nanf("")) & 0x7fffu, 0x7e00u);
    EXPECT_EQ(half_codes(1.0f, -2.0f), 0xc0003c00u);
}

TEST(Srgb, ThereAndBackIsTheSameLight)
{
    for (int i = 0; i <= 1000; ++i) {
        const float x = static_cast<float>(i) / 1000.0f;
        EXPECT_NEAR(linear_from_srgb(srgb_from_linear(x)), x, 2e-6f);
    }
    EXPECT_NEAR(srgb_from_linear(0.2140f), 0.5f, 1e-4f);
    for (int i = 0; i <= 100000; ++i) {
        const float x = static_cast<float>(i) / 100000.0f;
        EXPECT_NEAR(srgb_encode(x), srgb_from_linear(x), 2e-6f);
    }
    EXPECT_EQ(srgb_encode(7.0f), srgb_encode(1.0f));
    EXPECT_EQ(srgb_encode(-1.0f), 0.0f);
}

}  // namespace
}  // namespace petrichor::shared
