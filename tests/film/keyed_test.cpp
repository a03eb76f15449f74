#include "film/toml/keyed.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace petrichor::film {
namespace {

const KeyedNumber kSteps{{{0.0, 1.0}, {2.0, 3.0}, {3.0, 3.0}, {7.0, -1.0}}, Interpolation::Smooth};

TEST(ValueAt, PassesThroughEveryKeyAndHoldsOutside)
{
    for (const auto interpolation :
         {Interpolation::Hold, Interpolation::Linear, Interpolation::Smooth}) {
        const KeyedNumber number{kSteps.keys, interpolation};
        for (const NumberKey& key : number.keys) {
            EXPECT_DOUBLE_EQ(value_at(number, key.time_s), key.value);
        }
        EXPECT_EQ(value_at(number, -5.0), 1.0);
        EXPECT_EQ(value_at(number, 50.0), -1.0);
    }
}

TEST(ValueAt, SmoothNeverOvershoots)
{
    for (std::size_t i = 0; i + 1 < kSteps.keys.size(); ++i) {
        const auto& from = kSteps.keys[i];
        const auto& to = kSteps.keys[i + 1];
        for (int step = 0; step <= 100; ++step) {
            const double value =
                value_at(kSteps, from.time_s + (to.time_s - from.time_s) * step / 100.0);
            EXPECT_GE(value, std::min(from.value, to.value) - 1e-12);
            EXPECT_LE(value, std::max(from.value, to.value) + 1e-12);
        }
    }
}

TEST(ValueAt, HoldAndLinear)
{
    EXPECT_EQ(value_at({kSteps.keys, Interpolation::Hold}, 1.9), 1.0);
    EXPECT_DOUBLE_EQ(value_at({kSteps.keys, Interpolation::Linear}, 5.0), 1.0);
    EXPECT_EQ(value_at({}, 5.0, 42.0), 42.0);
}

TEST(PointAt, PassesThroughKeysWithSteadyVelocity)
{
    const std::vector<PathKey> path{
        {0.0, {0, 0, 0}}, {1.0, {1, 2, 0}}, {3.0, {5, 2, 1}}, {4.0, {6, 0, 1}}};
    for (const PathKey& key : path) {
        EXPECT_LT(glm::length(point_at(path, Interpolation::Smooth, key.time_s) - key.point),
                  1e-12);
    }
    const double h = 1e-6;
    const auto before = (point_at(path, Interpolation::Smooth, 1.0) -
                         point_at(path, Interpolation::Smooth, 1.0 - h)) /
                        h;
    const auto after = (point_at(path, Interpolation::Smooth, 1.0 + h) -
                        point_at(path, Interpolation::Smooth, 1.0)) /
                       h;
    EXPECT_LT(glm::length(before - after), 1e-4);
    EXPECT_GT(glm::length(before), 1.0);
}

}  // namespace
}  // namespace petrichor::film
