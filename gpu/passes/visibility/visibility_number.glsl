// Which triangle of its draw a fragment shows.
#ifndef PETRICHOR_VISIBILITY_NUMBER_GLSL
#define PETRICHOR_VISIBILITY_NUMBER_GLSL

#include "gpu/passes/visibility/visibility_place.glsl"

layout(constant_id = VISIBILITY_SPEC_LISTED) const uint LISTED = 0u;
layout(set = 0, binding = VISIBILITY_NUMBERS) uniform usamplerBuffer numbers;

// number: of the draw. Steep triangles are marked beside it.
uvec2 id_of(uint number)
{
    if (LISTED == 0u) return uvec2(number + 1u, uint(gl_PrimitiveID));
    const uint listed = texelFetch(numbers, int(draw.first_number) + gl_PrimitiveID).r;
    return uvec2((number + 1u) | (listed & ID_STEEP), listed & ~ID_STEEP);
}

#endif
