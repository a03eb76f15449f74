#version 460
// The occlusion of one pixel of every block of two by two, another one in the next sample. Pixels of the block that do
// not lie on its plane are listed: they look for themselves. A workgroup is a tile.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "gpu/passes/ambient_occlusion/ambient_occlusion.glsl"

layout(local_size_x = OCCLUSION_LANES, local_size_y = OCCLUSION_ROWS) in;
layout(binding = OCCLUSION_POINTS_TARGET, scalar) writeonly buffer Points { uint points[]; };
layout(binding = OCCLUSION_POINTS_ALONE, scalar) buffer Alone { uint alone_count; uint alone_pixels[]; };

// The change of depth to the neighbour along an axis that is nearer in depth.
float depth_change(ivec2 texel, float depth, ivec2 step)
{
    const float after = depth_at(texel + step) - depth;
    const float before = depth - depth_at(texel - step);
    return abs(after) < abs(before) ? after : before;
}

void main()
{
    const ivec2 block = block_of_tile(listed_at(gl_WorkGroupID.x), int(gl_LocalInvocationIndex));
    const ivec2 corner = block * OCCLUSION_BLOCK;
    if (any(greaterThanEqual(corner, frame.size))) return;
    const ivec2 texel = min(corner + ivec2(frame.sample_index & 1u, frame.sample_index >> 1 & 1u), frame.size - 1);
    const float depth = depth_at(texel);
    const float step = pixel_depth_step(frame, depth);
    OcclusionPoint point;
    point.depth = depth;
    const Open open = open_at(texel, max(depth, 1.0e-9), picture_pixel(corner) / OCCLUSION_BLOCK);
    point.open = open.share;
    point.slope = vec2(depth_change(texel, depth, ivec2(1, 0)), depth_change(texel, depth, ivec2(0, 1))) / step;
    point.alone = 0u;
    for (int i = 0; i < OCCLUSION_BLOCK * OCCLUSION_BLOCK; ++i) {
        const ivec2 at = corner + ivec2(i & 1, i >> 1);
        const float other = depth_at(at);
        const float fit = occlusion_fit(occlusion_off_plane(point, vec2(at - texel), other, step));
        const bool alone = other > 0.0 && all(lessThan(at, frame.size)) && !(depth > 0.0 && fit >= kLeastOcclusionFit);
        if (alone) point.alone |= 1u << i;
    }
    const int at_point = 2 * occlusion_block(block, frame.size);
    const uvec2 code = depth > 0.0 ? occlusion_point_code(point) : uvec2(kNoOcclusionPoint);
    points[at_point] = code.x;
    points[at_point + 1] = code.y;
    if (BENT != 0u) points[bent_point_word(block, frame.size)] = packSnorm2x16(octahedral_encode(open.bent));
    const uint count = uint(bitCount(point.alone));
    const uint before = subgroupExclusiveAdd(count);
    const uint all_of_them = subgroupAdd(count);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(alone_count, all_of_them);
    first = subgroupBroadcastFirst(first) + before;
    for (uint i = 0u; i < 4u; ++i) {
        if ((point.alone >> i & 1u) == 0u) continue;
        const ivec2 at = corner + ivec2(i & 1u, i >> 1);
        alone_pixels[first++] = uint(at.y) * 65536u + uint(at.x);
    }
}
