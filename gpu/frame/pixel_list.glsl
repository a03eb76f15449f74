// The pixel that an invocation of a group of 64 shades: of the picture, or of a list. Before the include:
//   PIXEL_LIST_BINDING   binding of the list
#ifndef PETRICHOR_PIXEL_LIST_GLSL
#define PETRICHOR_PIXEL_LIST_GLSL

#include "gpu/frame/pixel_list_io.h"

layout(constant_id = PIXEL_LIST_SPEC) const uint LISTED = 0u;
layout(binding = PIXEL_LIST_BINDING) uniform usamplerBuffer pixel_list;

ivec2 listed_at(uint entry)
{
    const uint packed = texelFetch(pixel_list, int(entry) + 1).r;
    return ivec2(packed & 65535u, packed >> 16);
}

// number: of the pixel in its group. False where there is none.
bool this_pixel(uint number, ivec2 size, out ivec2 pixel)
{
    const uint count = LISTED == 1u ? texelFetch(pixel_list, 0).r : LISTED == 2u ? PIXEL_LIST_TILES : PIXEL_LIST_ALL;
    if (count < PIXEL_LIST_TILES) {
        const uint entry = gl_WorkGroupID.x * uint(PIXEL_LIST_GROUP) + number;
        pixel = listed_at(entry);
        return entry < count;
    }
    const ivec2 tile = count == PIXEL_LIST_TILES ? listed_at(gl_WorkGroupID.x) : ivec2(gl_WorkGroupID.xy);
    pixel = tile * PIXEL_LIST_TILE + ivec2(number % PIXEL_LIST_TILE, number / PIXEL_LIST_TILE);
    return all(lessThan(pixel, size));
}

bool this_pixel(ivec2 size, out ivec2 pixel)
{
    return this_pixel(gl_LocalInvocationIndex, size, pixel);
}

#endif
