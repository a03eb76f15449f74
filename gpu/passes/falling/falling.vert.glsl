#version 460
// A streak or flake as a rectangle along its way.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/falling.h"
#include "gpu/frame/frame_io.h"
#include "gpu/passes/falling/falling_io.h"

layout(binding = FALLING_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = FALLING_LIGHT) uniform samplerBuffer lit;
layout(binding = FALLING_DROPS) uniform samplerBuffer drops;

layout(location = 0) noperspective out vec2 at_px;  // along the way from its middle, across it
layout(location = 1) flat out vec4 shape;           // half the way, half the width, opacity, flake
layout(location = 2) flat out vec4 light;           // radiance; distance along the view axis

layout(location = 3) flat out vec4 lens;            // near and far plane, samples, 1 where rays are parallel

const vec2 kCorners[4] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1));

void main()
{
    const int drop = gl_VertexIndex / 4;
    const vec2 corner = kCorners[gl_VertexIndex - 4 * drop];
    const vec4 way = texelFetch(drops, drop * FALLING_TEXELS);
    shape = texelFetch(drops, drop * FALLING_TEXELS + 1);
    const vec4 sent = texelFetch(lit, drop);
    const float view_m = shape.x;
    const float half_px = shape.y;
    const bool flake = shape.w > 0.5;

    const vec2 whole = way.zw - way.xy;
    const float length_px = length(whole);
    const vec2 along = length_px > 1.0e-3 ? whole / length_px : vec2(0.0, 1.0);
    const vec2 across = vec2(-along.y, along.x);
    const float half_way = 0.5 * length_px;
    const float wide_px =
        flake ? half_px / (1.0 - 1.42 * flake_raggedness(half_way, half_px)) : half_px;
    at_px = corner * vec2(half_way + wide_px, wide_px);
    const vec2 pixel = 0.5 * (way.xy + way.zw) + along * at_px.x + across * at_px.y;
    gl_Position = vec4(pixel / vec2(frame.size) * 2.0 - 1.0, 0.5, 1.0);
    shape.x = half_way;

    light = vec4(sent.rgb, view_m);
    lens = vec4(frame.near_m, frame.far_m, frame.samples, (frame.flags & FRAME_ORTHOGRAPHIC) != 0u ? 1.0 : 0.0);
    if (sent.w == 0.0) gl_Position = vec4(2.0, 2.0, 0.5, 1.0);  // a roof keeps it off
}
