// Uniform directions beside the flawed way: moments that tell them apart.
#include "formulas/light/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace petrichor {
namespace {

struct Moments {
    double x2 = 0.0, waist = 0.0, poles = 0.0, length = 0.0, weighed_x2 = 0.0, weights = 0.0;
};

template <class Direction>
Moments moments_of(const Direction& direction)
{
    constexpr int kAll = 400000;  // Roberts' sequence: no noise to speak of
    Moments m;
    const auto part = [](double x) { return static_cast<float>(x - std::floor(x)); };
    for (int i = 1; i <= kAll; ++i) {
        const glm::vec3 d = direction(part(0.8191725133961645 * i), part(0.6710436067037893 * i),
                                      part(0.5497004779019703 * i));
        const auto x = static_cast<double>(d.x);
        m.x2 += x * x;
        m.waist += std::abs(x) < 0.1 ? 1.0 : 0.0;
        m.poles += std::abs(x) > 0.9 ? 1.0 : 0.0;
        m.length += static_cast<double>(glm::length(d));
        const auto w = 1.0 / static_cast<double>(shared::seed_sphere_density(d));
        m.weighed_x2 += w * x * x;
        m.weights += w;
    }
    for (double* v : {&m.x2, &m.waist, &m.poles, &m.length}) *v /= kAll;
    m.weighed_x2 /= m.weights;
    return m;
}

TEST(Directions, UniformOnesHaveTheMomentsOfTheSphere)
{
    const Moments m =
        moments_of([](float a, float b, float) { return shared::uniform_sphere(a, b); });
    EXPECT_NEAR(m.x2, 1.0 / 3.0, 1e-3);
    EXPECT_NEAR(m.waist, 0.1, 1e-3);
    EXPECT_NEAR(m.poles, 0.1, 1e-3);
    EXPECT_NEAR(m.length, 1.0, 1e-6);
}

TEST(Directions, TheBallIsFilledEvenly)
{
    const Moments m =
        moments_of([](float a, float b, float c) { return shared::uniform_ball(a, b, c); });
    EXPECT_NEAR(m.length, 0.75, 1e-3);  // mean radius
    EXPECT_NEAR(m.x2, 0.2, 1e-3);
}

TEST(Directions, TheSeedsThreeAnglesAreNotUniform)
{
    const Moments m = moments_of([](float a, float b, float c) { return shared::seed_sphere(a, b, c); });
    EXPECT_NEAR(m.x2, 0.5 - 2.0 / (std::numbers::pi * std::numbers::pi), 1e-3);  // 0.29736
    EXPECT_NEAR(m.waist, 0.1235, 1e-3);
    EXPECT_NEAR(m.poles, 0.0824, 1e-3);
    EXPECT_NEAR(m.length, 1.0, 1e-6);
    // Weighed by the inverse of its density it is.
    EXPECT_NEAR(m.weighed_x2, 1.0 / 3.0, 2e-3);
}

}  // namespace
}  // namespace petrichor
