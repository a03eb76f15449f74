#include "gpu/upload/draw.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "gpu/upload/morton.h"

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
    c.fade = draw.fade;
    return c;
}

void GpuScene::update_draw_rows(const Device& device)
{
    if (rows_poses_ == poses_ || (rows_poses_ && !has_runs_)) return;
    rows_poses_ = poses_;
    std::vector<shared::DrawConstants> rows;
    if (!draw_rows_) {
        for (std::size_t begin = 0, end = 0; begin < draws_.size(); begin = end) {
            // Whatever a moment shows of them.
            const auto one_shape = [&](const Draw& d) {
                return d.first_index == draws_[begin].first_index && d.vertex_offset == draws_[begin].vertex_offset &&
                       d.material == draws_[begin].material;
            };
            for (end = begin + 1; end < draws_.size() && one_shape(draws_[end]);) ++end;
            has_runs_ = has_runs_ || end - begin >= kLeastRun;
        }
    }
    for (const Draw& draw : draws_) {
        if (has_runs_) rows.push_back(draw_constants(draw));
    }
    if (rows.empty()) rows.emplace_back();
    if (!draw_rows_) {
        draw_rows_ = arena_.buffer(
            {.name = "draw_rows",
             .size = rows.size() * sizeof(shared::DrawConstants),
             .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
             .texel_format = VK_FORMAT_R32G32B32A32_UINT});
    }
    upload_buffer(device, *draw_rows_, std::as_bytes(std::span(rows)));
}

bool has_holes(const GpuScene& scene, const Draw& draw)
{
    const GpuMaterial& material = scene.materials()[draw.material];
    return material.masked || material.blended || draw.fade != 0;
}

namespace {

// In the order of the scene's list.
std::vector<const Draw*> seen_draws(const GpuScene& scene, const glm::mat4& world_to_clip, Draws which)
{
    const Frustum frustum(world_to_clip);
    std::vector<const Draw*> seen;
    for (const Draw& draw : scene.draws()) {
        if (!draw.shown || draw.shape >= 0) continue;
        if (!frustum.touches(draw.centre_m, draw.radius_m)) continue;
        const bool blended = scene.materials()[draw.material].blended;
        if (which != Draws::All && blended != (which == Draws::LetLightThrough)) continue;
        seen.push_back(&draw);
    }
    return seen;
}

// b may be the instance after a.
bool alike(const Draw& a, const Draw& b)
{
    return &b == &a + 1 && a.first_index == b.first_index && a.index_count == b.index_count &&
           a.vertex_offset == b.vertex_offset && a.material == b.material &&
           a.mirrored == b.mirrored && a.fade == 0 && b.fade == 0;
}

}  // namespace

std::vector<DrawRun> visible_runs(const GpuScene& scene, const glm::mat4& world_to_clip,
                                  const glm::vec3& camera_m, Draws which)
{
    const std::vector<const Draw*> seen = seen_draws(scene, world_to_clip, which);
    std::vector<std::tuple<bool, float, DrawRun>> keyed;
    // What goes round the eye, ground or a room, is as far as it is wide: it stands behind most of what is in it, and would
    // be shaded all over to be covered.
    const auto nearest_m = [&](const Draw& draw) {
        const float nearest = glm::length(draw.centre_m - camera_m) - draw.radius_m;
        return nearest < 0.0f ? draw.radius_m : nearest;
    };
    for (std::size_t begin = 0, end = 0; begin < seen.size(); begin = end) {
        const bool holes = has_holes(scene, *seen[begin]);
        float nearest = nearest_m(*seen[begin]);
        for (end = begin + 1; end < seen.size() && alike(*seen[end - 1], *seen[end]); ++end)
            nearest = std::min(nearest, nearest_m(*seen[end]));
        const auto count = static_cast<std::uint32_t>(end - begin);
        if (count >= kLeastRun) {
            keyed.emplace_back(holes, nearest, DrawRun{seen[begin], count});
        } else {
            for (std::size_t i = begin; i < end; ++i)
                keyed.emplace_back(holes, nearest_m(*seen[i]), DrawRun{seen[i], 1});
        }
    }
    std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) {
        return std::make_pair(std::get<0>(a), std::get<1>(a)) <
               std::make_pair(std::get<0>(b), std::get<1>(b));
    });
    std::vector<DrawRun> runs;
    for (const auto& entry : keyed) runs.push_back(std::get<2>(entry));
    return runs;
}

void sort_draws(std::vector<Draw>& draws, const std::vector<GpuMaterial>& materials)
{
    Bounds box{glm::vec3(1e30f), glm::vec3(-1e30f)};
    for (const Draw& draw : draws) {
        box.low = glm::min(box.low, draw.centre_m);
        box.high = glm::max(box.high, draw.centre_m);
    }
    const auto key = [&](const Draw& d) {
        const GpuMaterial& m = materials[d.material];
        // What is laid over a scene keeps its order: its vertices are written in it.
        return std::make_tuple(m.blended, m.masked, m.cull == VK_CULL_MODE_NONE, d.material, d.overlay,
                               d.overlay ? 0u : d.first_index, d.overlay ? 0 : d.vertex_offset,
                               d.mirrored, d.shape, d.overlay ? 0u : morton(d.centre_m, box));
    };
    std::vector<std::pair<decltype(key(Draw{})), std::size_t>> order;
    order.reserve(draws.size());
    for (std::size_t i = 0; i < draws.size(); ++i) order.emplace_back(key(draws[i]), i);
    std::sort(order.begin(), order.end());
    std::vector<Draw> sorted;
    sorted.reserve(draws.size());
    for (const auto& entry : order) sorted.push_back(draws[entry.second]);
    draws = std::move(sorted);
}

void bind_geometry(VkCommandBuffer commands, const GpuScene& scene)
{
    const VkBuffer buffer = scene.vertices().buffer.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
    vkCmdBindIndexBuffer(commands, scene.indices().buffer.get(), 0, VK_INDEX_TYPE_UINT32);
}

void VertexBinder::bind(bool positions)
{
    if (positions == positions_) return;
    positions_ = positions;
    const VkBuffer buffer = (positions ? scene_->positions() : scene_->vertices()).buffer.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands_, 0, 1, &buffer, &offset);
}

void set_facing(VkCommandBuffer commands, VkCullModeFlags cull, bool mirrored)
{
    vkCmdSetCullMode(commands, cull);
    vkCmdSetFrontFace(commands,
                      mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

}  // namespace petrichor::gpu
