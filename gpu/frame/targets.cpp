#include "gpu/frame/targets.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "gpu/frame/frame_io.h"
#include "gpu/frame/occlusion_blocks_io.h"
#include "gpu/frame/patch_points_io.h"
#include "gpu/frame/pixel_list_io.h"

namespace petrichor::gpu {

namespace {

// Locations count from 0 in the order of the rows; devices offer eight at least.
constexpr int kLocations[] = {
#define ROW(name, location, format, when, meaning) location,
    GBUFFER_TABLE(ROW)
#undef ROW
};
constexpr bool locations_count_up()
{
    for (int i = 0; i < static_cast<int>(std::size(kLocations)); ++i) {
        if (kLocations[i] != i) return false;
    }
    return true;
}
static_assert(locations_count_up() && std::size(kLocations) <= 8);
static_assert(std::size(kLocations) + 1 == GBUFFER_BINDINGS);

constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

VkDeviceSize texel_bytes(VkFormat format)
{
    switch (format) {
        case VK_FORMAT_R16G16B16A16_SNORM:
        case VK_FORMAT_R16G16B16A16_UNORM:
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case VK_FORMAT_R32G32_UINT:
            return 8;
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return 16;
        default:
            return 4;
    }
}

std::pair<std::unique_ptr<GpuImage>, std::unique_ptr<GpuBuffer>> parted(ImageInRows both)
{
    return {std::move(both.image), std::move(both.rows)};
}

int divide_up(int value, int by)
{
    return (value + by - 1) / by;
}

}  // namespace

int FrameTargets::tiles_x() const
{
    return divide_up(width, LIGHT_TILE);
}
int FrameTargets::tiles_y() const
{
    return divide_up(height, LIGHT_TILE);
}
int FrameTargets::coarse_x() const
{
    return divide_up(tiles_x(), LIGHT_COARSE);
}
int FrameTargets::coarse_y() const
{
    return divide_up(tiles_y(), LIGHT_COARSE);
}

GBufferParts gbuffer_parts(const GpuScene& scene, bool weather)
{
    return {weather, scene.emissive() || scene.baked(), scene.baked()};
}

std::vector<Attachment> gbuffer_attachments(GBuffer& gbuffer, const GBufferParts& parts)
{
    [[maybe_unused]] const bool ALWAYS = true;
    const bool WEATHER = parts.weather;
    const bool EMISSION = parts.emission;
    const bool BAKED = parts.baked;
    std::vector<Attachment> attachments;
#define ROW(name, location, format, when, meaning) \
    attachments.push_back(when ? Attachment(*gbuffer.name) : Attachment());
    GBUFFER_TABLE(ROW)
#undef ROW
    return attachments;
}

void bind_gbuffer(Bindings& bindings, std::uint32_t first, FrameTargets& targets)
{
    GBufferRows& rows = targets.rows;
    bindings.push_back({first, texels(*rows.depth)});
#define ROW(name, location, format, when, meaning) \
    bindings.push_back({first + 1 + location, texels(&rows.name == &rows.weather ? targets.weather_rows() : *rows.name)});
    GBUFFER_TABLE(ROW)
#undef ROW
}

void add_gbuffer_rows(FrameGraph& graph, FrameTargets& targets, const GBufferParts& parts)
{
    [[maybe_unused]] const bool ALWAYS = true;
    const bool WEATHER = parts.weather && !targets.wet_alone;
    const bool EMISSION = parts.emission;
    const bool BAKED = parts.baked;
    std::vector<std::pair<GpuImage*, GpuBuffer*>> copies{
        {targets.gbuffer.depth.get(), targets.rows.depth.get()}};
#define ROW(name, location, format, when, meaning) \
    if (when) copies.emplace_back(targets.gbuffer.name.get(), targets.rows.name.get());
    GBUFFER_TABLE(ROW)
#undef ROW
    if (targets.wet_alone) copies.emplace_back(targets.wet.get(), targets.wet_rows.get());
    add_rows(graph, "gbuffer_rows", copies);
}

VkDeviceSize light_lists_bytes(int width, int height, int light_words)
{
    const auto tiles = static_cast<VkDeviceSize>(divide_up(width, LIGHT_TILE)) *
                       static_cast<VkDeviceSize>(divide_up(height, LIGHT_TILE));
    return tiles * (static_cast<VkDeviceSize>(light_words) + 1) * sizeof(glm::uvec2);
}

namespace {

std::unique_ptr<GpuBuffer> list_of(MemoryArena& arena, const char* name, VkDeviceSize entries)
{
    return arena.buffer({.name = name,
                         .size = (entries + 1) * 4,
                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         .texel_format = VK_FORMAT_R32_UINT});
}

std::unique_ptr<GpuBuffer> groups_of(MemoryArena& arena, const char* name)
{
    return arena.buffer(
        {.name = name,
         .size = sizeof(VkDispatchIndirectCommand),
         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
}

}  // namespace

void make_ice_list(FrameTargets& targets, MemoryArena& arena)
{
    if (targets.ice_list) return;
    targets.ice_list = list_of(arena, "ice_list", static_cast<VkDeviceSize>(targets.width) * static_cast<VkDeviceSize>(targets.height));
    targets.ice_groups = groups_of(arena, "ice_groups");
}

void make_occlusion(FrameTargets& targets, MemoryArena& arena, bool bent)
{
    const auto blocks = [&](const char* name, VkDeviceSize words) {
        return arena.buffer({.name = name,
                             .size = static_cast<VkDeviceSize>(divide_up(targets.width, OCCLUSION_BLOCK)) *
                                     static_cast<VkDeviceSize>(divide_up(targets.height, OCCLUSION_BLOCK)) * words * 4,
                             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                             .texel_format = VK_FORMAT_R32_UINT});
    };
    targets.keeps_bent = bent;
    targets.occlusion = blocks("screen_occlusion", bent ? 3 : 1);
    targets.occlusion_points = blocks("occlusion_points", bent ? 3 : 2);
}

FrameTargets make_frame_targets(const Device& device, MemoryArena& arena, int width, int height,
                                int light_words)
{
    FrameTargets targets;
    targets.width = width;
    targets.height = height;
    targets.filters = device.filters_floats();
    targets.lanes = device.info().kind == "cpu" ? device.subgroup_size() : 0;
    targets.between = make_sampler(device, targets.filters ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
                                   VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false, 0.0f, true);
    targets.nearest = make_sampler(device, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false, 0.0f, true);
    const auto desc = [&](const char* name, VkFormat format, VkImageUsageFlags usage) {
        return ImageDesc{.name = name,
                         .format = format,
                         .width = width,
                         .height = height,
                         .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT};
    };
    const auto target = [&](const char* name, VkFormat format, VkImageUsageFlags usage) {
        return arena.image(desc(name, format, usage));
    };
    const auto in_rows = [&](const char* name, VkFormat format, VkImageUsageFlags usage, bool host = false) {
        return arena.image_in_rows(desc(name, format, usage), texel_bytes(format), host);
    };
    // Drawn into, or written by the resolve of a visibility buffer.
    const VkImageUsageFlags color = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    const VkImageUsageFlags storage = VK_IMAGE_USAGE_STORAGE_BIT;
    std::tie(targets.gbuffer.depth, targets.rows.depth) =
        parted(in_rows("depth", kDepthFormat,
                       VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT));
#define ROW(name, location, format, when, meaning) \
    std::tie(targets.gbuffer.name, targets.rows.name) = parted(in_rows(#name, VK_FORMAT_##format, color));
    GBUFFER_TABLE(ROW)
#undef ROW
    std::tie(targets.wet, targets.wet_rows) = parted(in_rows("wet", VK_FORMAT_R8G8B8A8_UNORM, color));
    targets.radiance = target("radiance", VK_FORMAT_R16G16B16A16_SFLOAT, storage);
    targets.mirror_weight = target("mirror_weight", VK_FORMAT_R16G16B16A16_SFLOAT,
                                   storage | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    targets.mirror_shape = target("mirror_shape", VK_FORMAT_R16G16B16A16_SNORM, storage);
    if (targets.lanes == 0) {
        targets.accumulated = target("accumulated", VK_FORMAT_R32G32B32A32_SFLOAT, color);
    } else {
        std::tie(targets.accumulated, targets.accumulated_rows) = parted(in_rows("accumulated", VK_FORMAT_R32G32B32A32_SFLOAT, color));
    }

    const int block = GLOW_BLOCK;
    targets.lamp_glow = arena.image({.name = "lamp_glow",
                                     .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                     .width = divide_up(width, block),
                                     .height = divide_up(height, block),
                                     .usage = storage | VK_IMAGE_USAGE_SAMPLED_BIT});
    for (int w = width, h = height; targets.glare.empty() || std::min(w, h) > 4;) {
        w = divide_up(w, 2);
        h = divide_up(h, 2);
        targets.glare.push_back(arena.image({.name = "glare",
                                             .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                             .width = w,
                                             .height = h,
                                             .usage = storage | VK_IMAGE_USAGE_SAMPLED_BIT}));
    }

    const auto pixels = static_cast<VkDeviceSize>(width) * static_cast<VkDeviceSize>(height);
    const auto coarse = static_cast<VkDeviceSize>(targets.coarse_x() * targets.coarse_y());
    const VkBufferUsageFlags table =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    targets.coarse_lights =
        arena.buffer({.name = "coarse_lights",
                      .size = coarse * static_cast<VkDeviceSize>(std::max(light_words, 1)) * 4,
                      .usage = table,
                      .texel_format = VK_FORMAT_R32_UINT});
    targets.light_lists = arena.buffer({.name = "light_lists",
                                        .size = light_lists_bytes(width, height, light_words),
                                        .usage = table,
                                        .texel_format = VK_FORMAT_R32G32_UINT});
    const auto list = [&](const char* name, VkDeviceSize entries) { return list_of(arena, name, entries); };
    const auto groups = [&](const char* name) { return groups_of(arena, name); };
    const VkDeviceSize tiles = static_cast<VkDeviceSize>(divide_up(width, PIXEL_LIST_TILE)) *
                               static_cast<VkDeviceSize>(divide_up(height, PIXEL_LIST_TILE));
    make_occlusion(targets, arena, false);
    targets.pixel_list = list("pixel_list", pixels);
    targets.pixel_groups = groups("pixel_groups");
    targets.mirror_list = list("mirror_list", pixels);
    targets.mirror_groups = groups("mirror_groups");
    targets.surface_tiles = {list("surface_tiles", tiles), groups("surface_groups")};
    targets.open_tiles = {list("open_tiles", tiles), groups("open_groups")};
    targets.patch_points =
        arena.buffer({.name = "patch_points",
                      .size = static_cast<VkDeviceSize>(divide_up(width, PATCH_BLOCK)) *
                              static_cast<VkDeviceSize>(divide_up(height, PATCH_BLOCK)) *
                              PATCH_POINTS * PATCH_POINT_TEXELS * 16,
                      .usage = table,
                      .texel_format = VK_FORMAT_R32G32B32A32_UINT});
    if (targets.lanes == 0) {
        targets.beauty = arena.buffer({.name = "beauty", .size = pixels * 8, .host = true});
        targets.display = arena.buffer({.name = "display", .size = pixels * 4, .host = true});
    } else {
        const VkImageUsageFlags drawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        std::tie(targets.beauty_drawn, targets.beauty) = parted(in_rows("beauty", VK_FORMAT_R32G32_UINT, drawn, true));
        std::tie(targets.display_drawn, targets.display) = parted(in_rows("display", VK_FORMAT_R32_UINT, drawn, true));
    }
    return targets;
}

}  // namespace petrichor::gpu
