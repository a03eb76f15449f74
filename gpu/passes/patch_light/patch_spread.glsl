// The light of patches at a pixel, from the points looked up in the four blocks around: those on its
// own surface count. The includer has `frame` and
//
//   usamplerBuffer patch_point_texels   patch_points_io.h
#ifndef PETRICHOR_PATCH_SPREAD_GLSL
#define PETRICHOR_PATCH_SPREAD_GLSL

#include "gpu/passes/patch_light/patch_plane.glsl"

// The pixel that is lit, as its points are weighed.
struct Pixel {
    vec3 from_camera;
    vec3 geometry;
    vec3 v;
    float view_m;
    float off_plane;
    float deep_m;
};

struct SpreadSum {
    vec4 sent;
    vec4 turn;
    float total;
    float close;
    float close_light;  // times luminance
    float without;      // of points that no patch is near
};

// One point of a block; it counts if `there`.
void add_point(inout SpreadSum sum, Pixel p, uvec4 a, uvec4 b, float near, bool there)
{
    const vec3 n = plane_normal(a.z);
    const float away = abs(dot(n, p.from_camera) - uintBitsToFloat(a.w)) * p.off_plane;
    const float facing = clamp(dot(n, p.geometry), 0.0, 1.0);
    // One plane may go on behind what stands on it.
    const float slant = max(abs(dot(n, p.v)), 0.05);
    const float apart = abs(p.view_m - uintBitsToFloat(b.z)) * slant / p.deep_m;
    const float fits = max(1.0 - away, 0.0) * facing * facing * max(1.0 - apart, 0.0);
    // What no point fits takes the least wrong one.
    const float weight = near * (fits * fits + 1.0e-4 * (0.1 + facing) / (1.0 + away + apart));
    const vec4 found = vec4(unpackHalf2x16(a.x), unpackHalf2x16(a.y));
    const vec4 turn = vec4(unpackHalf2x16(b.x), unpackHalf2x16(b.y));
    const float close = float(b.w >> 8 & 4095u);
    const float close_light = float(b.w >> 20) * dot(found.rgb, vec3(0.2126, 0.7152, 0.0722));
    // Chosen, not multiplied: what is not there may be no number.
    const bool lit = there && found.w >= 0.0;
    sum.sent = lit ? sum.sent + found * weight : sum.sent;
    sum.turn = lit ? sum.turn + turn * weight : sum.turn;
    sum.close = lit ? sum.close + close * weight : sum.close;
    sum.close_light = lit ? sum.close_light + close_light * weight : sum.close_light;
    sum.total = lit ? sum.total + weight : sum.total;
    sum.without = there && !lit ? sum.without + weight : sum.without;
}

// Both points of a block.
void add_block(inout SpreadSum sum, Pixel p, ivec2 block, int across, float near)
{
    const int slot = (block.y * across + block.x) * (PATCH_POINTS * PATCH_POINT_TEXELS);
    const uvec4 b = texelFetch(patch_point_texels, slot + 1);
    add_point(sum, p, texelFetch(patch_point_texels, slot), b, near, (b.w & 255u) > 0u);
    add_point(sum, p, texelFetch(patch_point_texels, slot + PATCH_POINT_TEXELS),
              texelFetch(patch_point_texels, slot + PATCH_POINT_TEXELS + 1), near, (b.w & 255u) > 1u);
}

struct SpreadLight {
    vec3 irradiance;    // over pi, for the normal `bent`
    float open;         // share of open directions; < 0: no patch is near
    float close;        // PatchLight::close
    float close_light;  // PatchLight::close_light
    vec3 turn;          // change of it with the normal, over what it is
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
    const Pixel p = Pixel(from_camera, geometry, v, view_m, off_plane,
                          4.0 * float(PATCH_BLOCK) * pixel_m + 0.1 * frame.patches.cell_m);
    // Told out: a CPU's driver leaves loops in loops as they are, which costs more than what is in them.
    SpreadSum sum = SpreadSum(vec4(0.0), vec4(0.0), 0.0, 0.0, 0.0, 0.0);
    const ivec2 last = blocks - 1;
    add_block(sum, p, clamp(ivec2(low), ivec2(0), last), blocks.x, (1.0 - part.x) * (1.0 - part.y));
    add_block(sum, p, clamp(ivec2(low) + ivec2(1, 0), ivec2(0), last), blocks.x, part.x * (1.0 - part.y));
    add_block(sum, p, clamp(ivec2(low) + ivec2(0, 1), ivec2(0), last), blocks.x, (1.0 - part.x) * part.y);
    add_block(sum, p, clamp(ivec2(low) + ivec2(1, 1), ivec2(0), last), blocks.x, part.x * part.y);
    vec4 sent = sum.sent;
    const vec4 turn = sum.turn;
    const float total = sum.total;
    const float without = sum.without;
    const float close = sum.close;
    float close_light = sum.close_light;
    // Far ground behind a near thing is lit by the sky, not as that thing is.
    if (total <= without) return SpreadLight(vec3(0.0), -1.0, 0.0, 0.0, vec3(0.0));
    close_light /= 4095.0 * max(dot(sent.rgb, vec3(0.2126, 0.7152, 0.0722)), 1.0e-20);
    sent /= total;
    const float turned = clamp(dot(turn.xyz / total, bent) + turn.w / total, 0.2, 2.0);
    return SpreadLight(min(sent.rgb * turned, vec3(60000.0)), sent.a, close / (4095.0 * total),
                       min(close_light, 1.0), turn.xyz / (total * turned));
}

#endif
