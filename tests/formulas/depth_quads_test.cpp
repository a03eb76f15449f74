// Depth maps that are read four texels at once, and directions by chance.
#include "formulas/weather/depth_quads.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formulas/noise/noise.h"

namespace petrichor::shared {
namespace {

float filtered(const glm::vec4& depths, float depth, const glm::vec2& share)
{
    const auto passes = [depth](float map) { return depth >= map ? 1.0f : 0.0f; };
    return glm::mix(glm::mix(passes(depths.x), passes(depths.y), share.x),
                    glm::mix(passes(depths.z), passes(depths.w), share.x), share.y);
}

TEST(DepthQuads, PassWhatFourTexelsPass)
{
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const glm::vec4 depths(hash_f(6 * i), hash_f(6 * i + 1), hash_f(6 * i + 2), hash_f(6 * i + 3));
        const float depth = hash_f(6 * i + 4);
        const glm::vec2 share(hash_f(6 * i + 5), hash_f(i + 90000));
        // Within a step of 16 bits either is right.
        bool near = false;
        for (int k = 0; k < 4; ++k) near = near || std::abs(depths[k] - depth) < 1.0f / 65535.0f;
        if (near) continue;
        EXPECT_NEAR(share_passed(depth_quad(depths), depth, share), filtered(depths, depth, share), 1e-6f) << i;
    }
}

TEST(DepthQuads, EndsOfTheRangePassAsTheyDo)
{
    const glm::uvec2 ends = depth_quad(glm::vec4(0.0f, 1.0f, 1.0f, 0.0f));
    EXPECT_EQ(share_passed(ends, 0.0f, glm::vec2(0.0f)), 1.0f);
    EXPECT_EQ(share_passed(ends, 1.0f, glm::vec2(0.5f)), 1.0f);
    EXPECT_EQ(share_passed(ends, 0.99f, glm::vec2(1.0f, 0.0f)), 0.0f);
    EXPECT_EQ(share_passed(ends, 0.99f, glm::vec2(0.25f, 0.0f)), 0.75f);
}

TEST(OnCircle, IsAThousandthBesideSineAndCosine)
{
    for (int i = 0; i < 1000; ++i) {
        const float turns = static_cast<float>(i) / 1000.0f;
        const glm::vec2 at = on_circle(turns);
        EXPECT_NEAR(at.x, std::cos(6.2831853f * turns), 1.2e-3f) << i;
        EXPECT_NEAR(at.y, std::sin(6.2831853f * turns), 1.2e-3f) << i;
    }
}

}  // namespace
}  // namespace petrichor::shared
