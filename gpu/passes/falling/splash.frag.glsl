#version 460
// A crown from the side: its wall is thickest in sight at the rim of its outline, and thins out upwards.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/falling/falling_io.h"

layout(binding = FALLING_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = FALLING_DEPTH) uniform sampler2D depth_map;

layout(location = 0) noperspective in vec2 at;
layout(location = 1) flat in vec4 light;
layout(location = 2) flat in float opacity;
layout(location = 0) out vec4 color;

void main()
{
    const float depth = texelFetch(depth_map, ivec2(gl_FragCoord.xy), 0).r;
    const float behind_m = linear_depth(frame, depth) - light.w;
    const float rim = at.x * at.x;
    const float shown = (0.4 + 0.6 * rim) * (1.0 - rim * rim * rim) * (1.0 - at.y) * 1.6;
    const float alpha = clamp(opacity * shown, 0.0, 1.0) * clamp(behind_m / 0.02 + 2.0, 0.0, 1.0);
    color = vec4(light.rgb * (alpha * frame.samples), alpha);
}
