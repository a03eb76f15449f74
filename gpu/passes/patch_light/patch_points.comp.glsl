#version 460
// The light of patches at one point of every block of pixels, at two where the block shows two
// surfaces: once a frame, from its first sample. Lighting spreads it (patch_spread.glsl).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "formulas/light/patch_cells.h"
#include "formulas/light/near_light.h"
#include "gpu/passes/patch_light/patch_plane.glsl"

layout(local_size_x = PATCH_POINTS_TILE, local_size_y = PATCH_POINTS_TILE) in;
layout(binding = PATCH_POINTS_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = PATCH_POINTS_DEPTH) uniform samplerBuffer depth_rows;
layout(binding = PATCH_POINTS_NORMALS) uniform sampler2D normal_map;
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
    uint base = uint(block.y * blocks.x + block.x) * uint(PATCH_POINTS * PATCH_POINT_TEXELS);
    uint count = depth > 0.0 ? 1u : 0u;
    uint first = base;
    for (uint e = 0u; e < count; ++e) {
        const vec3 x = position_at(texel, depth);
        const vec3 n = geometry_normal(texel, x, depth, octahedral_decode(texelFetch(normal_map, texel, 0).xy));
        const float view_m = linear_depth(frame, depth);
        const ivec2 own = texel;
        const float own_depth = depth;
        if (e == 0u) {
            // The pixel that lies farthest off this plane, if it does by more than pixels are wide.
            float farthest = 1.5 * pixel_width_m(frame, view_m) + 0.01;
            for (int i = 0; i < PATCH_BLOCK * PATCH_BLOCK / 2; ++i) {
                const int y = i / (PATCH_BLOCK / 2);
                const ivec2 at = min(corner + ivec2(2 * (i % (PATCH_BLOCK / 2)) + (y & 1), y), last);
                if (depths[i] <= 0.0) continue;
                const float away = abs(dot(position_at(at, depths[i]) - x, n));
                if (away > farthest) {
                    farthest = away;
                    texel = at;
                    depth = depths[i];
                    count = 2u;
                }
            }
        }
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
        base += uint(PATCH_POINT_TEXELS);
    }
    if (count == 0u) points[first + 1u] = uvec4(0u);
}
