// Rectangles that glow: closed forms against known form factors and against sums over directions.
#include <gtest/gtest.h>

#include <random>

#include "formulas/light/area.h"

namespace petrichor::shared {
namespace {

using glm::vec3;

TEST(RectangleIrradiance, HasTheKnownFormFactors)
{
    // A unit square 1 m over a parallel receiver; one that fills the hemisphere.
    const vec3 f = rectangle_irradiance({0, 1, 0}, {0.5f, 0, 0}, {0, 0, 0.5f});
    EXPECT_NEAR(f.y, 0.23946f, 5e-5f);
    EXPECT_NEAR(f.x, 0.0f, 1e-5f);
    EXPECT_NEAR(f.z, 0.0f, 1e-5f);
    EXPECT_NEAR(rectangle_irradiance({0, 1, 0}, {1e4f, 0, 0}, {0, 0, 1e4f}).y, 1.0f, 1e-3f);
    // Far away: area over pi d^2.
    const vec3 far = rectangle_irradiance({0, 100, 0}, {0.5f, 0, 0}, {0, 0, 0.5f});
    EXPECT_NEAR(far.y * 3.14159265f * 10000.0f, 1.0f, 2e-3f);
    // From behind the sign turns.
    EXPECT_NEAR(rectangle_irradiance({0, 1, 0}, {0, 0, 0.5f}, {0.5f, 0, 0}).y, -0.23946f, 5e-5f);
}

TEST(RectangleIrradiance, IsTheSumOverItsSurface)
{
    std::mt19937 random(3);
    const auto unit = [&random] { return static_cast<float>(random() >> 8) / 16777216.0f; };
    for (int k = 0; k < 40; ++k) {
        const vec3 centre(2.0f * unit() - 1.0f, 1.5f + unit(), 2.0f * unit() - 1.0f);
        const vec3 u(0.2f + 0.6f * unit(), 0.3f * unit(), 0.2f * unit());
        const vec3 v = glm::cross(u, glm::normalize(vec3(unit(), 0.2f, unit() - 0.5f)));
        const vec3 n = glm::normalize(glm::cross(u, v));
        const float area = 4.0f * glm::length(u) * glm::length(v);
        vec3 sum(0.0f);
        const int side = 60;
        for (int i = 0; i < side * side; ++i) {
            const float s = (static_cast<float>(i % side) + 0.5f) / side * 2.0f - 1.0f;
            const float t = (static_cast<float>(i / side) + 0.5f) / side * 2.0f - 1.0f;
            const vec3 p = centre + s * u + t * v;
            const float d2 = glm::dot(p, p);
            const vec3 l = p / std::sqrt(d2);
            sum += l * (-glm::dot(n, l) / d2 * area / (side * side) * 0.31830989f);
        }
        const vec3 f = rectangle_irradiance(centre, u, v);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(f[c], sum[c], 3e-4f) << k;
    }
}

TEST(SphereFormFactor, IsTheSumOverTheCapAboveTheHorizon)
{
    for (const float f : {0.01f, 0.2f, 0.6f, 0.9f}) {
        const double cap = std::sqrt(1.0 - static_cast<double>(f));  // cosine of the half angle
        for (float nl = -0.95f; nl < 0.96f; nl += 0.19f) {
            const double level = std::sqrt(1.0 - static_cast<double>(nl) * static_cast<double>(nl));
            double sum = 0.0;
            const int rings = 400, steps = 400;
            for (int i = 0; i < rings; ++i) {
                const double c = cap + (1.0 - cap) * (i + 0.5) / rings;
                const double s = std::sqrt(1.0 - c * c);
                for (int j = 0; j < steps; ++j) {
                    const double phi = 6.283185307 * (j + 0.5) / steps;
                    const double up = c * static_cast<double>(nl) + s * std::cos(phi) * level;
                    sum += std::max(up, 0.0);
                }
            }
            sum *= (1.0 - cap) / rings * 2.0 / steps;  // over pi
            EXPECT_NEAR(sphere_form_factor(f, nl), sum, 2e-3) << f << " " << nl;
        }
    }
}

}  // namespace
}  // namespace petrichor::shared
