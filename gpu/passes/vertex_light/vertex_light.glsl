// What lamps gave a vertex (passes/vertex_light), for passes that draw surfaces. The includer names the bindings:
//   VERTEX_LIGHT_PLACE    two words a vertex
//   VERTEX_LIGHT_FIRSTS   of each draw: where those of its vertices begin, less the number of the first
#ifndef PETRICHOR_VERTEX_LIGHT_GLSL
#define PETRICHOR_VERTEX_LIGHT_GLSL

#include "formulas/codec/shared_exponent.h"
#include "gpu/passes/vertex_light/vertex_light_io.h"

layout(set = 0, binding = VERTEX_LIGHT_PLACE) uniform usamplerBuffer lit_vertices;
layout(set = 0, binding = VERTEX_LIGHT_FIRSTS) uniform usamplerBuffer lit_firsts;

// Codes of the front and of the back.
uvec2 vertex_light_code(int draw, int vertex)
{
    const uint first = texelFetch(lit_firsts, draw).r;
    const uvec2 code = texelFetch(lit_vertices, first == VERTEX_LIGHT_NONE ? 0 : int(first + uint(vertex))).rg;
    return first == VERTEX_LIGHT_NONE ? uvec2(0u) : code;
}

#endif
