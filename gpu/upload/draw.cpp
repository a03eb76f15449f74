#include "gpu/upload/draw.h"

#include <algorithm>
#include <tuple>

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

shared::DrawConstants draw_constants(const Draw& draw)
{
    shared::DrawConstants c{};
    const glm::mat4& m = draw.to_world;
    const glm::mat3 linear(m);
    // Cofactors: the inverse transpose times the determinant; keeps normals right under any scale.
    glm::mat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                       glm::cross(linear[0], linear[1]));
    if (draw.mirrored) cofactor = -cofactor;
    for (int row = 0; row < 3; ++row) {
        c.to_world[row] = glm::vec4(m[0][row], m[1][row], m[2][row], m[3][row]);
        c.normal_to_world[row] =
            glm::vec4(cofactor[0][row], cofactor[1][row], cofactor[2][row], 0.0f);
    }
    c.instance_id = draw.instance_id;
    c.material_id = draw.material;
    c.look = draw.look;
    return c;
}

bool has_holes(const GpuScene& scene, const Draw& draw)
{
    const GpuMaterial& material = scene.materials()[draw.material];
    return material.masked || material.blended;
}

std::vector<const Draw*> visible_draws(const GpuScene& scene, const glm::mat4& world_to_clip,
                                       const glm::vec3& camera_m, Draws which)
{
    const Frustum frustum(world_to_clip);
    std::vector<std::tuple<bool, float, const Draw*>> keyed;
    for (const Draw& draw : scene.draws()) {
        if (!frustum.touches(draw.centre_m, draw.radius_m)) continue;
        const bool blended = scene.materials()[draw.material].blended;
        if (which != Draws::All && blended != (which == Draws::LetLightThrough)) continue;
        const float nearest = glm::length(draw.centre_m - camera_m) - draw.radius_m;
        keyed.emplace_back(has_holes(scene, draw), nearest, &draw);
    }
    std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) {
        return std::make_pair(std::get<0>(a), std::get<1>(a)) <
               std::make_pair(std::get<0>(b), std::get<1>(b));
    });
    std::vector<const Draw*> draws;
    for (const auto& entry : keyed) draws.push_back(std::get<2>(entry));
    return draws;
}

void bind_geometry(VkCommandBuffer commands, const GpuScene& scene)
{
    const VkBuffer buffer = scene.vertices().buffer.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
    vkCmdBindIndexBuffer(commands, scene.indices().buffer.get(), 0, VK_INDEX_TYPE_UINT32);
}

void set_facing(VkCommandBuffer commands, VkCullModeFlags cull, bool mirrored)
{
    vkCmdSetCullMode(commands, cull);
    vkCmdSetFrontFace(commands,
                      mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

}  // namespace petrichor::gpu
