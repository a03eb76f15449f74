#include "gpu/passes/surface_maps/surface_maps.h"

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "gpu/passes/surface_maps/surface_maps_io.h"

namespace petrichor::gpu {

namespace {

constexpr int kSnowSize = 512;
constexpr int kFlowSize = 256;

std::unique_ptr<GpuImage> map(MemoryArena& arena, const char* name, int size, int mips)
{
    return arena.image({.name = name,
                        .width = size,
                        .height = size,
                        .mips = mips,
                        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                 VK_IMAGE_USAGE_TRANSFER_DST_BIT});
}

int size_of(const WeatherMap& given, int own)
{
    return given.size != 0 ? given.size : own;
}

int mips_of(int size)
{
    return std::bit_width(static_cast<unsigned>(size));
}

// Not by blits: how those round is the driver's, and what lavapipe loses at each level makes snow brighter.
void add_mips(FrameGraph& graph, const char* name, GpuImage& image, const char* shader = "map_mip.comp")
{
    for (int mip = 1; mip < image.mips; ++mip) {
        const int side = image.width >> mip;
        graph.add(ComputePass{.name = name,
                              .shader = shader,
                              .constants = {},
                              .bindings = {{MAP_MIP_FROM, storage(image, mip - 1)}, {MAP_MIP_TO, storage(image, mip)}},
                              .push = {},
                              .groups = groups_over(side, side, SURFACE_MAPS_TILE)});
    }
}

std::unique_ptr<GpuBuffer> quads_of(MemoryArena& arena, const char* name, const GpuImage& image)
{
    const auto size = static_cast<VkDeviceSize>(image.width);
    return arena.buffer({.name = name,
                         .size = 2 * size * size * 8,
                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                         .texel_format = VK_FORMAT_R32G32_UINT});
}

void add_quads(FrameGraph& graph, const char* name, GpuImage& image, GpuBuffer& quads, const SamplerHandle& sampler)
{
    graph.add(ComputePass{.name = name,
                          .shader = "map_quads.comp",
                          .constants = {},
                          .bindings = {{MAP_QUADS_MAP, sampled(image, sampler)},
                                       {MAP_QUADS_QUADS, storage_buffer(quads)}},
                          .push = PushBlock(shared::MapQuadsParams{image.width, mips_of(image.width)}),
                          .groups = groups_over(image.width + std::max(image.width / 2, 1), image.width,
                                                SURFACE_MAPS_TILE)});
}

// Texels of snow that nothing has pressed.
std::vector<std::byte> untouched(std::size_t count)
{
    std::vector<std::byte> texels;
    for (std::size_t i = 0; i < count; ++i) {
        for (const int code : {0, 128, 128, 255}) texels.push_back(static_cast<std::byte>(code));
    }
    return texels;
}

// Mean of every four texels; width and height are even.
std::vector<std::byte> halved(const std::vector<std::byte>& texels, int width, int height)
{
    std::vector<std::byte> half;
    half.reserve(texels.size() / 4);
    const auto row = static_cast<std::size_t>(width) * 4;
    for (int y = 0; y + 1 < height; y += 2) {
        for (int x = 0; x + 1 < width; x += 2) {
            const std::size_t at =
                static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x) * 4;
            for (std::size_t c = at; c < at + 4; ++c) {
                int sum = 2;
                for (const std::size_t i : {c, c + 4, c + row, c + row + 4})
                    sum += static_cast<int>(texels[i]);
                half.push_back(static_cast<std::byte>(sum / 4));
            }
        }
    }
    return half;
}

std::vector<std::vector<std::byte>> track_levels(const TrackMap& map)
{
    if (map.width == 0) return {untouched(1)};
    std::vector<std::vector<std::byte>> levels{map.rgba};
    int width = map.width;
    int height = map.height;
    while (levels.size() < 6) {
        levels.push_back(halved(levels.back(), width, height));
        width /= 2;
        height /= 2;
    }
    return levels;
}

}  // namespace

