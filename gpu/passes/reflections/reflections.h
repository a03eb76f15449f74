#ifndef PETRICHOR_GPU_PASSES_REFLECTIONS_REFLECTIONS_H
#define PETRICHOR_GPU_PASSES_REFLECTIONS_REFLECTIONS_H

#include "gpu/frame/constants_range.h"
#include "gpu/frame/pixel_list.h"
#include "gpu/passes/reflections/picture_around.h"
#include "gpu/passes/reflections/probe_table.h"
#include "gpu/passes/sky/sky.h"

namespace petrichor::gpu {

/// What the pass writes besides the sum, and what it looks at.
struct MirrorOutputs {
    GpuImage* parts = nullptr;  ///< never null in a pass (gpu/outputs/light_parts.h)
    bool split = false;         ///< what is mirrored, into its layer
    GpuImage* labels = nullptr;  ///< the same, of all samples
    bool label = false;         ///< what that is of
    bool picture = true;        ///< the picture itself is mirrored
    bool glows = false;         ///< surfaces that glow are lights, too
    PictureAround* around = nullptr;  ///< of the picture that this is a window of; null: it ends where it ends
    shared::MirrorWindow window = {};
    FrameTargets* solid = nullptr;  ///< of the picture that a layer of what lets light through mirrors; null: its own
};

// For a pass that labels pixels which mirror nothing, too: the lighting tells the others alone.
//
//   writes   mirror_weight
void clear_mirrors(FrameGraph& graph, FrameTargets& targets);

// Adds what smooth surfaces mirror of the picture itself, else of the probes around, else of the sky.
//
//   reads    depth, radiance (of `solid` where that is told), mirror_weight, mirror_shape, mirror_list, sky_specular, probes
//   edits    accumulated; light_parts of frames that ask
void add_reflections(FrameGraph& graph, FrameTargets& targets, SkyMaps& sky,
                     const ProbeTable& probes, bool with_probes, const ConstantsRange& constants,
                     const MirrorOutputs& outputs, Pixels pixels = Pixels::All);

}  // namespace petrichor::gpu

#endif
