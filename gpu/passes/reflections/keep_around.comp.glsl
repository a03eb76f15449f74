#version 460
// Depth, light and glow of a small picture, for windows of the large one.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "gpu/passes/reflections/keep_around_io.h"

layout(local_size_x = KEEP_AROUND_TILE, local_size_y = KEEP_AROUND_TILE) in;
layout(binding = KEEP_AROUND_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = KEEP_AROUND_DEPTH) uniform samplerBuffer depth_rows;
layout(binding = KEEP_AROUND_RADIANCE) uniform sampler2D radiance_map;
layout(binding = KEEP_AROUND_EMISSION) uniform samplerBuffer emission_rows;
layout(binding = KEEP_AROUND_TO_DEPTH, scalar) writeonly buffer ToDepth { float to_depth[]; };
layout(binding = KEEP_AROUND_TO_LIGHT, scalar) writeonly buffer ToLight { uvec2 to_light[]; };
layout(binding = KEEP_AROUND_TO_GLOW, scalar) writeonly buffer ToGlow { uvec2 to_glow[]; };
layout(constant_id = KEEP_AROUND_SPEC_GLOWS) const uint GLOWS = 0;

uvec2 halves(vec3 light)
{
    return uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, 0.0)));
}

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const int at = row_texel(texel, frame.size);
    to_depth[at] = texelFetch(depth_rows, at).r;
    to_light[at] = halves(texelFetch(radiance_map, texel, 0).rgb);
    to_glow[at] = GLOWS != 0u ? halves(texelFetch(emission_rows, at).rgb) : uvec2(0u);
}
