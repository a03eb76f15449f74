#include "formulas/light/lamp_glow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace petrichor::shared {
namespace {

constexpr float kDegree = 0.017453293f;

// As the passes put it together: distance and angle of the lamp, extinction, end of the ray.
float glow(float per_m, float distance_m, float angle_rad, float end_m)
{
    const GlowRay ray = glow_ray(per_m, distance_m * std::cos(angle_rad),
                                 distance_m * std::sin(angle_rad), end_m);
    return ray.begin * glow_tail(ray.u, ray.begin_v) - ray.end * glow_tail(ray.u, ray.end_v);
}

// Of the paper.
float glow_function(float u, float v)
{
    return glow_tail(u, 0.0f) - std::exp(-u * std::tan(v)) * glow_tail(u, v);
}

// Light scattered once along the ray, by steps.
double summed(double per_m, double distance_m, double angle_rad, double end_m)
{
    const double along = distance_m * std::cos(angle_rad);
    const double aside = distance_m * std::sin(angle_rad);
    double sum = 0.0;
    const int steps = 400000;
    for (int i = 0; i < steps; ++i) {
        const double s = end_m * (i + 0.5) / steps;
        const double d2 = aside * aside + (s - along) * (s - along);
        sum += per_m / (4.0 * 3.14159265358979) / d2 * std::exp(-per_m * (std::sqrt(d2) + s)) *
               end_m / steps;
    }
    return sum;
}

TEST(LampGlow, HasTheValuesOfTheReference)
{
    EXPECT_NEAR(glow_function(0.5f, 0.5f), 0.4401274f, 2e-6f);
    EXPECT_NEAR(glow_function(1.0f, 1.2f), 0.6150868f, 2e-6f);
    EXPECT_NEAR(glow(0.004f, 20.0f, 10.0f * kDegree, 100.0f), 2.393202e-4f, 2e-9f);
    EXPECT_NEAR(glow(0.02f, 20.0f, 10.0f * kDegree, 60.0f), 7.806366e-4f, 4e-9f);
    EXPECT_NEAR(glow(0.1f, 10.0f, 30.0f * kDegree, 30.0f), 8.234996e-4f, 8e-9f);
}

TEST(LampGlow, IsTheSumAlongTheRay)
{
    for (const double per_m : {0.001, 0.02, 0.2}) {
        for (const double distance : {1.0, 15.0, 60.0}) {
            for (const double angle : {0.05, 0.8, 2.5}) {  // the last: the lamp is behind
                for (const double end : {0.5, 20.0, 300.0}) {
                    const double exact = summed(per_m, distance, angle, end);
                    const double closed = static_cast<double>(
                        glow(static_cast<float>(per_m), static_cast<float>(distance),
                             static_cast<float>(angle), static_cast<float>(end)));
                    EXPECT_NEAR(closed, exact, 2e-3 * exact + 1e-7)
                        << per_m << " " << distance << " " << angle << " " << end;
                }
            }
        }
    }
}

TEST(LampGlow, GrowsWithTheRayAndIsNothingWithoutAir)
{
    float last = 0.0f;
    for (const float end : {1.0f, 5.0f, 20.0f, 25.0f, 80.0f, 1e5f}) {
        const float now = glow(0.01f, 20.0f, 0.2f, end);
        EXPECT_GE(now, last);
        last = now;
    }
    EXPECT_EQ(glow(0.0f, 20.0f, 0.2f, 100.0f), 0.0f);
    EXPECT_TRUE(std::isfinite(glow(10.0f, 1e4f, 3.1f, 1e5f)));
}

}  // namespace
}  // namespace petrichor::shared
