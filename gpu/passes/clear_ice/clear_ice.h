#ifndef PETRICHOR_GPU_PASSES_CLEAR_ICE_CLEAR_ICE_H
#define PETRICHOR_GPU_PASSES_CLEAR_ICE_CLEAR_ICE_H

#include "gpu/frame/constants_range.h"
#include "gpu/frame/pixel_list.h"
#include "gpu/passes/reflections/reflections.h"

namespace petrichor::gpu {

// Adds what is seen through icicles: of the picture where a bent ray goes on in it, else of the probes around, else of the sky.
// They stay solid, in depth and in labels: what is behind them is looked up beside them, where no ice is.
//
//   model    of the icicles' material in the G-buffer
//   reads    depth, normals, material, sky_specular, probes
//   edits    radiance, accumulated; light_parts of frames that ask
//   scratch  ice_list, ice_groups, which make_ice_list() has made
void add_clear_ice(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky, const ProbeTable& probes, bool with_probes,
                   const ConstantsRange& constants, std::uint32_t model, bool gusts, const MirrorOutputs& outputs,
                   Pixels pixels);

}  // namespace petrichor::gpu

#endif
