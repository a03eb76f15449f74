// Interface of the pass that moves vertices by surfaces of users' own.
#ifndef PETRICHOR_GPU_PASSES_OWN_MOVES_OWN_MOVE_IO_H
#define PETRICHOR_GPU_PASSES_OWN_MOVES_OWN_MOVE_IO_H

#include "base/interop.h"
#include "gpu/passes/surface/surface_io.h"

#define OWN_MOVE_GROUP 64

// Behind those of all surfaces, of which only the frame's time, weather and look are filled here.
#define OWN_MOVE_VERTICES SURFACE_BINDINGS      // at rest, four texels each
#define OWN_MOVE_POINTS (SURFACE_BINDINGS + 1)  // of each vertex: normal of its place, own space; spacing, metres
#define OWN_MOVE_MOVED (SURFACE_BINDINGS + 2)

SHARED_BEGIN

struct OwnMoveParams {
    vec4 to_world[3];         // rows of the affine transform
    vec4 normal_to_world[3];  // rows; xyz used
    uint first;               // of its vertices
    uint count;
};

// In the world.
struct MovedVertex {
    vec3 by;  // metres from where it rests
    vec3 normal;
    vec3 tangent;
};

SHARED_END

#endif
