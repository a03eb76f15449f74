// Interface of the glare passes.
#ifndef PETRICHOR_GPU_PASSES_GLARE_GLARE_IO_H
#define PETRICHOR_GPU_PASSES_GLARE_GLARE_IO_H

#include "base/interop.h"

#define GLARE_TILE 8
#define GLARE_SPEC_FILTERS 0  // 1: the device filters floats of 32 bits

// glare_down: each level from the one above it; the first from the sum of the samples
#define GLARE_SOURCE 0
#define GLARE_TARGET 1
// glare_up: adds the level below to a level, in place
#define GLARE_WIDER 0
#define GLARE_LEVEL 1

SHARED_BEGIN

struct GlareParams {
    float scale;  // glare_down: of what is read; glare_up: share of the wider level
};

SHARED_END

#endif
