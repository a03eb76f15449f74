// What is left of a lobe over the surface, against integrals of GGX.
#include "formulas/light/seen_lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/portable_math.h"

namespace petrichor::shared {
namespace {

using Sky = std::function<double(double)>;  // radiance by the sine of the elevation
constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Visits facets of GGX spread as they are, around +y: sine and cosine of their lean, azimuth.
template <class Visit>
void each_facet(double alpha, const Visit& visit)
{
    const int around = 128, out = 256;
    for (int i = 0; i < out; ++i) {
        const double u = (i + 0.5) / out;
        const double c = std::sqrt((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u));
        for (int j = 0; j < around; ++j) visit(std::sqrt(1.0 - c * c), c, 2.0 * 3.14159265358979323846 * (j + 0.5) / around);
    }
}

// Mean radiance of the sky in what level ground of a roughness mirrors, weighted as it mirrors.
double mirrored(double elevation, double roughness, const Sky& sky)
{
    const double a = roughness * roughness, vx = -std::cos(elevation), vy = std::sin(elevation);
    const auto lambda = [a](double x) { return 0.5 * (std::sqrt(1.0 + a * a * (1.0 - x * x) / (x * x)) - 1.0); };
    double light = 0.0, weight = 0.0;
    each_facet(a, [&](double s, double c, double azimuth) {
        const double vh = vx * s * std::cos(azimuth) + vy * c;
        const double up = 2.0 * vh * c - vy;
        if (vh <= 0.0 || up <= 0.0) return;
        const double fresnel = 0.02 + 0.98 * std::pow(1.0 - vh, 5.0);
        const double w = fresnel * vh / (vy * c) / (1.0 + lambda(vy) + lambda(up));
        light += w * sky(up);
        weight += w;
    });
    return light / weight;
}

// A map blurred as those of the sky are (gpu/passes/sky/sky_specular.comp.glsl), asked at an elevation.
double blurred(double elevation, double roughness, const Sky& sky)
{
    double light = 0.0, weight = 0.0;
    const double nx = std::cos(elevation), ny = std::sin(elevation);
    each_facet(roughness * roughness, [&](double s, double c, double azimuth) {
        const double cosine = 2.0 * c * c - 1.0;
        if (cosine <= 0.0) return;
        light += cosine * sky(2.0 * c * (ny * c + nx * s * std::cos(azimuth)) - ny);
        weight += cosine;
    });
    return light / weight;
}

TEST(SeenLobe, MirrorsWhatLiesOverTheSurface)
{
    const Sky skies[] = {[](double y) { return y > 0.0 ? 1.0 : 0.0; },
                         [](double y) { return y > 0.0 ? (1.0 + 2.0 * y) / 3.0 : 0.1; },   // overcast, CIE
                         [](double y) { return y > 0.0 ? 1.0 - 0.6 * y : 0.1; }};          // bright at the horizon
    double whole_lobe = 0.0;
    for (const double roughness : {0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.45, 0.55, 0.7, 0.8}) {
        for (const double degrees : {1.0, 2.0, 4.0, 8.0, 15.0, 30.0, 50.0}) {
            const double e = degrees * kDegree;
            const glm::vec3 way(static_cast<float>(std::cos(e)), static_cast<float>(std::sin(e)), 0.0f);
            const SeenLobe seen = seen_lobe({0, 1, 0}, way, static_cast<float>(roughness));
            EXPECT_NEAR(glm::length(seen.direction), 1.0f, 1e-5f);
            EXPECT_GE(seen.direction.y, way.y - 1e-5f);
            for (const Sky& sky : skies) {
                const double truth = mirrored(e, roughness, sky);
                const double told = blurred(std::asin(static_cast<double>(seen.direction.y)), static_cast<double>(seen.roughness), sky);
                EXPECT_NEAR(told / truth, 1.0, roughness < 0.31 ? 0.08 : 0.17) << roughness << " " << degrees;
                whole_lobe = std::max(whole_lobe, 1.0 - blurred(e, roughness, sky) / truth);
            }
        }
    }
    EXPECT_GT(whole_lobe, 0.4) << "what a lobe that knows no surface loses";
}

TEST(SeenLobe, IsTheLobeItselfOnMirrorsAndFarFromGrazing)
{
    const glm::vec3 normal = glm::normalize(glm::vec3(0.2f, 0.9f, -0.3f));
    for (const float roughness : {0.0f, 0.05f, 0.3f, 0.9f}) {
        const SeenLobe seen = seen_lobe(normal, normal, roughness);
        EXPECT_LT(glm::distance(seen.direction, normal), 1e-4f);
        EXPECT_NEAR(seen.roughness, roughness, 0.02f);
    }
    const glm::vec3 low = glm::normalize(glm::vec3(1.0f, 0.04f, 0.1f));
    const SeenLobe mirror = seen_lobe({0, 1, 0}, low, 0.03f);
    EXPECT_LT(glm::distance(mirror.direction, low), 1e-3f);
    EXPECT_NEAR(mirror.roughness, 0.03f, 1e-3f);
}

}  // namespace
}  // namespace petrichor::shared
