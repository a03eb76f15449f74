#ifndef PETRICHOR_GPU_PASSES_REFLECTIONS_PICTURE_AROUND_H
#define PETRICHOR_GPU_PASSES_REFLECTIONS_PICTURE_AROUND_H

#include <memory>

#include "gpu/frame/constants_range.h"
#include "gpu/frame/frame.h"
#include "gpu/frame/targets.h"
#include "gpu/passes/reflections/reflections_io.h"

namespace petrichor::gpu {

/// A small picture of a large one that is rendered in windows: what mirrors in a window see beyond it. 20 bytes a pixel.
struct PictureAround {
    PictureAround(const Device& device, int width, int height);

    int width, height;
    MemoryArena arena;
    std::unique_ptr<GpuBuffer> depth, light, glow;  ///< row by row
};

/// The frame that is rendered for it: one sample of what stands there. Of pictures up to 1024 pixels a side as large as they,
/// of larger ones a quarter of their side within 1024 to 2048.
Frame around_frame(const Frame& whole);

/// Where a window of a picture lies.
shared::MirrorWindow mirror_window(const PictureAround& around, const Frame& whole, const glm::ivec2& corner_px);

// Keeps what a sample has seen before its mirrors.
//
//   reads    depth, radiance; emission where there is some
//   writes   depth, light and glow of `around`
void add_keep_around(FrameGraph& graph, FrameTargets& targets, PictureAround& around, bool glows, const ConstantsRange& constants);

}  // namespace petrichor::gpu

#endif
