#version 460
// How much of the sky's light nearby geometry takes away: taps on a disc around the pixel, weighed by
// the height of what they find above the surface (McGuire et al. 2011). Each sample of the frame turns
// the disc, so that the average is smooth.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/gbuffer.glsl"
#include "formulas/noise/noise.h"
#include "gpu/passes/ambient_occlusion/ambient_occlusion_io.h"
#define PIXEL_LIST_BINDING AMBIENT_OCCLUSION_PIXELS
#include "gpu/frame/pixel_list.glsl"

layout(local_size_x = AMBIENT_OCCLUSION_TILE, local_size_y = AMBIENT_OCCLUSION_TILE) in;
layout(binding = AMBIENT_OCCLUSION_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = AMBIENT_OCCLUSION_DEPTH) uniform sampler2D depth_map;
layout(binding = AMBIENT_OCCLUSION_NORMALS) uniform sampler2D normal_map;
layout(binding = AMBIENT_OCCLUSION_TARGET, r8) uniform writeonly image2D target;

const int kTaps = 8;

void main()
{
    ivec2 texel;
    if (!this_pixel(frame.size, texel)) return;
    const float depth = texelFetch(depth_map, texel, 0).r;
    if (depth <= 0.0) {
        imageStore(target, texel, vec4(1.0));
        return;
    }
    const vec3 position = pixel_position(frame, vec2(texel) + 0.5, depth);
    const vec3 normal = octahedral_decode(texelFetch(normal_map, texel, 0).xy);
    const float z = linear_depth(frame, depth);
    const float metres_per_pixel = pixel_width_m(frame, z);
    const float radius_px = clamp(frame.ao_radius_m / max(metres_per_pixel, 1.0e-6), 3.0, 96.0);
    const float radius_m = radius_px * metres_per_pixel;
    const float turn = 6.2831853 * dither(texel, frame.sample_index);
    const float start = dither(texel.yx + 37, frame.sample_index);

    float sum = 0.0;
    for (int i = 0; i < kTaps; ++i) {
        const float r = (float(i) + start) / float(kTaps);
        const float angle = turn + 2.3999632 * float(i);
        const vec2 offset = vec2(cos(angle), sin(angle)) * (r * radius_px);
        const ivec2 at = clamp(texel + ivec2(round(offset)), ivec2(0), frame.size - 1);
        const float d = texelFetch(depth_map, at, 0).r;
        if (d <= 0.0 || at == texel) continue;
        const vec3 v = pixel_position(frame, vec2(at) + 0.5, d) - position;
        const float vv = dot(v, v);
        const float vn = dot(v, normal) - 0.0015 * z;
        const float falloff = max(0.0, 1.0 - vv / (radius_m * radius_m));
        sum += falloff * max(vn, 0.0) * inversesqrt(vv + 1.0e-6);
    }
    const float open = clamp(1.0 - frame.ao_strength * sum * (2.0 / float(kTaps)), 0.0, 1.0);
    imageStore(target, texel, vec4(open));
}
