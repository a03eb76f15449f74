// Interface of the draws that fill depth maps.
#ifndef PETRICHOR_GPU_PASSES_DEPTH_MAPS_DEPTH_MAPS_IO_H
#define PETRICHOR_GPU_PASSES_DEPTH_MAPS_DEPTH_MAPS_IO_H

#include "base/interop.h"

// 1: casters before the near plane are kept, flattened onto it; 0: they cast nothing
#define DEPTH_SPEC_FLATTEN 0
#define DEPTH_SPEC_PARALLAX 1  // PARALLAX_... of the material, where its holes lie in a relief

SHARED_BEGIN

// Push constants of a draw with such holes.
struct ReliefDraw {
    mat4 clip_from_object;
    vec4 to_world[3];  // rows
    vec4 eye;          // of the map, in the world; w 0: all of it looks from this direction
};

// .. of many instances at once, whose places stand in a table.
struct ReliefRun {
    vec4 eye;    // as above
    uint count;  // of them
};

SHARED_END

#endif
