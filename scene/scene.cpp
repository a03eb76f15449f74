#include "scene/scene.h"

#include <cmath>
#include <limits>

#include "scene/shapes.h"

namespace petrichor::scene {

Bounds scene_bounds(const Scene& scene)
{
    Bounds bounds{glm::vec3(std::numeric_limits<float>::max()),
                  glm::vec3(std::numeric_limits<float>::lowest())};
    for (const Instance& instance : scene.instances) {
        if (instance.backdrop || !instance.stands()) continue;
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                const auto world = glm::vec3(instance.to_world * glm::vec4(position, 1.0f));
                bounds.low = glm::min(bounds.low, world);
                bounds.high = glm::max(bounds.high, world);
            }
        }
    }
    for (const MarchedShape& shape : scene.shapes) {
        const Bounds reach = shape.reach.value_or(shape_bounds(shape, shape.rest));
        bounds.low = glm::min(bounds.low, reach.low);
        bounds.high = glm::max(bounds.high, reach.high);
    }
    if (scene.reach) {
        bounds.low = glm::min(bounds.low, scene.reach->low);
        bounds.high = glm::max(bounds.high, scene.reach->high);
    }
    if (bounds.low.x > bounds.high.x) return {};
    return bounds;
}

glm::vec2 half_extent_m(const Camera& camera, int width, int height)
{
    const float half_y = camera.orthographic_height_m > 0.0f
                             ? 0.5f * camera.orthographic_height_m
                             : std::tan(0.5f * camera.vertical_fov_rad);
    return {half_y * static_cast<float>(width) / static_cast<float>(height), half_y};
}

glm::mat4 clip_projection(const Camera& camera, int width, int height, float far_m)
{
    const glm::vec2 half = half_extent_m(camera, width, height);
    glm::mat4 projection(0.0f);
    projection[0][0] = 1.0f / half.x;
    projection[1][1] = 1.0f / half.y;
    if (camera.orthographic_height_m > 0.0f) {
        projection[2][2] = 1.0f / far_m;
        projection[3][2] = 1.0f;
        projection[3][0] = -camera.shift.x;
        projection[3][1] = -camera.shift.y;
        projection[3][3] = 1.0f;
    } else {
        projection[2][0] = camera.shift.x;
        projection[2][1] = camera.shift.y;
        projection[2][3] = -1.0f;
        projection[3][2] = camera.near_m;
    }
    return projection;
}

}  // namespace petrichor::scene
