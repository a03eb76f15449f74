// A depth map as texels of a buffer, of which each holds the four neighbours that a filter reads, in 16 bits each: one
// look in place of four. A step of 16 bits is a hundred and twentieth of a texel of the map where it is as deep as wide.
//
// One text for C++ and GLSL. Depths are 0..1, the nearer to the eye of the map the larger.
#ifndef PETRICHOR_FORMULAS_WEATHER_DEPTH_QUADS_H
#define PETRICHOR_FORMULAS_WEATHER_DEPTH_QUADS_H

#include "base/interop.h"

SHARED_BEGIN

// Signed numbers become floats, and back, in one instruction of any CPU.
SHARED_FN int depth_code(float depth)
{
    return int(clamp(depth, 0.0f, 1.0f) * 65535.0f + 0.5f);
}

// depths: of a texel, the next one of its row, and both of the row below.
SHARED_FN uvec2 depth_quad(vec4 depths)
{
    return uvec2(uint(depth_code(depths.x)) | uint(depth_code(depths.y)) << 16u,
                 uint(depth_code(depths.z)) | uint(depth_code(depths.w)) << 16u);
}

// Share of the four that what falls passes to reach `depth`. share: 0..1 from the first texel to its neighbours.
SHARED_FN float share_passed(uvec2 quad, float depth, vec2 share)
{
    const int code = depth_code(depth);
    const float left = 1.0f - share.x;
    const float above = (code >= int(quad.x & 65535u) ? left : 0.0f) + (code >= int(quad.x >> 16u) ? share.x : 0.0f);
    const float below = (code >= int(quad.y & 65535u) ? left : 0.0f) + (code >= int(quad.y >> 16u) ? share.x : 0.0f);
    return above + (below - above) * share.y;
}

SHARED_END

#endif
