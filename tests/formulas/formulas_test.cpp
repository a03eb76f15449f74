// Laws and table values of the shared formulas, on the CPU. tests/gpu/parity_test.cpp shows that
// the device computes the same.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/packing.hpp>

#include "formulas/codec/half.h"
#include "formulas/codec/octahedral.h"
#include "formulas/color/tone_map.h"
#include "formulas/light/atmosphere.h"
#include "formulas/light/brdf.h"
#include "formulas/light/spherical_harmonics.h"
#include "formulas/weather/ripple.h"
#include "formulas/weather/apply_weather.h"
#include "formulas/weather/falls_here.h"
#include "formulas/weather/ground_relief.h"
#include "formulas/weather/weather_maps.h"
#include "formulas/weather/surface_weather.h"

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

// ---- water and snow
// --------------------------------------------------------------------------------

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
            parts += water(ground_relief_seen(at, 2.2f), ground_relief_blurred(2.2f));
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
    EXPECT_EQ(ground_relief_seen(vec2(3.0f, 7.0f), 0.0f), 0.498f + (ground_relief(vec2(3.0f, 7.0f)) - 0.498f));
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

TEST(ApplyWater, DarkensPorousNotSmooth)
{
    WeatheredMaterial dry{glm::vec3(0.4f), glm::vec3(0.04f), 0.3f, 0.5f, 1.0f, 0.0f, 0.0f};
    const WeatheredMaterial porous = apply_water(dry, glm::vec2(1.0f), 0.0f, glm::vec4(0.0f), 1.0f);
    EXPECT_NEAR(porous.albedo.x, 0.2432f, 1e-4f);
    const WeatheredMaterial dense = apply_water(dry, glm::vec2(1.0f), 0.0f, glm::vec4(0.0f), 0.0f);
    EXPECT_EQ(dense.albedo.x, 0.4f);
    const WeatheredMaterial flooded =
        apply_water(dry, glm::vec2(0.0f), 1.0f, glm::vec4(0.1f, 0.1f, 0.1f, 0.5f), 0.0f);
    EXPECT_NEAR(flooded.smoothness, 0.9f, 1e-6f);
    EXPECT_NEAR(flooded.specular.x, 0.02f, 1e-6f);
    EXPECT_NEAR(flooded.albedo.x, 0.25f, 1e-6f);
    EXPECT_NEAR(flooded.emission_scale, 0.5f, 1e-6f);
    EXPECT_NEAR(flooded.occlusion, 0.75f, 1e-6f);
    const WeatheredMaterial same = apply_water(dry, glm::vec2(0.0f), 0.0f, glm::vec4(0.0f), 1.0f);
    EXPECT_EQ(same.albedo, dry.albedo);
    EXPECT_EQ(same.smoothness, dry.smoothness);
}

TEST(ApplyWater, DarkensAsAFilmOverAMattGroundDoes)
{
    // Lekner & Dorf 1988, n = 1.33.
    const glm::vec2 known[] = {{0.1f, 0.0518f}, {0.2f, 0.1089f}, {0.3f, 0.1724f}, {0.4f, 0.2432f},
                               {0.5f, 0.3228f}, {0.6f, 0.4128f}, {0.8f, 0.6339f}};
    for (const glm::vec2& k : known) {
        const WeatheredMaterial dry{glm::vec3(k.x), glm::vec3(0.04f), 0.1f, 1.0f, 1.0f, 0.0f, 0.0f};
        const auto wet = apply_water(dry, glm::vec2(1.0f), 0.0f, glm::vec4(0.0f), 1.0f);
        EXPECT_NEAR(wet.albedo.x, k.y, 1e-4f) << k.x;
    }
}

// What was measured is what a whole film leaves; of paint and glaze it takes little.
TEST(ApplyWater, SettsDarkenAsMuchAsIsMeasured)
{
    const auto left = [](float albedo, float porosity) {
        DryMaterial dry{};
        dry.base_color = glm::vec3(albedo);
        dry.f0 = glm::vec3(0.04f);
        dry.roughness = 0.8f;
        dry.porosity = porosity;
        WeatherMoment moment{};
        moment.film_albedo = 0.85f;
        const SurfaceState state{1.0f, 0.0f, 0.0f, 0.0f, 0.4f};
        return apply_weather(dry, state, moment, {}).albedo.x / albedo;
    };
    // Angstrom 1925: sand .18 to .09, mould .14 to .08.
    EXPECT_NEAR(left(0.18f, 1.0f), 0.5f, 0.12f);
    EXPECT_NEAR(left(0.14f, 1.0f), 0.57f, 0.06f);
    // Wet over dry of the energy balance's own surfaces: setts, brick, concrete.
    EXPECT_NEAR(left(0.20f, 0.45f), 0.65f, 0.03f);
    EXPECT_NEAR(left(0.28f, 0.75f), 0.61f, 0.05f);
    EXPECT_NEAR(left(0.30f, 0.70f), 0.67f, 0.05f);
    EXPECT_GT(left(0.30f, 0.05f), 0.95f);
}

