// Occlusion is looked for at one pixel of each block of two by two; its others take it from that point and from those of
// the blocks around that lie on its plane. How a point is written, and how far another lies off its plane.
#ifndef PETRICHOR_FORMULAS_LIGHT_OCCLUSION_POINTS_H
#define PETRICHOR_FORMULAS_LIGHT_OCCLUSION_POINTS_H

#include "base/interop.h"

SHARED_BEGIN

struct OcclusionPoint {
    float depth;  // as the picture has it: over a plane it changes evenly along rows and columns. To 1 in 65536
    float open;   // 0..1, in 8 bits
    vec2 slope;   // change of depth from pixel to pixel, in the depth that a pixel is wide; in 14 bits each
    uint alone;   // bit x + 2 y: that pixel of the block does not lie on the plane and looks for itself
};

// Steep slopes are kept more coarsely, as they are foreshortened.
SHARED_FN uint occlusion_slope_code(float slope)
{
    return uint(clamp(slope / (1.0f + abs(slope)), -0.999f, 0.999f) * 8191.5f + 8192.5f);
}

SHARED_FN float occlusion_slope_of(uint code)
{
    const float c = (float(code) - 8192.0f) * (1.0f / 8191.5f);
    return c / (1.0f - abs(c));
}

// Its neighbours read x alone.
SHARED_FN uvec2 occlusion_point_code(OcclusionPoint p)
{
    return uvec2((floatBitsToUint(p.depth) << 1u & 0xffffff00u) | uint(clamp(p.open, 0.0f, 1.0f) * 255.0f + 0.5f),
                 occlusion_slope_code(p.slope.x) | occlusion_slope_code(p.slope.y) << 14u | p.alone << 28u);
}

SHARED_FN float occlusion_point_depth(uint x)
{
    return uintBitsToFloat(x >> 1u & 0x7fffff80u);
}

SHARED_FN float occlusion_point_open(uint x)
{
    return float(x & 255u) * (1.0f / 255.0f);
}

SHARED_FN OcclusionPoint occlusion_point_of(uvec2 code)
{
    OcclusionPoint p;
    p.depth = occlusion_point_depth(code.x);
    p.open = occlusion_point_open(code.x);
    p.slope = vec2(occlusion_slope_of(code.y & 16383u), occlusion_slope_of(code.y >> 14u & 16383u));
    p.alone = code.y >> 28u;
    return p;
}

// Both words of a block without a point: it fits no other, and its pixels look for themselves.
SHARED_CONST uint kNoOcclusionPoint = 0xffffffffu;

// How far a depth lies off the plane of a point, in widths of a pixel there.
//
//   across   from the point to where that depth is, pixels
//   step     change of depth over the width of a pixel there
SHARED_FN float occlusion_off_plane(OcclusionPoint p, vec2 across, float depth, float step)
{
    const float off = (depth - p.depth) / step - dot(p.slope, across);
    return abs(off) * inversesqrt(1.0f + dot(p.slope, p.slope));
}

// How much a point counts there; comparisons with no number are false.
SHARED_FN float occlusion_fit(float off_plane)
{
    return off_plane < 1.0f ? 1.0f - off_plane : 0.0f;
}

// A pixel that fits its own block's point less looks for itself.
SHARED_CONST float kLeastOcclusionFit = 0.4f;

// The occlusion of a pixel from four points as if each were in the middle of its block: its own, those of the blocks
// beside and above or below, and the one between them, with how much they count.
SHARED_FN float occlusion_from(float own, vec2 beside, vec2 over, vec2 between)
{
    const float sum = 9.0f * own + 3.0f * (beside.x * beside.y + over.x * over.y) + between.x * between.y;
    return sum / (9.0f + 3.0f * (beside.y + over.y) + between.y);
}

// Four of them lie in a word, in the order of the bits of `alone`.
SHARED_FN uint occlusion_in_word(float open, uint pixel)
{
    return uint(clamp(open, 0.0f, 1.0f) * 255.0f + 0.5f) << (8u * pixel);
}

SHARED_FN float occlusion_of_word(uint word, uint pixel)
{
    return float(word >> (8u * pixel) & 255u) * (1.0f / 255.0f);
}

SHARED_END

#endif
