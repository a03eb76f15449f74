#ifndef PETRICHOR_GPU_FRAME_PIXEL_LIST_H
#define PETRICHOR_GPU_FRAME_PIXEL_LIST_H

#include "gpu/device/graph.h"
#include "gpu/frame/constants_range.h"
#include "gpu/frame/targets.h"

namespace petrichor::gpu {

/// Which pixels a pass shades.
enum class Pixels {
    All,
    AllForNow,  ///< with the text of those that go by a list: one pipeline serves both
    Listed,     ///< those that stand in the targets' list
};

/// Says in the targets' list that all pixels are meant, for AllForNow.
void add_all_pixels(FrameGraph& graph, FrameTargets& targets);

/// Adds a pass whose shader takes its pixel by gpu/frame/pixel_list.glsl. The targets' list is among
/// its bindings.
void add_over_pixels(FrameGraph& graph, FrameTargets& targets, ComputePass pass, Pixels pixels);

/// Empties a list of that kind, as part of the pass of that name.
void add_empty_list(FrameGraph& graph, const std::string& pass, GpuBuffer& list);
/// Works out the groups of a pass over it.
void add_list_groups(FrameGraph& graph, const std::string& pass, GpuBuffer& list, GpuBuffer& groups);
/// Adds a pass over the list that is among its bindings.
void add_over_list(FrameGraph& graph, ComputePass pass, GpuBuffer& groups);

/// Lists the tiles that show a surface and those that show none somewhere, by depth_rows.
void add_tile_lists(FrameGraph& graph, FrameTargets& targets, const ConstantsRange& constants);
/// Adds a pass over such tiles, or over the targets' list when it is Listed. pixels_of() is among its
/// bindings.
void add_over_tiles(FrameGraph& graph, FrameTargets& targets, ComputePass pass, const TileList& tiles,
                    Pixels pixels);
GpuBuffer& pixels_of(FrameTargets& targets, const TileList& tiles, Pixels pixels);

}  // namespace petrichor::gpu

#endif
