#version 460
// The occlusion of the four pixels of every block, of the points around that lie on the plane of its own. A workgroup
// is a tile.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "formulas/light/occlusion_points.h"
#include "gpu/passes/ambient_occlusion/ambient_occlusion_io.h"
#define PIXEL_LIST_BINDING SPREAD_OCCLUSION_TILES
#include "gpu/frame/pixel_list.glsl"
#include "gpu/frame/occlusion_blocks.glsl"

layout(local_size_x = OCCLUSION_LANES, local_size_y = OCCLUSION_ROWS) in;
layout(binding = SPREAD_OCCLUSION_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = SPREAD_OCCLUSION_POINTS) uniform usamplerBuffer points;
layout(binding = SPREAD_OCCLUSION_TARGET, scalar) writeonly buffer Target { uint target[]; };

// A point beside, and how much it counts.
vec2 beside(OcclusionPoint own, ivec2 block, ivec2 step, float depth_step)
{
    const ivec2 last = (frame.size - 1) / OCCLUSION_BLOCK;
    const uint x = texelFetch(points, 2 * occlusion_block(clamp(block + step, ivec2(0), last), frame.size)).r;
    const float off =
        occlusion_off_plane(own, vec2(step * OCCLUSION_BLOCK), occlusion_point_depth(x), depth_step);
    return vec2(occlusion_point_open(x), occlusion_fit(off));
}

void main()
{
    const ivec2 block = block_of_tile(listed_at(gl_WorkGroupID.x), int(gl_LocalInvocationIndex));
    if (any(greaterThanEqual(block * OCCLUSION_BLOCK, frame.size))) return;
    const int at = occlusion_block(block, frame.size);
    const OcclusionPoint own = occlusion_point_of(uvec2(texelFetch(points, 2 * at).r, texelFetch(points, 2 * at + 1).r));
    const float step = pixel_depth_step(frame, own.depth);
    const vec2 left = beside(own, block, ivec2(-1, 0), step);
    const vec2 right = beside(own, block, ivec2(1, 0), step);
    const vec2 up = beside(own, block, ivec2(0, -1), step);
    const vec2 down = beside(own, block, ivec2(0, 1), step);
    const uint word = occlusion_in_word(occlusion_from(own.open, left, up, beside(own, block, ivec2(-1, -1), step)), 0u) |
                      occlusion_in_word(occlusion_from(own.open, right, up, beside(own, block, ivec2(1, -1), step)), 1u) |
                      occlusion_in_word(occlusion_from(own.open, left, down, beside(own, block, ivec2(-1, 1), step)), 2u) |
                      occlusion_in_word(occlusion_from(own.open, right, down, beside(own, block, ivec2(1, 1), step)), 3u);
    // Bytes of those that look for themselves are zero.
    const uint alone = own.alone;
    const uint kept = (alone & 1u) * 0xffu | (alone >> 1 & 1u) * 0xff00u | (alone >> 2 & 1u) * 0xff0000u | (alone >> 3) * 0xff000000u;
    target[at] = word & ~kept;
}
