// The shapes of lights as lines: their points lie on the shapes.
#include "scene/light_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/light_shape.h"

namespace petrichor::scene {
namespace {

Light lamp(LightKind kind)
{
    Light light;
    light.kind = kind;
    light.position_m = {1.0f, 2.0f, 3.0f};
    light.direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.2f));
    light.up = up_of(light);
    return light;
}

TEST(LightLines, OfASphereLieOnIt)
{
    Light light = lamp(LightKind::Point);
    EXPECT_EQ(light_lines(light).size(), 3u) << "a point is a cross";
    light.radius_m = 0.4f;
    const auto lines = light_lines(light);
    ASSERT_EQ(lines.size(), 3u);
    for (const auto& line : lines) {
        EXPECT_EQ(line.front(), line.back());
        for (const glm::vec3& at : line) EXPECT_NEAR(glm::length(at - light.position_m), 0.4f, 1e-5f);
    }
}

TEST(LightLines, OfATubeLieAroundItsAxis)
{
    Light light = lamp(LightKind::Point);
    light.radius_m = 0.1f;
    light.length_m = 1.5f;
    const auto lines = light_lines(light);
    ASSERT_EQ(lines.size(), 6u);
    for (const auto& line : lines) {
        for (const glm::vec3& at : line) {
            const float along = glm::dot(at - light.position_m, light.up);
            EXPECT_NEAR(std::abs(along), 0.75f, 1e-5f);
            EXPECT_NEAR(glm::length(at - light.position_m - light.up * along), 0.1f, 1e-5f);
        }
    }
}

TEST(LightLines, OfARectangleAreItsEdgesAndItsFront)
{
    Light light = lamp(LightKind::Rectangle);
    light.half_u_m = {0.5f, 0.0f, 0.0f};
    light.half_v_m = {0.0f, 0.0f, 0.25f};
    light.direction = {0.0f, -1.0f, 0.0f};
    auto lines = light_lines(light);
    ASSERT_EQ(lines.size(), 2u);
    float around = 0.0f;
    for (std::size_t i = 0; i + 1 < lines[0].size(); ++i) around += glm::length(lines[0][i + 1] - lines[0][i]);
    EXPECT_NEAR(around, 3.0f, 1e-5f);
    EXPECT_LT(lines[1][1].y, light.position_m.y);
    light.both_sides = true;
    EXPECT_EQ(light_lines(light).size(), 3u);
}

TEST(LightLines, OfASpotOpenAsItsCone)
{
    Light light = lamp(LightKind::Spot);
    light.outer_cone_rad = 0.5f;
    const auto lines = light_lines(light);
    ASSERT_EQ(lines.size(), 5u);
    for (std::size_t i = 1; i < 5; ++i) {
        const glm::vec3 side = glm::normalize(lines[i][1] - lines[i][0]);
        EXPECT_NEAR(glm::dot(side, light.direction), std::cos(0.5f), 1e-5f);
    }
    light.radius_m = 0.2f;
    EXPECT_EQ(light_lines(light).size(), 6u) << "a disc";
    EXPECT_TRUE(light_lines(lamp(LightKind::Directional)).empty());
}

}  // namespace
}  // namespace petrichor::scene