SurfaceMaps::SurfaceMaps(const Device& device, MemoryArena& arena, int size,
                         const WeatherMaps& given)
    : ripple_source(map(arena, "ripple_source", size_of(given.drops, size), 1)),
      ripple(map(arena, "ripple", size_of(given.drops, size), mips_of(size_of(given.drops, size)))),
      flow(map(arena, "flow", size_of(given.water, kFlowSize),
               mips_of(size_of(given.water, kFlowSize)))),
      snow(map(arena, "snow", size_of(given.snow, kSnowSize),
               mips_of(size_of(given.snow, kSnowSize)))),
      flow_quads(quads_of(arena, "flow_quads", *flow)),
      ripple_size(size_of(given.drops, size)),
      drops_given(given.drops.size != 0),
      snow_given(given.snow.size != 0),
      water_given(given.water.size != 0),
      trilinear(make_sampler(device, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                             VK_SAMPLER_ADDRESS_MODE_REPEAT, false, 0.0f, false, device.texture_anisotropy()))
{
    make_tracks(device, arena, given.tracks);
    if (drops_given) upload_image(device, *ripple_source, {given.drops.rgba});
    if (snow_given) upload_image(device, *snow, {given.snow.rgba});
    if (water_given) upload_image(device, *flow, {given.water.rgba});
}

void SurfaceMaps::set_tracks(const Device& device, const TrackMap& given)
{
    if (given.width != track_area.width || given.height != track_area.height || given.width == 0)
        throw Error("tracks: a map of another size than that of the whole film", "Draw all of them over one area.");
    upload_image(device, *tracks, track_levels(given));
}

void SurfaceMaps::make_tracks(const Device& device, MemoryArena& arena, const TrackMap& given)
{
    clamped = make_sampler(device, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                           VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    track_area = given;
    track_area.rgba.clear();
    const auto levels = track_levels(given);
    tracks = arena.image({.name = "tracks",
                          .width = std::max(given.width, 1),
                          .height = std::max(given.height, 1),
                          .mips = static_cast<int>(levels.size()),
                          .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    upload_image(device, *tracks, levels);
}

void add_surface_map_sources(FrameGraph& graph, SurfaceMaps& maps)
{
    if (!maps.drops_given) {
        graph.add(ComputePass{
            .name = "ripple_source",
            .shader = "ripple_source.comp",
            .constants = {},
            .bindings = {{SURFACE_MAPS_ALONE_TARGET, storage(*maps.ripple_source)}},
            .push = {},
            .groups = groups_over(maps.ripple_size, maps.ripple_size, SURFACE_MAPS_TILE)});
    }
    if (!maps.snow_given) {
        graph.add(ComputePass{.name = "snow_mask",
                              .shader = "snow_mask.comp",
                              .constants = {},
                              .bindings = {{SURFACE_MAPS_ALONE_TARGET, storage(*maps.snow, 0)}},
                              .push = {},
                              .groups = groups_over(kSnowSize, kSnowSize, SURFACE_MAPS_TILE)});
    }
    add_mips(graph, "snow_mask_mips", *maps.snow);
    if (!maps.water_given) return;
    add_mips(graph, "flow_mips", *maps.flow);
    add_quads(graph, "flow_mips", *maps.flow, *maps.flow_quads, maps.trilinear);
}

void add_ripple(FrameGraph& graph, SurfaceMaps& maps, float rain, float time_s, float speed, float drop_spread)
{
    graph.add(
        ComputePass{.name = "ripple",
                    .shader = "ripple.comp",
                    .constants = {},
                    .bindings = {{RIPPLE_SOURCE, sampled(*maps.ripple_source, maps.trilinear)},
                                 {RIPPLE_TARGET, storage(*maps.ripple, 0)}},
                    .push = PushBlock(shared::RippleParams{rain, time_s, speed, drop_spread}),
                    .groups = groups_over(maps.ripple_size, maps.ripple_size, SURFACE_MAPS_TILE)});
    add_mips(graph, "ripple_mips", *maps.ripple, "ripple_mip.comp");
}

void add_flow(FrameGraph& graph, SurfaceMaps& maps, float time_s)
{
    if (maps.water_given) return;
    graph.add(ComputePass{.name = "flow",
                          .shader = "flow.comp",
                          .constants = {},
                          .bindings = {{SURFACE_MAPS_ALONE_TARGET, storage(*maps.flow, 0)}},
                          .push = PushBlock(shared::FlowParams{time_s, 0.5f}),
                          .groups = groups_over(kFlowSize, kFlowSize, SURFACE_MAPS_TILE)});
    add_mips(graph, "flow_mips", *maps.flow);
    add_quads(graph, "flow_mips", *maps.flow, *maps.flow_quads, maps.trilinear);
}

}  // namespace petrichor::gpu
