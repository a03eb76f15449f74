#version 460
// The second points of the blocks that show two surfaces, from the list of their pixels (patch_points).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/patch_light/patch_point.glsl"
#define PIXEL_LIST_BINDING PATCH_POINTS_LIST
#include "gpu/frame/pixel_list.glsl"

layout(local_size_x = PATCH_POINTS_TILE, local_size_y = PATCH_POINTS_TILE) in;

void main()
{
    ivec2 texel;
    if (!this_pixel(frame.size, texel)) return;
    const float depth = depth_at(texel);
    const vec3 x = position_at(texel, depth);
    write_point(points_of(texel / PATCH_BLOCK) + uint(PATCH_POINT_TEXELS), x, mesh_normal_at(texel, x, depth),
                linear_depth(frame, depth), 2u);
}
