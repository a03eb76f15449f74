// The pixel that an invocation of an 8 x 8 group shades: of the picture, or of a list. Before the include:
//   PIXEL_LIST_BINDING   binding of the list
#ifndef PETRICHOR_PIXEL_LIST_GLSL
#define PETRICHOR_PIXEL_LIST_GLSL

#include "gpu/frame/pixel_list_io.h"

layout(constant_id = PIXEL_LIST_SPEC) const uint LISTED = 0u;
layout(binding = PIXEL_LIST_BINDING) uniform usamplerBuffer pixel_list;

// False where there is none.
bool this_pixel(ivec2 size, out ivec2 pixel)
{
    const uint count = LISTED != 0u ? texelFetch(pixel_list, 0).r : PIXEL_LIST_ALL;
    if (count != PIXEL_LIST_ALL) {
        const uint at = gl_WorkGroupID.x * uint(PIXEL_LIST_GROUP) + gl_LocalInvocationIndex;
        const uint packed = texelFetch(pixel_list, int(at) + 1).r;
        pixel = ivec2(packed & 65535u, packed >> 16);
        return at < count;
    }
    pixel = ivec2(gl_GlobalInvocationID.xy);
    return all(lessThan(pixel, size));
}

#endif