TEST(ApplyWater, AMetalKeepsItsReflectanceBelowWater)
{
    for (const float metallic : {0.0f, 1.0f}) {
        // Dark iron: its F0 alone does not tell that it is a metal.
        const glm::vec3 f0 = metallic > 0.0f ? glm::vec3(0.45f, 0.44f, 0.42f) : glm::vec3(0.04f);
        const WeatheredMaterial dry{glm::vec3(0.0f), f0, 0.2f, 1.0f, 1.0f, 0.0f, metallic};
        const auto wet = apply_water(dry, glm::vec2(1.0f), 1.0f, glm::vec4(0.0f), 1.0f);
        EXPECT_NEAR(wet.specular.x, metallic > 0.0f ? f0.x : 0.02f, 1e-6f);
        EXPECT_NEAR(wet.smoothness, 0.9f, 1e-6f) << "the film is as smooth on both";
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

DryMaterial dry_stone()
{
    DryMaterial dry{};
    dry.base_color = glm::vec3(0.4f);
    dry.f0 = glm::vec3(0.04f);
    dry.roughness = 0.8f;
    dry.occlusion = 1.0f;
    dry.porosity = 1.0f;
    return dry;
}

// Section 12: the albedo is darkened, then tinted, so that the tint is as bright as it was given.
TEST(ApplyWeather, WaterDarkensThenTints)
{
    DryMaterial dry = dry_stone();
    dry.water_color = {0.3f, 0.2f, 0.1f, 0.5f};
    SurfaceState flooded{};
    flooded.water = 1.0f;
    const WeatheredMaterial wet = apply_weather(dry, flooded, {}, {});
    EXPECT_NEAR(wet.albedo.x, 0.5f * 0.2432f + 0.5f * 0.3f, 1e-4f);
    EXPECT_NEAR(wet.albedo.z, 0.5f * 0.2432f + 0.5f * 0.1f, 1e-4f);
    EXPECT_NEAR(wet.emission_scale, 0.5f, 1e-6f);
    EXPECT_NEAR(wet.occlusion, 1.0f, 1e-6f);
}

TEST(ApplyWeather, DryStaysDry)
{
    const DryMaterial dry = dry_stone();
    const WeatheredMaterial same = apply_weather(dry, {}, {}, {});
    EXPECT_EQ(same.albedo, dry.base_color);
    EXPECT_EQ(same.specular, dry.f0);
    EXPECT_FLOAT_EQ(same.smoothness, 1.0f - dry.roughness);
    EXPECT_EQ(same.normal_mix, 0.0f);
    EXPECT_EQ(same.emission_scale, 1.0f);
}

// Neither a film nor standing water takes a metal's reflectance: it is seen through them.
TEST(ApplyWeather, AWetMetalKeepsItsReflectance)
{
    DryMaterial metal = dry_stone();
    metal.base_color = {0.95f, 0.64f, 0.54f};
    metal.metallic = 1.0f;
    SurfaceState state{};
    state.film = 1.0f;
    WeatherMoment rain;
    rain.film_albedo = 0.85f;
    rain.film_smoothness = 0.5f;
    const WeatheredMaterial wet = apply_weather(metal, state, rain, {});
    EXPECT_EQ(wet.specular, metal.base_color);
    state.water = 1.0f;
    EXPECT_EQ(apply_weather(metal, state, rain, {}).specular, metal.base_color);
}

// Snow swallows emission by its opacity, over what murky water has left of it.
// Fresh snow 0.95, old 0.40 (Oke 1987): what melts lies between, the darker the thinner, and no jump as the thaw begins.
TEST(ApplyWeather, MeltingSnowIsGreyAndWetWhereItIsThin)
{
    for (float cover = 0.0f; cover <= 1.0f; cover += 0.1f) EXPECT_EQ(melting_snow(cover, 0.0f), 1.0f);
    for (float melt = 0.1f; melt <= 1.0f; melt += 0.1f) {
        for (float cover = 0.1f; cover <= 1.0f; cover += 0.1f) {
            EXPECT_LT(melting_snow(cover, melt), melting_snow(cover, melt - 0.1f));
            EXPECT_LE(melting_snow(cover - 0.1f, melt), melting_snow(cover, melt));
            EXPECT_GT(0.95f * melting_snow(cover, melt), 0.40f);
            EXPECT_GE(melting_smoothness(0.3f, cover, melt), 0.3f);
            EXPECT_GE(melting_smoothness(0.3f, cover - 0.1f, melt), melting_smoothness(0.3f, cover, melt));
        }
    }
    EXPECT_LT(melting_snow(0.3f, 1.0f), 0.7f * melting_snow(1.0f, 1.0f));
    WeatherMoment moment;
    WeatherLook look;
    look.snow_color = glm::vec3(0.9f);
    DryMaterial dry{};
    dry.base_color = glm::vec3(0.3f);
    dry.f0 = glm::vec3(0.04f);
    dry.roughness = 0.9f;
    dry.occlusion = 1.0f;
    SurfaceState state{};
    state.snow = 1.0f;
    state.snow_smoothness = 0.3f;
    const float cold = apply_weather(dry, state, moment, look).albedo.x;
    moment.melt_exp = 1.0f;
    EXPECT_NEAR(apply_weather(dry, state, moment, look).albedo.x, 0.8f * cold, 1e-5f);
}

TEST(ApplyWeather, SnowAndMurkDimWhatGlows)
{
    DryMaterial lamp = dry_stone();
    lamp.water_color = {0, 0, 0, 0.4f};
    lamp.snow_opacity = 0.9f;
    SurfaceState state{};
    state.water = 1.0f;
    EXPECT_NEAR(apply_weather(lamp, state, {}, {}).emission_scale, 0.6f, 1e-6f);
    state.snow = 1.0f;
    EXPECT_NEAR(apply_weather(lamp, state, {}, {}).emission_scale, 0.1f, 1e-6f);
}

TEST(ApplySnow, CoversWhatIsUnder)
{
    const WeatheredMaterial under{glm::vec3(0.1f), glm::vec3(0.04f), 0.3f, 0.5f, 1.0f, 0.0f, 0.0f};
    const WeatheredMaterial full =
        apply_snow(under, 1.0f, glm::vec3(0.9f), glm::vec3(0.02f), 0.4f, 0.5f);
    EXPECT_EQ(full.albedo, glm::vec3(0.9f));
    EXPECT_FLOAT_EQ(full.emission_scale, 0.5f);
    EXPECT_FLOAT_EQ(full.occlusion, 1.0f);
    const WeatheredMaterial none =
        apply_snow(under, 0.0f, glm::vec3(0.9f), glm::vec3(0.02f), 0.4f, 0.5f);
    EXPECT_EQ(none.albedo, under.albedo);
}

TEST(Ripple, DryWeatherIsFlatAndLayersJoinOneByOne)
{
    for (int i = 0; i < kRippleLayers; ++i)
        EXPECT_EQ(ripple_layer(i, 0.0f, 1.0f, 1.0f).weight, 0.0f);
    EXPECT_EQ(ripple_layer(1, 0.25f, 1.0f, 1.0f).weight, 0.0f);
    EXPECT_FLOAT_EQ(ripple_layer(0, 0.25f, 1.0f, 1.0f).weight, 1.0f);
    EXPECT_FLOAT_EQ(ripple_layer(3, 1.0f, 1.0f, 1.0f).weight, 1.0f);
    EXPECT_EQ(ripple_slope(glm::vec4(0.0f, 0.8f, 0.2f, 0.3f), 0.4f, 1.0f), glm::vec2(0.0f))
        << "outside every drop";
}

TEST(Flow, APhaseJumpsOnlyWhereItDoesNotShow)
{
    for (float t = 0.0f; t < 3.0f; t += 0.001f) {
        const FlowPhases p = flow_phases(t, 1.0f);
        if (p.first < 0.002f) {
            EXPECT_GT(p.blend, 0.99f);  // only the second shows
        }
        if (p.second < 0.002f) {
            EXPECT_LT(p.blend, 0.01f);  // only the first shows
        }
    }
    EXPECT_EQ(flow_phases(5.0f, 0.0f).first, 0.0f) << "interval 0 is a still surface";
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
