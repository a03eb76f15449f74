#include "scene/scene.h"

#include <limits>

namespace petrichor::scene {

Bounds scene_bounds(const Scene& scene)
{
    Bounds bounds{glm::vec3(std::numeric_limits<float>::max()),
                  glm::vec3(std::numeric_limits<float>::lowest())};
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                const auto world = glm::vec3(instance.to_world * glm::vec4(position, 1.0f));
                bounds.low = glm::min(bounds.low, world);
                bounds.high = glm::max(bounds.high, world);
            }
        }
    }
    if (bounds.low.x > bounds.high.x) return {};
    return bounds;
}

}  // namespace petrichor::scene
