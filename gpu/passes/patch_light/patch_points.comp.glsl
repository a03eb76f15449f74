#version 460
// The light of patches at one point of every block of pixels, once a frame, from its first sample. Lighting spreads it
// (patch_spread.glsl). Where the block shows two surfaces a second point is listed: patch_seconds looks it up, so that
// a CPU does it for those blocks alone, and not for all beside them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "gpu/passes/patch_light/patch_point.glsl"

layout(local_size_x = PATCH_POINTS_TILE, local_size_y = PATCH_POINTS_TILE) in;
layout(binding = PATCH_POINTS_LIST, scalar) buffer Seconds { uint second_count; uint second_pixels[]; };

// The order of the list decides nothing.
void list_second(bool asks, ivec2 texel)
{
    const uvec4 asked = subgroupBallot(asks);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(second_count, subgroupBallotBitCount(asked));
    first = subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(asked);
    if (asks) second_pixels[first] = uint(texel.y) * 65536u + uint(texel.x);
}

void main()
{
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    const ivec2 blocks = (frame.size + PATCH_BLOCK - 1) / PATCH_BLOCK;
    if (any(greaterThanEqual(block, blocks))) return;
    const ivec2 corner = block * PATCH_BLOCK;
    const ivec2 last = frame.size - 1;
    ivec2 texel = min(corner + PATCH_BLOCK / 2, last);
    float depth = depth_at(texel);
    // Every other pixel of the block.
    float depths[PATCH_BLOCK * PATCH_BLOCK / 2];
    for (int i = 0; i < PATCH_BLOCK * PATCH_BLOCK / 2; ++i) {
        const int y = i / (PATCH_BLOCK / 2);
        const ivec2 at = min(corner + ivec2(2 * (i % (PATCH_BLOCK / 2)) + (y & 1), y), last);
        depths[i] = depth_at(at);
        if (depth <= 0.0 && depths[i] > 0.0) {
            depth = depths[i];
            texel = at;
        }
    }
    const uint base = points_of(block);
    if (depth <= 0.0) {
        points[base + 1u] = uvec4(0u);
        return;
    }
    const vec3 x = position_at(texel, depth);
    const vec3 n = mesh_normal_at(texel, x, depth);
    const float view_m = linear_depth(frame, depth);
    // The pixel that lies farthest off this plane, if it does by more than pixels are wide.
    float farthest = 1.5 * pixel_width_m(frame, view_m) + 0.01;
    ivec2 second = ivec2(-1);
    for (int i = 0; i < PATCH_BLOCK * PATCH_BLOCK / 2; ++i) {
        const int y = i / (PATCH_BLOCK / 2);
        const ivec2 at = min(corner + ivec2(2 * (i % (PATCH_BLOCK / 2)) + (y & 1), y), last);
        if (depths[i] <= 0.0) continue;
        const float away = abs(dot(position_at(at, depths[i]) - x, n));
        if (away > farthest) {
            farthest = away;
            second = at;
        }
    }
    write_point(base, x, n, view_m, second.x >= 0 ? 2u : 1u);
    list_second(second.x >= 0, second);
}
