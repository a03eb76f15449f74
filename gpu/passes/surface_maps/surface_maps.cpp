#include "gpu/passes/surface_maps/surface_maps.h"

namespace petrichor::gpu {

namespace {

constexpr int kRippleSize = 512;
constexpr int kRippleMips = 10;
constexpr int kFlowSize = 256;
constexpr int kFlowMips = 9;
constexpr int kTile = 8;

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

void add_mips(FrameGraph& graph, const char* name, GpuImage& image)
{
    graph.add({.name = name,
               .uses = {{image, Use::TransferTarget}},
               .record = [&image](PassContext& pass) { record_mips(pass.commands(), image); }});
}

struct RippleParams {
    float rain, time_s, speed;
};
struct FlowParams {
    float time_s, tile_m;
};

}  // namespace

SurfaceMaps::SurfaceMaps(const Device& device, MemoryArena& arena)
    : ripple_source(map(arena, "ripple_source", kRippleSize, 1)),
      ripple(map(arena, "ripple", kRippleSize, kRippleMips)),
      flow(map(arena, "flow", kFlowSize, kFlowMips)),
      snow(map(arena, "snow", kRippleSize, kRippleMips)),
      trilinear(make_sampler(device, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                             VK_SAMPLER_ADDRESS_MODE_REPEAT))
{
}

void add_surface_map_sources(FrameGraph& graph, SurfaceMaps& maps)
{
    graph.add({.name = "ripple_source",
               .uses = {{maps.ripple_source, Use::StorageWrite}},
               .record = [&maps](PassContext& pass) {
                   pass.bind_compute("ripple_source.comp", {}, {storage(*maps.ripple_source)});
                   pass.dispatch_over(kRippleSize, kRippleSize, kTile);
               }});
    graph.add({.name = "snow_mask",
               .uses = {{maps.snow, Use::StorageWrite}},
               .record = [&maps](PassContext& pass) {
                   pass.bind_compute("snow_mask.comp", {}, {storage(*maps.snow, 0)});
                   pass.dispatch_over(kRippleSize, kRippleSize, kTile);
               }});
    add_mips(graph, "snow_mask_mips", *maps.snow);
}

void add_ripple(FrameGraph& graph, SurfaceMaps& maps, float rain, float time_s, float speed)
{
    graph.add({.name = "ripple",
               .uses = {{maps.ripple_source, Use::Sampled}, {maps.ripple, Use::StorageWrite}},
               .record = [&maps, rain, time_s, speed](PassContext& pass) {
                   pass.bind_compute(
                       "ripple.comp", {},
                       {sampled(*maps.ripple_source, maps.trilinear), storage(*maps.ripple, 0)});
                   pass.push(RippleParams{rain, time_s, speed});
                   pass.dispatch_over(kRippleSize, kRippleSize, kTile);
               }});
    add_mips(graph, "ripple_mips", *maps.ripple);
}

void add_flow(FrameGraph& graph, SurfaceMaps& maps, float time_s)
{
    graph.add({.name = "flow",
               .uses = {{maps.flow, Use::StorageWrite}},
               .record = [&maps, time_s](PassContext& pass) {
                   pass.bind_compute("flow.comp", {}, {storage(*maps.flow, 0)});
                   pass.push(FlowParams{time_s, 0.5f});
                   pass.dispatch_over(kFlowSize, kFlowSize, kTile);
               }});
    add_mips(graph, "flow_mips", *maps.flow);
}

}  // namespace petrichor::gpu
