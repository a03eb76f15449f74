#include "gpu/upload/draw.h"

namespace petrichor::gpu {

Frustum::Frustum(const glm::mat4& m)
{
    const auto row = [&m](int i) { return glm::vec4(m[0][i], m[1][i], m[2][i], m[3][i]); };
    planes[0] = row(3) + row(0);
    planes[1] = row(3) - row(0);
    planes[2] = row(3) + row(1);
    planes[3] = row(3) - row(1);
    planes[4] = row(3) - row(2);  // near: depth <= 1
    for (glm::vec4& plane : planes) {
        const float length = glm::length(glm::vec3(plane));
        if (length > 0.0f) plane /= length;
    }
}

bool Frustum::touches(const glm::vec3& centre_m, float radius_m) const
{
    for (const glm::vec4& plane : planes) {
        if (glm::dot(glm::vec3(plane), centre_m) + plane.w < -radius_m) return false;
    }
    return true;
}

void bind_geometry(VkCommandBuffer commands, const GpuScene& scene)
{
    const VkBuffer buffer = scene.vertices().buffer.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
    vkCmdBindIndexBuffer(commands, scene.indices().buffer.get(), 0, VK_INDEX_TYPE_UINT32);
}

void set_facing(VkCommandBuffer commands, bool double_sided, bool mirrored)
{
    vkCmdSetCullMode(commands, double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
    vkCmdSetFrontFace(commands,
                      mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

}  // namespace petrichor::gpu
