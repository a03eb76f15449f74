// Interface of the pass that lights vertices.
#ifndef PETRICHOR_GPU_PASSES_VERTEX_LIGHT_VERTEX_LIGHT_IO_H
#define PETRICHOR_GPU_PASSES_VERTEX_LIGHT_VERTEX_LIGHT_IO_H

#include "base/interop.h"

#define VERTEX_LIGHT_GROUP 32      // vertices
#define VERTEX_LIGHT_MOST 16384    // lamps
#define VERTEX_LIGHT_GROUPS_X 32768  // of a row of groups

#define VERTEX_LIGHT_SPEC_WAYS 0  // LIGHTS_... of the lamps

#define VERTEX_LIGHT_LAMPS 0     // rows of the table of lights
#define VERTEX_LIGHT_PROFILES 1
#define VERTEX_LIGHT_VERTICES 2  // four texels each
#define VERTEX_LIGHT_JOBS 3      // of each group: row of its draw, first vertex, how many, where their light goes
#define VERTEX_LIGHT_DRAWS 4     // VERTEX_LIGHT_DRAW_TEXELS each: rows of both transforms
#define VERTEX_LIGHT_OUT 5       // two words a vertex, front and back (formulas/codec/shared_exponent.h)
#define VERTEX_LIGHT_DRAW_TEXELS 6

// In place of where the light of a draw's vertices begins, less their number: there is none.
#define VERTEX_LIGHT_NONE 0xffffffffu

SHARED_BEGIN

struct VertexLightParams {
    uint groups;
    uint first_lamp;  // row of the table
    uint lamps;
};

SHARED_END

#endif
