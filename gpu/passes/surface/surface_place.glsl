// Constants of the draw that a vertex is of: pushed, or of one of many instances.
#ifndef PETRICHOR_SURFACE_PLACE_GLSL
#define PETRICHOR_SURFACE_PLACE_GLSL

#include "gpu/passes/surface/surface_draws_io.h"
#include "gpu/upload/material_io.h"

layout(constant_id = SURFACE_SPEC_INSTANCED) const uint INSTANCED = 0u;
layout(set = 0, binding = SURFACE_DRAWS) uniform usamplerBuffer draw_table;
layout(push_constant, scalar) uniform Push { DrawConstants draw; };

DrawConstants draw_here(int instance)
{
    DrawConstants here = draw;
    if (INSTANCED != 0u) {
        const int first = instance * SURFACE_DRAW_TEXELS;
        for (int row = 0; row < 3; ++row) {
            here.to_world[row] = uintBitsToFloat(texelFetch(draw_table, first + row));
            here.normal_to_world[row] = uintBitsToFloat(texelFetch(draw_table, first + 3 + row));
        }
        const uvec4 who = texelFetch(draw_table, first + 6);
        here.instance_id = who.x;
        here.look = who.z;
    }
    return here;
}

#endif
