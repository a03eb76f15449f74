// Interface of the visibility pass: which triangle is seen at each pixel.
#ifndef PETRICHOR_GPU_PASSES_VISIBILITY_VISIBILITY_IO_H
#define PETRICHOR_GPU_PASSES_VISIBILITY_VISIBILITY_IO_H

#include "base/interop.h"

// Set 0: the frame. Set 1 (draws with holes): the material, as gpu/upload/material_io.h has it.
#define VISIBILITY_FRAME 0

SHARED_BEGIN

// Push constants of one draw.
struct VisibilityDraw {
    vec4 to_world[3];  // rows of the affine transform
    uint draw;         // index into the scene's draws
    uint instance_id;
    uint fade;  // as DrawConstants has it
};

SHARED_END

#endif
