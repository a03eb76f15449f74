#include "gpu/passes/vertex_light/vertex_light.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "gpu/passes/vertex_light/vertex_light_io.h"
#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

template <class T>
std::unique_ptr<GpuBuffer> table(MemoryArena& arena, const char* name, VkFormat format, const std::vector<T>& texels)
{
    auto buffer = arena.buffer({.name = name,
                                .size = texels.size() * sizeof(T),
                                .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                                .texel_format = format,
                                .host = true});
    std::memcpy(buffer->mapped, texels.data(), texels.size() * sizeof(T));
    return buffer;
}

bool is_reached(const Draw& draw, const std::vector<glm::vec4>& balls)
{
    return std::any_of(balls.begin(), balls.end(), [&](const glm::vec4& ball) {
        const glm::vec3 apart = glm::vec3(ball) - draw.centre_m;
        const float reach_m = ball.w + draw.radius_m;
        return glm::dot(apart, apart) < reach_m * reach_m;
    });
}

}  // namespace

VertexLight::VertexLight(const Device& device) : device_(&device)
{
    prepare({}, {}, {});
}

void VertexLight::prepare(std::span<const Draw> draws, const LightTable& lights,
                          const std::function<bool(const glm::vec3& centre_m, float radius_m)>& in_view)
{
    if (lights.vertex_balls.size() > VERTEX_LIGHT_MOST) {
        throw Error("render: " + std::to_string(lights.vertex_balls.size()) + " lamps light by vertex; " +
                        std::to_string(VERTEX_LIGHT_MOST) + " may",
                    "Leave per_vertex out of some of [lamps].");
    }
    std::vector<std::uint32_t> firsts(std::max<std::size_t>(draws.size(), 1), VERTEX_LIGHT_NONE);
    std::vector<glm::uvec4> jobs;
    std::vector<glm::vec4> places;
    std::uint64_t used = 0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Draw& draw = draws[i];
        if (draw.index_count == 0 || draw.vertex_count == 0 || draw.shape >= 0) continue;
        if (in_view && !in_view(draw.centre_m, draw.radius_m)) continue;
        if (!is_reached(draw, lights.vertex_balls)) continue;
        const auto row = static_cast<std::uint32_t>(places.size() / VERTEX_LIGHT_DRAW_TEXELS);
        const shared::DrawConstants c = draw_constants(draw);
        places.insert(places.end(), std::begin(c.to_world), std::end(c.to_world));
        places.insert(places.end(), std::begin(c.normal_to_world), std::end(c.normal_to_world));
        const std::uint32_t first = static_cast<std::uint32_t>(draw.vertex_offset) + draw.first_vertex;
        // Modulo 2^32, like the sum that undoes it; a gap of one keeps it from being no number.
        if (static_cast<std::uint32_t>(used) - first == VERTEX_LIGHT_NONE) ++used;
        firsts[i] = static_cast<std::uint32_t>(used) - first;
        for (std::uint32_t at = 0; at < draw.vertex_count; at += VERTEX_LIGHT_GROUP)
            jobs.emplace_back(row, first + at, std::min<std::uint32_t>(VERTEX_LIGHT_GROUP, draw.vertex_count - at),
                              static_cast<std::uint32_t>(used) + at);
        used += draw.vertex_count;
        if (used > device_->limits().maxTexelBufferElements) {
            throw Error("render: lamps by vertex light more than " +
                            std::to_string(device_->limits().maxTexelBufferElements) + " vertices, which is what this device binds",
                        "Give those lamps shorter ranges ([lamps] range_m), or leave out their per_vertex.");
        }
    }
    groups_ = static_cast<std::uint32_t>(jobs.size());
    if (jobs.empty()) jobs.emplace_back(0u);
    if (places.empty()) places.emplace_back(0.0f);
    for (auto* buffer : {&firsts_, &jobs_, &draws_}) *buffer = nullptr;
    arena_ = std::make_unique<MemoryArena>(*device_);
    firsts_ = table(*arena_, "lit_firsts", VK_FORMAT_R32_UINT, firsts);
    jobs_ = table(*arena_, "lit_jobs", VK_FORMAT_R32G32B32A32_UINT, jobs);
    draws_ = table(*arena_, "lit_draws", VK_FORMAT_R32G32B32A32_SFLOAT, places);
    const VkDeviceSize bytes = std::max<std::uint64_t>(used, 1) * sizeof(glm::uvec2);
    if (light_ && light_->size >= bytes) return;
    light_ = nullptr;
    light_arena_ = std::make_unique<MemoryArena>(*device_);
    light_ = light_arena_->buffer({.name = "vertex_light",
                                   .size = bytes,
                                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                                   .texel_format = VK_FORMAT_R32G32_UINT});
}

void VertexLight::add(FrameGraph& graph, const GpuScene& scene, LightTable& lights, LightTables& light_tables) const
{
    if (groups_ == 0) return;
    const shared::VertexLightParams params{groups_, lights.count, static_cast<std::uint32_t>(lights.vertex_balls.size())};
    graph.add(ComputePass{.name = "vertex_light",
                          .shader = "vertex_light.comp",
                          .constants = {{VERTEX_LIGHT_SPEC_WAYS, lights.vertex_ways}},
                          .bindings = {{VERTEX_LIGHT_LAMPS, texels(*lights.texels)},
                                       {VERTEX_LIGHT_PROFILES, texels(light_tables.profiles())},
                                       {VERTEX_LIGHT_VERTICES, texels(scene.vertex_texels())},
                                       {VERTEX_LIGHT_JOBS, texels(*jobs_)},
                                       {VERTEX_LIGHT_DRAWS, texels(*draws_)},
                                       {VERTEX_LIGHT_OUT, storage_buffer(*light_)}},
                          .push = PushBlock(params),
                          .groups = {std::min<std::uint32_t>(groups_, VERTEX_LIGHT_GROUPS_X),
                                     (groups_ + VERTEX_LIGHT_GROUPS_X - 1) / VERTEX_LIGHT_GROUPS_X, 1}});
}

}  // namespace petrichor::gpu
