#include "gpu/frame/pixel_list.h"

#include <utility>

#include "gpu/frame/pixel_list_io.h"

namespace petrichor::gpu {

void add_all_pixels(FrameGraph& graph, FrameTargets& targets)
{
    GpuBuffer& list = *targets.pixel_list;
    graph.add(TransferPass{.name = "adaptive",
                           .transfers = {{nullptr, &list, Use::TransferTarget}},
                           .record = [&list](VkCommandBuffer commands) {
                               vkCmdFillBuffer(commands, list.buffer.get(), 0, 4, PIXEL_LIST_ALL);
                           }});
}

void add_over_pixels(FrameGraph& graph, FrameTargets& targets, ComputePass pass, Pixels pixels)
{
    if (pixels == Pixels::Listed) {
        add_over_list(graph, std::move(pass), *targets.pixel_groups);
        return;
    }
    pass.constants.push_back({PIXEL_LIST_SPEC, pixels != Pixels::All});
    pass.groups = groups_over(targets.width, targets.height, 8);
    graph.add(std::move(pass));
}

void add_empty_list(FrameGraph& graph, const std::string& pass, GpuBuffer& list)
{
    graph.add(TransferPass{.name = pass,
                           .transfers = {{nullptr, &list, Use::TransferTarget}},
                           .record = [&list](VkCommandBuffer commands) {
                               vkCmdFillBuffer(commands, list.buffer.get(), 0, 4, 0);
                           }});
}

void add_list_groups(FrameGraph& graph, const std::string& pass, GpuBuffer& list, GpuBuffer& groups)
{
    graph.add(ComputePass{.name = pass,
                          .shader = "list_groups.comp",
                          .constants = {},
                          .bindings = {{LIST_GROUPS_LIST, storage_buffer(list)},
                                       {LIST_GROUPS_GROUPS, storage_buffer(groups)}},
                          .push = {},
                          .groups = {}});
}

namespace {

void add_indirect(FrameGraph& graph, ComputePass pass, GpuBuffer& groups)
{
    DispatchListPass list{.name = std::move(pass.name),
                          .bindings = std::move(pass.bindings),
                          .arguments = &groups,
                          .pipelines = {},
                          .record = {}};
    list.pipelines.push_back({pass.shader, pass.constants, {types_of(list.bindings)}});
    list.record = [shader = std::move(pass.shader), constants = std::move(pass.constants),
                   push = pass.push](DispatchContext& context) {
        context.bind(shader, constants);
        context.push(push);
        context.dispatch_indirect(0);
    };
    graph.add(std::move(list));
}

}  // namespace

void add_over_list(FrameGraph& graph, ComputePass pass, GpuBuffer& groups)
{
    pass.constants.push_back({PIXEL_LIST_SPEC, 1});
    add_indirect(graph, std::move(pass), groups);
}

void add_tile_lists(FrameGraph& graph, FrameTargets& targets, const ConstantsRange& constants)
{
    const TileList& surfaces = targets.surface_tiles;
    const TileList& open = targets.open_tiles;
    TransferPass empty{.name = "tile_lists", .transfers = {}, .record = {}};
    for (const TileList* list : {&surfaces, &open}) {
        empty.transfers.push_back({nullptr, list->tiles.get(), Use::TransferTarget});
        empty.transfers.push_back({nullptr, list->groups.get(), Use::TransferTarget});
    }
    empty.record = [&surfaces, &open](VkCommandBuffer commands) {
        for (const TileList* list : {&surfaces, &open}) {
            vkCmdFillBuffer(commands, list->tiles->buffer.get(), 0, 4, PIXEL_LIST_TILES);
            vkCmdFillBuffer(commands, list->groups->buffer.get(), 0, 4, 0);
            vkCmdFillBuffer(commands, list->groups->buffer.get(), 4, 8, 1);
        }
    };
    graph.add(std::move(empty));
    const Groups tiles = groups_over(targets.width, targets.height, PIXEL_LIST_TILE);
    graph.add(ComputePass{.name = "tile_lists",
                          .shader = "tile_lists.comp",
                          .constants = {},
                          .bindings = {{TILE_LISTS_FRAME, frame_binding(constants)},
                                       {TILE_LISTS_DEPTH_ROWS, texels(*targets.rows.depth)},
                                       {TILE_LISTS_SURFACES, storage_buffer(*surfaces.tiles)},
                                       {TILE_LISTS_SURFACE_GROUPS, storage_buffer(*surfaces.groups)},
                                       {TILE_LISTS_OPEN, storage_buffer(*open.tiles)},
                                       {TILE_LISTS_OPEN_GROUPS, storage_buffer(*open.groups)}},
                          .push = {},
                          .groups = {(tiles.x * tiles.y + TILE_LISTS_GROUP - 1) / TILE_LISTS_GROUP}});
}

void add_over_tiles(FrameGraph& graph, FrameTargets& targets, ComputePass pass, const TileList& tiles,
                    Pixels pixels)
{
    // Frames some of whose samples go by the list of pixels have one pipeline for both.
    pass.constants.push_back({PIXEL_LIST_SPEC, pixels == Pixels::All ? 2u : 1u});
    add_indirect(graph, std::move(pass), pixels == Pixels::Listed ? *targets.pixel_groups : *tiles.groups);
}

GpuBuffer& pixels_of(FrameTargets& targets, const TileList& tiles, Pixels pixels)
{
    return pixels == Pixels::Listed ? *targets.pixel_list : *tiles.tiles;
}

}  // namespace petrichor::gpu
