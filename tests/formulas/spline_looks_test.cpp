// A spline in two looks is the cubic B-spline: what is even stays even, what is straight stays straight, and nothing has an edge.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "formulas/light/cube_map.h"

namespace petrichor::shared {
namespace {

// Of texels at whole numbers, by a filter that is linear between them.
template <std::size_t N>
float looked_up(const std::array<float, N>& texels, float at)
{
    const float low = std::floor(at);
    const auto i = static_cast<std::size_t>(low);
    return glm::mix(texels.at(i), texels.at(i + 1), at - low);
}

template <std::size_t N>
float by_spline(const std::array<float, N>& texels, float at)
{
    const float low = std::floor(at);
    const vec3 looks = spline_looks(at - low);
    return glm::mix(looked_up(texels, low + looks.y), looked_up(texels, low + looks.x), looks.z);
}

TEST(SplineLooks, KeepWhatIsEvenAndWhatIsStraight)
{
    const std::array<float, 8> even{3, 3, 3, 3, 3, 3, 3, 3}, straight{0, 2, 4, 6, 8, 10, 12, 14};
    for (float at = 2.0f; at < 5.0f; at += 0.07f) {
        EXPECT_NEAR(by_spline(even, at), 3.0f, 1e-5f);
        EXPECT_NEAR(by_spline(straight, at), 2.0f * at, 1e-4f);
    }
}

TEST(SplineLooks, AreTheBSpline)
{
    const std::array<float, 8> one{0, 0, 0, 1, 0, 0, 0, 0};
    for (float at = 1.5f; at < 4.9f; at += 0.05f) {
        const float d = std::abs(at - 3.0f);
        const float expected = d >= 2.0f ? 0.0f : d >= 1.0f ? (2 - d) * (2 - d) * (2 - d) / 6.0f : 2.0f / 3.0f - d * d + 0.5f * d * d * d;
        EXPECT_NEAR(by_spline(one, at), expected, 1e-5f) << at;
    }
}

TEST(SplineLooks, AStepHasNoKinks)
{
    const std::array<float, 10> step{0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
    const float h = 0.02f;
    float sharpest = 0.0f, of_filter = 0.0f;
    for (float at = 2.5f; at < 6.5f; at += h) {
        const auto bend = [&](const auto& f) { return std::abs(f(at - h) - 2.0f * f(at) + f(at + h)) / h; };
        sharpest = std::max(sharpest, bend([&](float x) { return by_spline(step, x); }));
        of_filter = std::max(of_filter, bend([&](float x) { return looked_up(step, x); }));
    }
    EXPECT_LT(sharpest, 0.05f);
    EXPECT_GT(of_filter, 0.5f);
}

}  // namespace
}  // namespace petrichor::shared
