// The light of patches at one point of a block of pixels, as patch_points_io.h lays it out.
#ifndef PETRICHOR_PATCH_POINT_GLSL
#define PETRICHOR_PATCH_POINT_GLSL

#include "gpu/frame/gbuffer.glsl"
#include "gpu/frame/pixel_list_io.h"
#include "formulas/light/patch_cells.h"
#include "formulas/light/near_light.h"
#include "gpu/passes/patch_light/patch_plane.glsl"

layout(local_size_x_id = PIXEL_LIST_SPEC_INVOCATIONS) in;
layout(binding = PATCH_POINTS_FRAME, scalar) uniform Frame { FrameConstants frame_block; };
FrameConstants frame;  // what is asked here, read once for all that an invocation does
layout(binding = PATCH_POINTS_DEPTH) uniform samplerBuffer depth_rows;
layout(binding = PATCH_POINTS_NORMALS) uniform samplerBuffer normal_rows;
layout(binding = PATCH_POINTS_TABLE) uniform usamplerBuffer patch_table_texels;
layout(binding = PATCH_POINTS_WAYS) uniform usamplerBuffer patch_way_texels;
layout(binding = PATCH_POINTS_PLANES) uniform samplerBuffer patch_plane_texels;
layout(binding = PATCH_POINTS_IRRADIANCE) uniform samplerBuffer patch_irradiance_texels;
layout(binding = PATCH_POINTS_GRADIENT) uniform samplerBuffer patch_gradient_texels;
layout(binding = PATCH_POINTS_NEAR) uniform samplerBuffer patch_near_texels;
layout(binding = PATCH_POINTS_TARGET, scalar) writeonly buffer Target { uvec4 points[]; };

uvec4 patch_table(uint slot)
{
    return texelFetch(patch_table_texels, int(slot));
}
uint patch_way(uint index)
{
    return texelFetch(patch_way_texels, int(index)).r;
}
vec4 patch_plane(uint node)
{
    return texelFetch(patch_plane_texels, int(node));
}
vec4 patch_irradiance(uint node)
{
    return texelFetch(patch_irradiance_texels, int(node));
}
vec4 patch_gradient(uint node)
{
    return texelFetch(patch_gradient_texels, int(node));
}
vec4 patch_near(uint texel)
{
    return texelFetch(patch_near_texels, int(texel));
}
#include "formulas/light/patch_lookup.inc"

#include "gpu/frame/geometry_normal.glsl"

void read_frame()
{
    frame.size = frame_block.size;
    frame.flags = frame_block.flags;
    frame.camera_m = frame_block.camera_m;
    frame.forward = frame_block.forward;
    frame.origin_corner = frame_block.origin_corner;
    frame.ray_corner = frame_block.ray_corner;
    frame.ray_dx = frame_block.ray_dx;
    frame.ray_dy = frame_block.ray_dy;
    frame.near_m = frame_block.near_m;
    frame.far_m = frame_block.far_m;
    frame.pixel_angle = frame_block.pixel_angle;
    frame.patches = frame_block.patches;
    frame.snow_lift_m = frame_block.snow_lift_m;
}

// A pixel in the list: of which point of its block, of how many.
uint listed_point(ivec2 texel, bool second, bool two)
{
    return uint(texel.x) | (second ? 0x8000u : 0u) | uint(texel.y) << 16 | (two ? 0x80000000u : 0u);
}

// Where the points of a block begin.
uint points_of(ivec2 block)
{
    const int across = (frame.size.x + PATCH_BLOCK - 1) / PATCH_BLOCK;
    return uint(block.y * across + block.x) * uint(PATCH_POINTS * PATCH_POINT_TEXELS);
}

vec3 mesh_normal_at(ivec2 texel, vec3 x, float depth)
{
    return geometry_normal(texel, x, depth, octahedral_decode(texelFetch(normal_rows, row_texel(texel, frame.size)).xy));
}

// n: of the mesh at x; count: points of the block.
void write_point(uint base, vec3 x, vec3 n, float view_m, uint count)
{
    const PatchLight light = patch_lookup(frame.patches, x, n, frame.snow_lift_m);
    vec4 sent = vec4(0.0, 0.0, 0.0, -1.0);
    vec4 turn = vec4(0.0, 0.0, 0.0, 1.0);
    const uint close = uint(clamp(light.close, 0.0, 1.0) * 4095.0 + 0.5);
    const uint close_light = uint(clamp(light.close_light, 0.0, 1.0) * 4095.0 + 0.5);
    if (light.weight > 0.0) {
        sent = vec4(min(light.irradiance * 0.31830989, vec3(60000.0)), light.open);
        // irradiance_towards is linear in the bent normal.
        const vec3 mean = normalize(light.normal);
        const float even = 0.5 * (1.0 - dot(light.gradient, mean));
        turn = vec4(light.gradient + mean * even, even);
    }
    const uint code = plane_code(n);
    points[base] = uvec4(packHalf2x16(sent.xy), packHalf2x16(sent.zw),
                         code, floatBitsToUint(dot(plane_normal(code), x - frame.camera_m)));
    points[base + 1u] = uvec4(packHalf2x16(turn.xy), packHalf2x16(turn.zw),
                              floatBitsToUint(view_m),
                              count | close << 8 | close_light << 20);
}

#endif
