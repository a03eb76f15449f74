#version 460
// Lists the pixels at which the light of patches is looked up, once a frame, from its first sample: one of every block that
// shows a surface, and another where it shows two. Lighting spreads them (patch_spread.glsl). By a list a CPU does nothing for
// blocks of sky and for second points that are not there.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "gpu/passes/patch_light/patch_point.glsl"

layout(binding = PATCH_POINTS_LIST, scalar) buffer List { uint count; uint listed[]; };

// The order of the list decides nothing.
void list_points(bool first, bool second, ivec2 texel, ivec2 second_texel)
{
    const uvec4 firsts = subgroupBallot(first);
    const uvec4 seconds = subgroupBallot(second);
    const uint first_count = subgroupBallotBitCount(firsts);
    uint begin = 0u;
    if (subgroupElect()) begin = atomicAdd(count, first_count + subgroupBallotBitCount(seconds));
    begin = subgroupBroadcastFirst(begin);
    if (first) listed[begin + subgroupBallotExclusiveBitCount(firsts)] = listed_point(texel, false, second);
    if (second) listed[begin + first_count + subgroupBallotExclusiveBitCount(seconds)] = listed_point(second_texel, true, true);
}

void list_block(ivec2 block, bool inside)
{
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
    const bool shows = inside && depth > 0.0;
    const vec3 x = position_at(texel, depth);
    const vec3 n = mesh_normal_at(texel, x, depth);
    // The pixel that lies farthest off this plane, if it does by more than pixels are wide.
    float farthest = 1.5 * pixel_width_m(frame, linear_depth(frame, depth)) + 0.01;
    ivec2 second = ivec2(-1);
    for (int i = 0; i < PATCH_BLOCK * PATCH_BLOCK / 2; ++i) {
        const int y = i / (PATCH_BLOCK / 2);
        const ivec2 at = min(corner + ivec2(2 * (i % (PATCH_BLOCK / 2)) + (y & 1), y), last);
        const float away = abs(dot(position_at(at, depths[i]) - x, n));
        const bool farther = shows && depths[i] > 0.0 && away > farthest;
        farthest = farther ? away : farthest;
        second = farther ? at : second;
    }
    if (inside && !shows) points[points_of(block) + 1u] = uvec4(0u);
    list_points(shows, second.x >= 0, texel, second);
}

void main()
{
    read_frame();
    const ivec2 blocks = (frame.size + PATCH_BLOCK - 1) / PATCH_BLOCK;
    int number = int(gl_LocalInvocationID.x);
    do {
        const ivec2 block = ivec2(gl_WorkGroupID.xy) * PATCH_POINTS_TILE +
                            ivec2(number % PATCH_POINTS_TILE, number / PATCH_POINTS_TILE);
        list_block(block, all(lessThan(block, blocks)));
        number += int(gl_WorkGroupSize.x);
    } while (number < PATCH_POINTS_TILE * PATCH_POINTS_TILE);
}
