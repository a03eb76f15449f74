#include "scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace petrichor::scene {
namespace {

glm::vec3 projected(const Camera& camera, const glm::vec3& at, float far_m = 0.0f)
{
    const glm::vec4 clip = clip_projection(camera, 200, 100, far_m) * glm::vec4(at, 1.0f);
    return glm::vec3(clip) / clip.w;
}

TEST(ClipProjection, PutsTheEdgesOfTheFieldOfViewOnTheEdgesOfThePicture)
{
    Camera camera;
    camera.vertical_fov_rad = 1.0f;
    const float half = 3.0f * std::tan(0.5f);
    EXPECT_NEAR(projected(camera, {0.0f, half, -3.0f}).y, 1.0f, 1e-6f);  // up is up
    EXPECT_NEAR(projected(camera, {2.0f * half, 0.0f, -3.0f}).x, 1.0f, 1e-6f);
}

TEST(ClipProjection, ReversesDepth)
{
    Camera camera;
    camera.near_m = 0.25f;
    EXPECT_FLOAT_EQ(projected(camera, {0, 0, -0.25f}).z, 1.0f);
    EXPECT_FLOAT_EQ(projected(camera, {0, 0, -25.0f}).z, 0.01f);
    EXPECT_LT(projected(camera, {0, 0, -1e9f}).z, 1e-8f);
}

TEST(ClipProjection, OfAnOrthographicCameraDoesNotShrinkWithDistance)
{
    Camera camera;
    camera.orthographic_height_m = 4.0f;
    for (const float away : {0.0f, 5.0f, 10.0f}) {
        const glm::vec3 p = projected(camera, {4.0f, 2.0f, -away}, 10.0f);
        EXPECT_FLOAT_EQ(p.x, 1.0f);
        EXPECT_FLOAT_EQ(p.y, 1.0f);
        EXPECT_NEAR(p.z, 1.0f - 0.1f * away, 1e-6f);
    }
}

}  // namespace
}  // namespace petrichor::scene
