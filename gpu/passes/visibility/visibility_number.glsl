// Which triangle of its draw a fragment shows.
#ifndef PETRICHOR_VISIBILITY_NUMBER_GLSL
#define PETRICHOR_VISIBILITY_NUMBER_GLSL

#include "gpu/passes/visibility/visibility_place.glsl"

layout(constant_id = VISIBILITY_SPEC_LISTED) const uint LISTED = 0u;
layout(set = 0, binding = VISIBILITY_NUMBERS) uniform usamplerBuffer numbers;

uint triangle_number()
{
    if (LISTED == 0u) return uint(gl_PrimitiveID);
    return texelFetch(numbers, int(draw.first_number) + gl_PrimitiveID).r;
}

#endif
