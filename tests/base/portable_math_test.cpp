#include "base/portable_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace petrichor {
namespace {

// The libraries are right to their last bit or two; so are these, to 1e-11.
TEST(PortableMath, AgreesWithTheLibraryTo1em11)
{
    double worst_exp = 0.0, worst_log = 0.0, worst_turn = 0.0;
    for (int i = -60000; i <= 60000; ++i) {
        const double x = i * 0.01137;
        worst_exp = std::max(worst_exp, std::abs(portable_exp(x) / std::exp(x) - 1.0));
        const double y = std::exp(0.5 * x);
        const double log = std::log(y);
        worst_log =
            std::max(worst_log, std::abs(portable_log(y) - log) / std::max(1.0, std::abs(log)));
        const SinCos turn = portable_sin_cos(x);
        worst_turn = std::max(
            {worst_turn, std::abs(turn.sine - std::sin(x)), std::abs(turn.cosine - std::cos(x))});
    }
    EXPECT_LT(worst_exp, 1e-11);
    EXPECT_LT(worst_log, 1e-11);
    EXPECT_LT(worst_turn, 1e-11);
}

// Near 1 a logarithm loses no digits.
TEST(PortableMath, LogarithmNearOneIsExactInItsOwnScale)
{
    for (const double off : {1e-3, -1e-3, 1e-7, -1e-7, 3e-12}) {
        EXPECT_NEAR(portable_log(1.0 + off) / std::log1p((1.0 + off) - 1.0), 1.0, 1e-11);
    }
    EXPECT_EQ(portable_log(1.0), 0.0);
}

TEST(PortableMath, EdgesStayFinite)
{
    EXPECT_EQ(portable_exp(0.0f), 1.0f);
    EXPECT_EQ(portable_exp(-1e30f), 0.0f);
    EXPECT_TRUE(std::isfinite(portable_exp(1e300)));
    EXPECT_EQ(portable_pow(0.0f, 0.8f), 0.0f);
    EXPECT_NEAR(portable_pow(0.3f, 0.8f), std::pow(0.3f, 0.8f), 1e-7f);
    EXPECT_EQ(portable_sin(0.0f), 0.0f);
    EXPECT_EQ(portable_cos(0.0f), 1.0f);
}

// The very bits, which no library decides: the same on every machine.
TEST(PortableMath, KnownBits)
{
    EXPECT_EQ(std::bit_cast<std::uint32_t>(portable_exp(1.0f)), 0x402df854u);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(portable_log(10.0f)), 0x40135d8eu);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(portable_sin(1.0f)), 0x3f576aa4u);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(portable_cos(1.0f)), 0x3f0a5140u);
}

}  // namespace
}  // namespace petrichor
