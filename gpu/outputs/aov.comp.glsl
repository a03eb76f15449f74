#version 460
// One labelled output from the G-buffer of the pixel-centre sample.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "gpu/outputs/aov_io.h"

layout(local_size_x = AOV_TILE, local_size_y = AOV_TILE) in;
layout(binding = AOV_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = AOV_DEPTH) uniform sampler2D depth_map;
layout(binding = AOV_COLOR) uniform sampler2D color_map;
layout(binding = AOV_NORMALS) uniform sampler2D normals_map;
layout(binding = AOV_MATERIAL) uniform sampler2D material_map;
layout(binding = AOV_WEATHER) uniform sampler2D weather_map;
layout(binding = AOV_EMISSION) uniform sampler2D emission_map;
layout(binding = AOV_OUTPUT, scalar) writeonly buffer Output { vec4 values[]; };

layout(push_constant, scalar) uniform Push { AovParams params; };

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const float depth = texelFetch(depth_map, texel, 0).r;
    vec4 value = vec4(0.0);
    if (depth > 0.0) {
        const GBufferTexel g =
            decode_gbuffer(texelFetch(color_map, texel, 0), texelFetch(normals_map, texel, 0),
                           texelFetch(material_map, texel, 0),
                           params.has_weather != 0u ? texelFetch(weather_map, texel, 0) : vec4(0.0));
        switch (params.kind) {
            case 0u: value = vec4(linear_depth(frame, depth), 0.0, 0.0, 0.0); break;
            case 1u: value = vec4(pixel_position(frame, vec2(texel) + 0.5, depth), 0.0); break;
            case 2u: value = vec4(g.base_normal, 0.0); break;
            case 3u: value = vec4(g.base_color, 0.0); break;
            case 4u: value = vec4(g.roughness, 0.0, 0.0, 0.0); break;
            case 5u: value = vec4(g.metallic, 0.0, 0.0, 0.0); break;
            case 6u: value = vec4(g.occlusion, 0.0, 0.0, 0.0); break;
            case 7u:
                if (params.has_emission != 0u) value = vec4(texelFetch(emission_map, texel, 0).rgb, 0.0);
                break;
            case 8u: value = vec4(g.weather.x, 0.0, 0.0, 0.0); break;
            case 9u: value = vec4(g.weather.y, 0.0, 0.0, 0.0); break;
            case 10u: value = vec4(g.weather.z, 0.0, 0.0, 0.0); break;
            case 11u: value = vec4(g.weather.w, 0.0, 0.0, 0.0); break;
            case 12u: value = vec4(g.cover_normal, 0.0); break;
        }
    } else if (params.kind == 0u) {
        value = vec4(uintBitsToFloat(0x7f800000u), 0.0, 0.0, 0.0);
    }
    values[texel.y * frame.size.x + texel.x] = value;
}
