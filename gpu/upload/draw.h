#ifndef PETRICHOR_GPU_UPLOAD_DRAW_H
#define PETRICHOR_GPU_UPLOAD_DRAW_H

#include "gpu/upload/gpu_scene.h"

namespace petrichor::gpu {

/// The six half spaces of a clip matrix (reversed infinite depth: five count).
struct Frustum {
    glm::vec4 planes[5];

    explicit Frustum(const glm::mat4& world_to_clip);
    bool touches(const glm::vec3& centre_m, float radius_m) const;
};

void bind_geometry(VkCommandBuffer commands, const GpuScene& scene);
void set_facing(VkCommandBuffer commands, bool double_sided, bool mirrored);

}  // namespace petrichor::gpu

#endif
