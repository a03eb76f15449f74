#include "gpu/passes/reflections/picture_around.h"

#include <algorithm>

#include "gpu/passes/reflections/keep_around_io.h"

namespace petrichor::gpu {
namespace {

constexpr int kLeastSide = 1024, kMostSide = 2048;

}  // namespace

PictureAround::PictureAround(const Device& device, int w, int h) : width(w), height(h), arena(device)
{
    const auto pixels = static_cast<VkDeviceSize>(w) * static_cast<VkDeviceSize>(h);
    const auto rows = [&](const char* name, VkFormat format, VkDeviceSize bytes) {
        return arena.buffer({.name = name,
                             .size = pixels * bytes,
                             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                             .texel_format = format});
    };
    depth = rows("around_depth", VK_FORMAT_R32_SFLOAT, 4);
    light = rows("around_light", VK_FORMAT_R16G16B16A16_SFLOAT, 8);
    glow = rows("around_glow", VK_FORMAT_R16G16B16A16_SFLOAT, 8);
}

Frame around_frame(const Frame& whole)
{
    Frame small = whole;
    FrameSettings& s = small.settings;
    const int longer = std::max(s.width, s.height);
    const int side = std::min(longer, std::clamp(longer / 4, kLeastSide, kMostSide));
    s.width = std::max(1, (s.width * side + longer / 2) / longer);
    s.height = std::max(1, (s.height * side + longer / 2) / longer);
    s.samples = 1;
    s.aovs.clear();
    s.falling = false;  // mirrors show none
    s.bloom = 0.0f;
    small.shutter.clear();
    small.lens.radius_m = 0.0f;
    return small;
}

shared::MirrorWindow mirror_window(const PictureAround& around, const Frame& whole, const glm::ivec2& corner_px)
{
    const glm::ivec2 picture(whole.settings.width, whole.settings.height), size(around.width, around.height);
    return {corner_px, picture, size, glm::vec2(size) / glm::vec2(picture)};
}

void add_keep_around(FrameGraph& graph, FrameTargets& targets, PictureAround& around, bool glows, const ConstantsRange& constants)
{
    graph.add(ComputePass{.name = "keep_around",
                          .shader = "keep_around.comp",
                          .constants = {{KEEP_AROUND_SPEC_GLOWS, glows}},
                          .bindings = {{KEEP_AROUND_FRAME, frame_binding(constants)},
                                       {KEEP_AROUND_DEPTH, texels(*targets.rows.depth)},
                                       {KEEP_AROUND_RADIANCE, sampled(*targets.radiance, targets.nearest)},
                                       {KEEP_AROUND_EMISSION, texels(*targets.rows.emission)},
                                       {KEEP_AROUND_TO_DEPTH, storage_buffer(*around.depth)},
                                       {KEEP_AROUND_TO_LIGHT, storage_buffer(*around.light)},
                                       {KEEP_AROUND_TO_GLOW, storage_buffer(*around.glow)}},
                          .push = {},
                          .groups = groups_over(targets.width, targets.height, KEEP_AROUND_TILE)});
}

}  // namespace petrichor::gpu
