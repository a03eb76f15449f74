#include "gpu/passes/ambient_occlusion/ambient_occlusion.h"

#include <utility>

#include "formulas/light/occlusion_points.h"
#include "gpu/frame/occlusion_blocks_io.h"
#include "gpu/frame/pixel_list_io.h"
#include "gpu/passes/ambient_occlusion/ambient_occlusion_io.h"

namespace petrichor::gpu {

static_assert(OCCLUSION_TILE * OCCLUSION_BLOCK == PIXEL_LIST_TILE);
static_assert(OCCLUSION_LANES * OCCLUSION_ROWS == OCCLUSION_TILE * OCCLUSION_TILE);

namespace {

constexpr const char* kPass = "ambient_occlusion";

ComputePass pass_of(FrameTargets& targets, const ConstantsRange& constants, const char* shader, GpuBuffer& pixels, bool bent)
{
    return {.name = kPass,
            .shader = shader,
            .constants = {{AMBIENT_OCCLUSION_SPEC_BENT, bent}},
            .bindings = {{AMBIENT_OCCLUSION_FRAME, frame_binding(constants)},
                         {AMBIENT_OCCLUSION_DEPTH, texels(*targets.rows.depth)},
                         {AMBIENT_OCCLUSION_NORMALS, texels(*targets.rows.normals)},
                         {AMBIENT_OCCLUSION_PIXELS, texels(pixels)}},
            .push = {},
            .groups = {}};
}

void add_fill(FrameGraph& graph, const std::string& pass, GpuBuffer& buffer, std::uint32_t word)
{
    graph.add(TransferPass{.name = pass,
                           .transfers = {{nullptr, &buffer, Use::TransferTarget}},
                           .record = [&buffer, word](VkCommandBuffer commands) {
                               vkCmdFillBuffer(commands, buffer.buffer.get(), 0, VK_WHOLE_SIZE, word);
                           }});
}

void add_pixels(FrameGraph& graph, FrameTargets& targets, const ConstantsRange& constants, GpuBuffer& list,
                GpuBuffer& groups, bool bent)
{
    ComputePass pass = pass_of(targets, constants, "ambient_occlusion.comp", list, bent);
    pass.bindings.push_back({AMBIENT_OCCLUSION_TARGET, storage_buffer(*targets.occlusion)});
    add_over_list(graph, std::move(pass), groups);
}

}  // namespace

void add_no_occlusion(FrameGraph& graph, FrameTargets& targets, const std::string& pass)
{
    add_fill(graph, pass, *targets.occlusion, 0xffffffffu);
}

void add_ambient_occlusion(FrameGraph& graph, FrameTargets& targets,
                           const ConstantsRange& constants, Pixels pixels, bool bent)
{
    if (pixels == Pixels::Listed) {
        add_fill(graph, kPass, *targets.occlusion, 0);
        add_pixels(graph, targets, constants, *targets.pixel_list, *targets.pixel_groups, bent);
        return;
    }
    // Tiles beside those with a surface have none.
    add_fill(graph, kPass, *targets.occlusion_points, shared::kNoOcclusionPoint);
    // Lighting lists its mirrors there later.
    GpuBuffer& alone = *targets.mirror_list;
    add_empty_list(graph, kPass, alone);
    const TileList& tiles = targets.surface_tiles;
    ComputePass points = pass_of(targets, constants, "occlusion_points.comp", *tiles.tiles, bent);
    points.bindings.push_back({OCCLUSION_POINTS_TARGET, storage_buffer(*targets.occlusion_points)});
    points.bindings.push_back({OCCLUSION_POINTS_ALONE, storage_buffer(alone)});
    add_over_list(graph, std::move(points), *tiles.groups);
    add_over_list(graph,
                  ComputePass{.name = kPass,
                              .shader = "spread_occlusion.comp",
                              .constants = {{AMBIENT_OCCLUSION_SPEC_BENT, bent}},
                              .bindings = {{SPREAD_OCCLUSION_FRAME, frame_binding(constants)},
                                           {SPREAD_OCCLUSION_TILES, texels(*tiles.tiles)},
                                           {SPREAD_OCCLUSION_POINTS, texels(*targets.occlusion_points)},
                                           {SPREAD_OCCLUSION_TARGET, storage_buffer(*targets.occlusion)}},
                              .push = {},
                              .groups = {}},
                  *tiles.groups);
    add_list_groups(graph, kPass, alone, *targets.mirror_groups);
    add_pixels(graph, targets, constants, alone, *targets.mirror_groups, bent);
}

}  // namespace petrichor::gpu
