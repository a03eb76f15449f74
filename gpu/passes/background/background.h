#ifndef PETRICHOR_GPU_PASSES_BACKGROUND_BACKGROUND_H
#define PETRICHOR_GPU_PASSES_BACKGROUND_BACKGROUND_H

#include "gpu/passes/lighting/lighting.h"

namespace petrichor::gpu {

// The sky, or black, where no surface is, added to the sum. A pass of its own: in that of lighting a CPU would do it for
// every pixel.
//
//   reads    depth_rows, open_tiles, sky
//   writes   there: radiance with image-based light
//   edits    there: accumulated; light_parts of frames that ask
void add_background(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky, const ConstantsRange& constants,
                    const LightingVariant& variant);

}  // namespace petrichor::gpu

#endif
