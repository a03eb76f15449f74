#version 460
// The occlusion of the four pixels of every block, of the points around that lie on the plane of its own. A workgroup
// is a tile.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "formulas/light/bent_normal.h"
#include "formulas/light/occlusion_points.h"
#include "gpu/passes/ambient_occlusion/ambient_occlusion_io.h"
#define PIXEL_LIST_BINDING SPREAD_OCCLUSION_TILES
#include "gpu/frame/pixel_list.glsl"
#include "gpu/frame/occlusion_blocks.glsl"

layout(local_size_x = OCCLUSION_LANES, local_size_y = OCCLUSION_ROWS) in;
layout(constant_id = AMBIENT_OCCLUSION_SPEC_BENT) const uint BENT = 0u;
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

// The bent normal of a point beside.
vec3 bent_beside(ivec2 block, ivec2 step)
{
    const ivec2 last = (frame.size - 1) / OCCLUSION_BLOCK;
    const ivec2 at = clamp(block + step, ivec2(0), last);
    return octahedral_decode(unpackSnorm2x16(texelFetch(points, bent_point_word(at, frame.size)).r));
}

// As occlusion_from(), of bent normals; one that does not count may be any.
uint bent_from(vec3 own, vec3 beside, vec3 over, vec3 between, float beside_fit, float over_fit, float between_fit)
{
    return bent_code(normalize(9.0 * own + 3.0 * (beside * beside_fit + over * over_fit) + between * between_fit + own * 1.0e-3));
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
    const vec2 left_up = beside(own, block, ivec2(-1, -1), step);
    const vec2 right_up = beside(own, block, ivec2(1, -1), step);
    const vec2 left_down = beside(own, block, ivec2(-1, 1), step);
    const vec2 right_down = beside(own, block, ivec2(1, 1), step);
    const uint word = occlusion_in_word(occlusion_from(own.open, left, up, left_up), 0u) |
                      occlusion_in_word(occlusion_from(own.open, right, up, right_up), 1u) |
                      occlusion_in_word(occlusion_from(own.open, left, down, left_down), 2u) |
                      occlusion_in_word(occlusion_from(own.open, right, down, right_down), 3u);
    // Bytes of those that look for themselves are zero.
    const uint alone = own.alone;
    const uint kept = (alone & 1u) * 0xffu | (alone >> 1 & 1u) * 0xff00u | (alone >> 2 & 1u) * 0xff0000u | (alone >> 3) * 0xff000000u;
    target[at] = word & ~kept;
    if (BENT != 0u) {
        const vec3 bent = bent_beside(block, ivec2(0));
        const vec3 bent_left = bent_beside(block, ivec2(-1, 0));
        const vec3 bent_right = bent_beside(block, ivec2(1, 0));
        const vec3 bent_up = bent_beside(block, ivec2(0, -1));
        const vec3 bent_down = bent_beside(block, ivec2(0, 1));
        const uint above = bent_from(bent, bent_left, bent_up, bent_beside(block, ivec2(-1, -1)), left.y, up.y, left_up.y) |
                           bent_from(bent, bent_right, bent_up, bent_beside(block, ivec2(1, -1)), right.y, up.y, right_up.y) << 16;
        const uint below = bent_from(bent, bent_left, bent_down, bent_beside(block, ivec2(-1, 1)), left.y, down.y, left_down.y) |
                           bent_from(bent, bent_right, bent_down, bent_beside(block, ivec2(1, 1)), right.y, down.y, right_down.y) << 16;
        const int bent_at = bent_word(block * OCCLUSION_BLOCK, frame.size);
        target[bent_at] = above & ~((alone & 1u) * 0xffffu | (alone >> 1 & 1u) * 0xffff0000u);
        target[bent_at + 1] = below & ~((alone >> 2 & 1u) * 0xffffu | (alone >> 3) * 0xffff0000u);
    }
}
