// The light of patches at a pixel, from the points looked up in the four blocks around: those on its
// own surface count. The includer has `frame` and
//
//   usamplerBuffer patch_point_texels   patch_points_io.h
#ifndef PETRICHOR_PATCH_SPREAD_GLSL
#define PETRICHOR_PATCH_SPREAD_GLSL

#include "gpu/passes/patch_light/patch_plane.glsl"

struct SpreadLight {
    vec3 irradiance;    // over pi, for the normal `bent`
    float open;         // share of open directions; < 0: no patch is near
    float close;        // PatchLight::close
    float close_light;  // PatchLight::close_light
};

SpreadLight patch_light_at(vec3 x, vec3 geometry, vec3 bent, vec3 v, float view_m, ivec2 texel)
{
    const ivec2 blocks = (frame.size + PATCH_BLOCK - 1) / PATCH_BLOCK;
    const vec2 at = (vec2(texel) - float(PATCH_BLOCK / 2)) / float(PATCH_BLOCK);
    const vec2 low = floor(at);
    const vec2 part = at - low;
    const vec3 from_camera = x - frame.camera_m;
    const float pixel_m = pixel_width_m(frame, view_m);
    // Light changes over a share of a cell; on the screen a block is no finer than it is.
    const float off_plane = 1.0 / (0.1 * frame.patches.cell_m + pixel_m);
    vec4 sent = vec4(0.0);
    vec4 turn = vec4(0.0);
    float total = 0.0;
    float close = 0.0;
    float close_light = 0.0;  // times luminance
    float without = 0.0;  // of points that no patch is near
    for (int k = 0; k < 4; ++k) {
        const ivec2 step = ivec2(k & 1, k >> 1);
        const ivec2 block = clamp(ivec2(low) + step, ivec2(0), blocks - 1);
        const float near = (step.x == 1 ? part.x : 1.0 - part.x) *
                           (step.y == 1 ? part.y : 1.0 - part.y);
        int slot = (block.y * blocks.x + block.x) * (PATCH_POINTS * PATCH_POINT_TEXELS);
        uint left = 1u;
        for (uint e = 0u; e < left; ++e) {
            const uvec4 a = texelFetch(patch_point_texels, slot);
            const uvec4 b = texelFetch(patch_point_texels, slot + 1);
            slot += PATCH_POINT_TEXELS;
            left = b.w & 255u;
            if (left == 0u) continue;
            const vec3 n = plane_normal(a.z);
            const float away =
                abs(dot(n, from_camera) - uintBitsToFloat(a.w)) * off_plane;
            const float facing = clamp(dot(n, geometry), 0.0, 1.0);
            // One plane may go on behind what stands on it.
            const float slant = max(abs(dot(n, v)), 0.05);
            const float apart = abs(view_m - uintBitsToFloat(b.z)) * slant /
                                (4.0 * float(PATCH_BLOCK) * pixel_m + 0.1 * frame.patches.cell_m);
            const float fits = max(1.0 - away, 0.0) * facing * facing * max(1.0 - apart, 0.0);
            // What no point fits takes the least wrong one.
            const float weight =
                near * (fits * fits + 1.0e-4 * (0.1 + facing) / (1.0 + away + apart));
            const vec4 found = vec4(unpackHalf2x16(a.x), unpackHalf2x16(a.y));
            if (found.w < 0.0) {
                without += weight;
                continue;
            }
            sent += found * weight;
            close += float(b.w >> 8 & 4095u) * weight;
            close_light += float(b.w >> 20) * weight * dot(found.rgb, vec3(0.2126, 0.7152, 0.0722));
            turn += vec4(unpackHalf2x16(b.x), unpackHalf2x16(b.y)) * weight;
            total += weight;
        }
    }
    // Far ground behind a near thing is lit by the sky, not as that thing is.
    if (total <= without) return SpreadLight(vec3(0.0), -1.0, 0.0, 0.0);
    close_light /= 4095.0 * max(dot(sent.rgb, vec3(0.2126, 0.7152, 0.0722)), 1.0e-20);
    sent /= total;
    const float turned = clamp(dot(turn.xyz / total, bent) + turn.w / total, 0.2, 2.0);
    return SpreadLight(min(sent.rgb * turned, vec3(60000.0)), sent.a, close / (4095.0 * total),
                       min(close_light, 1.0));
}

#endif
