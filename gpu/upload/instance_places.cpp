#include "gpu/upload/instance_places.h"

#include <algorithm>
#include <cstring>

#include "gpu/upload/draw.h"

namespace petrichor::gpu {

namespace {

constexpr std::size_t kMapsAFrame = 32;  // cascades, the sky, the rain, some faces of lamps
constexpr std::size_t kMostPlaces = 512u << 10;

// Of a material with holes in a relief twice: its casters are asked in the world, too.
std::size_t places_in_runs(const GpuScene& scene)
{
    const std::vector<Draw>& draws = scene.draws();
    std::size_t all = 0;
    for (std::size_t begin = 0, end = 0; begin < draws.size(); begin = end) {
        for (end = begin + 1; end < draws.size() && same_shape(draws[begin], draws[end]);) ++end;
        const GpuMaterial& material = scene.materials()[draws[begin].material];
        const std::size_t each = material.masked && material.parallax != PARALLAX_NONE ? 2 : 1;
        if (end - begin >= kLeastRun) all += each * (end - begin);
    }
    return all;
}

}  // namespace

bool same_shape(const Draw& a, const Draw& b)
{
    return a.first_index == b.first_index && a.index_count == b.index_count &&
           a.vertex_offset == b.vertex_offset && a.material == b.material && a.mirrored == b.mirrored;
}

void InstancePlaces::reset(const GpuScene& scene)
{
    used_ = 0;
    if (scene_ == &scene) return;
    scene_ = &scene;
    places_ = nullptr;
    arena_ = nullptr;
    capacity_ = std::min<std::size_t>({kMapsAFrame * places_in_runs(scene), kMostPlaces,
                                       device_->limits().maxTexelBufferElements / 4});
    if (capacity_ == 0) return;
    arena_ = std::make_unique<MemoryArena>(*device_);
    places_ = arena_->buffer({.name = "instance_places",
                              .size = capacity_ * sizeof(glm::mat4),
                              .usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                              .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                              .host = true});
}

std::optional<std::uint32_t> InstancePlaces::add(std::span<const glm::mat4> clip_from_objects)
{
    if (clip_from_objects.size() > capacity_ - used_) return std::nullopt;
    const auto first = static_cast<std::uint32_t>(used_);
    std::memcpy(places_->mapped + used_ * sizeof(glm::mat4), clip_from_objects.data(),
                clip_from_objects.size_bytes());
    used_ += clip_from_objects.size();
    return first;
}

}  // namespace petrichor::gpu
