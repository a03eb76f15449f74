#version 460
// How much of a pixel a streak or flake hides.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/weather/falling.h"
#include "gpu/passes/falling/falling_io.h"

layout(binding = FALLING_DEPTH) uniform sampler2D depth_map;

layout(location = 0) noperspective in vec2 at_px;
layout(location = 1) flat in vec4 shape;
layout(location = 2) flat in vec4 light;
layout(location = 3) flat in vec4 lens;  // of the frame: a CPU reads each word of a uniform block lane by lane
layout(location = 0) out vec4 color;

const float kSoft_m = 0.12;  // it fades into what is so close behind it

void main()
{
    float radius = shape.y;
    if (shape.w > 0.5) {
        const vec2 from_way = vec2(at_px.x - clamp(at_px.x, -shape.x, shape.x), at_px.y);
        const vec2 d = from_way / max(length(from_way), 1.0e-4);
        const float turn = 6.2831853 * shape.w;
        const float three = d.x * (4.0 * d.x * d.x - 3.0);
        const float two = 2.0 * d.x * d.y;
        radius /= 1.0 + flake_raggedness(shape.x, shape.y) * (three * cos(turn) + two * sin(turn));
    }
    const float cover = streak_cover(at_px.x, at_px.y, shape.x, radius);
    const float depth = texelFetch(depth_map, ivec2(gl_FragCoord.xy), 0).r;
    const float behind_m = (lens.w > 0.5 ? (1.0 - depth) * lens.y : lens.x / max(depth, 1.0e-9)) - light.w;
    const float alpha = min(shape.z * cover, 1.0) *
                        clamp(behind_m / kSoft_m, 0.0, 1.0);
    color = vec4(light.rgb * (alpha * lens.z), alpha);
}
