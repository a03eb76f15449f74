// Interface of the visibility pass: which triangle is seen at each pixel.
#ifndef PETRICHOR_GPU_PASSES_VISIBILITY_VISIBILITY_IO_H
#define PETRICHOR_GPU_PASSES_VISIBILITY_VISIBILITY_IO_H

#include "base/interop.h"
#include "gpu/passes/surface_resolve/surface_resolve_io.h"  // the table of draws

// Set 0: the frame. Set 1 (draws with holes): the material, as gpu/upload/material_io.h has it.
#define VISIBILITY_FRAME 0
#define VISIBILITY_DRAWS 1
#define VISIBILITY_NUMBERS 2  // of triangles that were sorted out (gpu/upload/seen_triangles.h), with ID_STEEP of those that are

// 1: many instances, numbers of the table of draws; 0: one, as it is pushed
#define VISIBILITY_SPEC_INSTANCED 40
// 1: the triangles of the draw were sorted out, their numbers stand in the table
#define VISIBILITY_SPEC_LISTED 41

SHARED_BEGIN

// Push constants of one draw; of a run of instances, the first.
struct VisibilityDraw {
    vec4 to_world[3];  // rows of the affine transform
    uint draw;         // index into the scene's draws
    uint instance_id;
    uint fade;  // as DrawConstants has it
    uint first_number;  // where the table has the draw's first triangle
};

SHARED_END

#endif
