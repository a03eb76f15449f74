#version 460
// The light of patches at the points that patch_points listed.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/patch_light/patch_point.glsl"

layout(binding = PATCH_POINTS_LIST) uniform usamplerBuffer listed;

void look_up(uint entry)
{
    const uint packed = texelFetch(listed, int(entry) + 1).r;
    const ivec2 texel = ivec2(packed & 0x7fffu, (packed >> 16) & 0x7fffu);
    const bool second = (packed & 0x8000u) != 0u;
    const float depth = depth_at(texel);
    const vec3 x = position_at(texel, depth);
    write_point(points_of(texel / PATCH_BLOCK) + (second ? uint(PATCH_POINT_TEXELS) : 0u), x, mesh_normal_at(texel, x, depth),
                linear_depth(frame, depth), packed >= 0x80000000u ? 2u : 1u);
}

void main()
{
    read_frame();
    const uint count = texelFetch(listed, 0).r;
    uint entry = gl_WorkGroupID.x * uint(PIXEL_LIST_GROUP) + gl_LocalInvocationID.x;
    const uint end = min(count, (gl_WorkGroupID.x + 1u) * uint(PIXEL_LIST_GROUP));
    do {
        if (entry < end) look_up(entry);
        entry += gl_WorkGroupSize.x;
    } while (entry < end);
}
