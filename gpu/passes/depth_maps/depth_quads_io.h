// Interface of the pass that packs depth maps of the sky.
#ifndef PETRICHOR_GPU_PASSES_DEPTH_MAPS_DEPTH_QUADS_IO_H
#define PETRICHOR_GPU_PASSES_DEPTH_MAPS_DEPTH_QUADS_IO_H

#include "base/interop.h"
#include "gpu/frame/frame_io.h"

#define DEPTH_QUADS_TILE 8  // divides SKY_MAP_SIZE
#define DEPTH_QUADS_MAPS 0
#define DEPTH_QUADS_QUADS 1

SHARED_BEGIN

struct DepthQuadsParams {
    int layer;
};

SHARED_END

#endif
