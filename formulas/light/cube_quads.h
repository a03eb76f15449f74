// A cube map as texels of a buffer, by which a CPU filters it in less time than a sampler does: each texel
// (RGBA32UI) is what a bilinear filter reads, four neighbours in a word each. Where neighbours lie on other faces, they
// are those; at a corner of the cube the fourth is the mean of the three that there are. So a filter needs no case of
// its own at edges.
#ifndef PETRICHOR_FORMULAS_LIGHT_CUBE_QUADS_H
#define PETRICHOR_FORMULAS_LIGHT_CUBE_QUADS_H

#include "base/interop.h"
#include "formulas/light/cube_map.h"

SHARED_BEGIN

struct CubePlace {
    int face;
    vec2 st;  // each -1..1
};

// Where a direction meets the cube: cube_direction backwards.
SHARED_FN CubePlace cube_place(vec3 d)
{
    const vec3 size = abs(d);
    const bool on_x = size.x >= size.y && size.x >= size.z;
    const bool on_y = !on_x && size.y >= size.z;
    const float major = on_x ? d.x : on_y ? d.y : d.z;
    const float s = on_x ? -d.z : d.x;
    const float t = on_y ? d.z : -d.y;
    const float one = 1.0f / max(abs(major), 1.0e-20f);
    const float side = major < 0.0f ? -one : one;
    CubePlace place;
    place.face = (on_x ? 0 : on_y ? 2 : 4) + (major < 0.0f ? 1 : 0);
    // Faces across the y axis turn their other coordinate.
    place.st = vec2(s * (on_y ? one : side), t * (on_y ? side : one));
    return place;
}

// The place of the texel beside a face, one past one of its edges; texel: -1..side, one of both inside.
SHARED_FN CubePlace cube_beside(int face, ivec2 texel, int side)
{
    const vec2 st = (vec2(texel) + splat2(0.5f)) * (2.0f / float(side)) - splat2(1.0f);
    // On the edge of the face the other one begins: half a texel further in is the middle of its first texel.
    const vec2 held = clamp(st, splat2(-1.0f), splat2(1.0f));
    const vec3 inward = cube_direction(face, splat2(0.0f)) * (1.0f / float(side));
    return cube_place(cube_direction(face, held) - inward);
}

// Of a level with 2^side_log2 texels a side: where its quads begin, with those of coarser levels before them down to
// one of 2. A face has one more than texels a side, row by row.
SHARED_FN int cube_quads_begin(int side_log2)
{
    const int side = 1 << side_log2;
    return 2 * side * side + 12 * side - 38 + 6 * side_log2;
}

SHARED_FN int cube_quad(int begin, int side, int face, ivec2 quad)
{
    return begin + (face * (side + 1) + quad.y) * (side + 1) + quad.x;
}

// Light in a word: three numbers of nine bits over a common exponent; from 2^-24 to 65408.
SHARED_FN uint light_word(vec3 light)
{
    const vec3 c = clamp(light, splat3(0.0f), splat3(65408.0f));
    // The largest has its first bit in the nine, after it is rounded.
    const float most = max(c.x, max(c.y, c.z)) * (1024.0f / 1023.0f);
    const int power = max(int(floatBitsToUint(most) >> 23u) - 127, -16) + 1;
    const float scale = uintBitsToFloat(uint(127 + 9 - power) << 23u);
    const uint r = min(uint(c.x * scale + 0.5f), 511u);
    const uint g = min(uint(c.y * scale + 0.5f), 511u);
    const uint b = min(uint(c.z * scale + 0.5f), 511u);
    return r | g << 9u | b << 18u | uint(power + 15) << 27u;
}

// .. times a weight. Signed numbers become floats in one instruction of any CPU.
SHARED_FN vec3 light_of_word(uint word, float weight)
{
    const float scale = uintBitsToFloat(((word >> 27u) + 103u) << 23u) * weight;
    return vec3(float(int(word & 511u)), float(int((word >> 9u) & 511u)), float(int((word >> 18u) & 511u))) * scale;
}

SHARED_END

#endif
