#include "weather/models/artist/timeline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "weather/models/artist/detail/polynomial.h"

namespace petrichor::weather {
namespace {

Channel zigzag(Interpolation interpolation)
{
    return {{0, 1000000, 3000000, 4000000}, {0.0, 2.0, 2.0, -1.0}, interpolation};
}

TEST(Timeline, HoldJumpsAtItsKeys)
{
    const Channel channel = zigzag(Interpolation::Hold);
    EXPECT_EQ(value_at(channel, -5.0), 0.0);
    EXPECT_EQ(value_at(channel, 999999.9), 0.0);
    EXPECT_EQ(value_at(channel, 1e6), 2.0);
    EXPECT_EQ(value_before(channel, 1e6), 0.0);
    EXPECT_EQ(value_before(channel, 1000000.1), 2.0);
    EXPECT_EQ(value_at(channel, 9e9), -1.0);
    EXPECT_EQ(value_before(channel, 0.0), 0.0);
}

TEST(Timeline, LinearDrawsStraightLines)
{
    const Channel channel = zigzag(Interpolation::Linear);
    EXPECT_DOUBLE_EQ(value_at(channel, 250000.0), 0.5);
    EXPECT_EQ(value_at(channel, 2e6), 2.0);
    EXPECT_DOUBLE_EQ(value_at(channel, 3.5e6), 0.5);
}

TEST(Timeline, SmoothPassesItsKeysWithoutOvershoot)
{
    const Channel channel = zigzag(Interpolation::Smooth);
    for (std::size_t i = 0; i < channel.times.size(); ++i) {
        EXPECT_NEAR(value_at(channel, static_cast<double>(channel.times[i])), channel.values[i],
                    1e-15);
    }
    for (double t = 0; t <= 4e6; t += 1e4) {
        EXPECT_LE(value_at(channel, t), 2.0 + 1e-12);
        EXPECT_GE(value_at(channel, t), -1.0 - 1e-12);
    }
    EXPECT_NEAR(value_at(channel, 5e5), 1.0, 1e-12);  // flat at both ends: a smoothstep
}

// The Hermite cubic through both keys, with their slopes: an ease that overshoots on purpose.
TEST(Timeline, SmoothTakesSlopesOfItsOwn)
{
    Channel channel{.times = {0, 2000000, 4000000},
                    .values = {1.0, 1.0, 3.0},
                    .interpolation = Interpolation::Smooth,
                    .slopes = {{0.0, 3.0}, {-3.0, 1.0}}};
    EXPECT_EQ(value_at(channel, 2e6), 1.0);
    EXPECT_NEAR(value_at(channel, 1e6), 1.0 + 2.0 * 3.0 / 4.0, 1e-12);
    EXPECT_NEAR((value_at(channel, 1e3) - 1.0) / 1e-3, 3.0, 1e-2);
    EXPECT_NEAR((1.0 - value_at(channel, 2e6 - 1e3)) / 1e-3, -3.0, 1e-2);
    EXPECT_NEAR((value_at(channel, 2e6 + 1e3) - 1.0) / 1e-3, 1.0, 1e-2);
    // The last key gives none: flat, as without slopes.
    EXPECT_NEAR((3.0 - value_at(channel, 4e6 - 1e3)) / 1e-3, 0.0, 1e-2);
    EXPECT_NEAR(range_of(channel).high, 3.0, 1e-12);
    channel.values[2] = 1.0;
    EXPECT_NEAR(range_of(channel).high, 2.5, 1e-12);
    EXPECT_NEAR(range_of(channel).low, 1.0, 1e-12);
    channel.interpolation = Interpolation::Linear;
    EXPECT_EQ(value_at(channel, 1e6), 1.0);
}

TEST(Timeline, CubicsAgreeWithValues)
{
    for (auto kind : {Interpolation::Hold, Interpolation::Linear, Interpolation::Smooth}) {
        const Channel channel = zigzag(kind);
        for (double start_us : {0.0, 123456.5, 1e6, 3.25e6}) {
            const ChannelCubic cubic = cubic_at(channel, start_us);
            for (double x : {0.0, 0.1, 0.2, 0.5}) {
                const double sum =
                    cubic.c[0] + x * (cubic.c[1] + x * (cubic.c[2] + x * cubic.c[3]));
                EXPECT_NEAR(sum, value_at(channel, start_us + x * 1e6), 1e-12);
            }
        }
    }
}

TEST(Timeline, ParametersOverrideTheBase)
{
    Timeline timeline{constant_channel(5), constant_channel(0), {}};
    timeline.parameters["evaporation_rate_cracks"] = zigzag(Interpolation::Linear);
    timeline.parameters["script_controlled"] = {{0, 2000000}, {1, 0}, Interpolation::Hold};
    EXPECT_DOUBLE_EQ(params_at(timeline, {}, 5e5).evaporation_rate_cracks, 1.0);
    EXPECT_TRUE(params_before(timeline, {}, 2e6).script_controlled);
    EXPECT_FALSE(params_at(timeline, {}, 2e6).script_controlled);
    EXPECT_EQ(timeline.end(), 4000000);
}

TEST(Timeline, NamesAndTimes)
{
    EXPECT_EQ(interpolation_named("smooth"), Interpolation::Smooth);
    EXPECT_FALSE(interpolation_named("cubic"));
    EXPECT_EQ(to_time_us(1.0 / 3.0), 333333);
    EXPECT_THROW(to_time_us(std::nan("")), Error);
    EXPECT_THROW(to_time_us(1e12), Error);
}

TEST(Timeline, BadChannelsAreNamed)
{
    Timeline timeline{constant_channel(5), constant_channel(0), {}};
    EXPECT_NO_THROW(check_timeline(timeline));
    timeline.temperature_c.values[0] = std::nan("");
    EXPECT_THROW(check_timeline(timeline), Error);
    timeline.temperature_c = {{0, 0}, {1, 2}, Interpolation::Hold};
    EXPECT_THROW(check_timeline(timeline), Error);
    timeline.temperature_c = {{0}, {1, 2}, Interpolation::Hold};
    EXPECT_THROW(check_timeline(timeline), Error);
}

TEST(Polynomial, FindsEverySignChange)
{
    Polynomial product = constant(1.0);  // (x-1)(x-2)(x-3)(x-3.5)
    for (double root : {1.0, 2.0, 3.0, 3.5}) {
        Polynomial factor;
        factor.c = {-root, 1.0};
        factor.degree = 1;
        product = product * factor;
    }
    const auto roots = sign_changes(product, 0.0, 5.0);
    ASSERT_EQ(roots.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(roots[i], (std::vector<double>{1, 2, 3, 3.5})[i], 1e-12);
    }
    EXPECT_EQ(sign_changes(product, 2.5, 3.2).size(), 1u);
    Polynomial touches;  // (x-1)^2
    touches.c = {1.0, -2.0, 1.0};
    touches.degree = 2;
    EXPECT_TRUE(sign_changes(touches, 0.0, 5.0).empty());
    Polynomial cube;  // (x-1)^3: a crossing where the slope is zero too
    cube.c = {-1.0, 3.0, -3.0, 1.0};
    cube.degree = 3;
    ASSERT_EQ(sign_changes(cube, 0.0, 5.0).size(), 1u);
    EXPECT_NEAR(sign_changes(cube, 0.0, 5.0)[0], 1.0, 1e-4);
}

TEST(Polynomial, AlgebraAgreesWithEvaluation)
{
    Polynomial a;
    a.c = {1.0, -2.0, 0.5};
    a.degree = 2;
    Polynomial b;
    b.c = {3.0, 1.0};
    b.degree = 1;
    for (double x : {-1.0, 0.0, 0.7, 4.0}) {
        EXPECT_NEAR((a * b)(x), a(x) * b(x), 1e-12);
        EXPECT_NEAR((a - b)(x), a(x) - b(x), 1e-12);
        EXPECT_NEAR(shifted(a, 1.5)(x), a(x + 1.5), 1e-12);
        EXPECT_NEAR(stretched(a, 0.3)(x), a(0.3 * x), 1e-12);
        EXPECT_NEAR(derivative(integral(a))(x), a(x), 1e-12);
    }
}

}  // namespace
}  // namespace petrichor::weather
