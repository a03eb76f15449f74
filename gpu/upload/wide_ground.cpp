#include "gpu/upload/wide_ground.h"

#include <cmath>
#include <cstddef>

#include "formulas/weather/ground_tone.h"

namespace petrichor::gpu {

std::vector<bool> wide_ground(const scene::Scene& scene)
{
    std::vector<double> area_m2(scene.materials.size(), 0.0);
    for (const scene::Instance& instance : scene.instances) {
        const glm::dmat3 to_world(instance.to_world);
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            if (p.material >= area_m2.size()) continue;
            for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
                const glm::dvec3 a(p.positions[p.indices[i]]);
                const glm::dvec3 b(p.positions[p.indices[i + 1]]);
                const glm::dvec3 c(p.positions[p.indices[i + 2]]);
                const glm::dvec3 face = glm::cross(to_world * (b - a), to_world * (c - a));
                const double size = glm::length(face);
                // Either way up: what winding says is often wrong.
                if (std::isfinite(size) && std::abs(face.y) > 0.5 * size) area_m2[p.material] += 0.5 * size;
            }
        }
    }
    std::vector<bool> wide;
    for (const double area : area_m2) wide.push_back(area >= static_cast<double>(shared::kWideGround_m2));
    return wide;
}

}  // namespace petrichor::gpu
