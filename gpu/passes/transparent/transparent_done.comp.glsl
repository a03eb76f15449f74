#version 460
// All layers before the solid picture of this sample, added to the sum of the samples.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/outputs/light_parts_io.h"
#include "gpu/passes/transparent/transparent_io.h"

layout(local_size_x = TRANSPARENT_TILE, local_size_y = TRANSPARENT_TILE) in;
layout(binding = TRANSPARENT_DONE_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = TRANSPARENT_DONE_SOLID) uniform sampler2D solid_map;
layout(binding = TRANSPARENT_DONE_FRONT) uniform sampler2D front;
layout(binding = TRANSPARENT_DONE_LEFT) uniform sampler2D left;
layout(binding = TRANSPARENT_DONE_ACCUMULATED, rgba32f) uniform image2D accumulated;
layout(constant_id = TRANSPARENT_DONE_SPEC_SPLIT) const uint SPLIT = 0u;
layout(constant_id = TRANSPARENT_DONE_SPEC_BEHIND) const uint BEHIND = 0u;
layout(binding = TRANSPARENT_DONE_CHANGE) uniform sampler2D change;
layout(binding = TRANSPARENT_DONE_SOLID_PARTS, rgba32f) uniform readonly image2DArray solid_parts;
layout(binding = TRANSPARENT_DONE_FRONT_PARTS, rgba32f) uniform readonly image2DArray front_parts;
layout(binding = TRANSPARENT_DONE_PARTS, rgba32f) uniform image2DArray light_parts;

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const vec4 solid = texelFetch(solid_map, texel, 0);
    const vec4 layers = texelFetch(front, texel, 0);
    vec4 result = vec4(layers.rgb + texelFetch(left, texel, 0).rgb * solid.rgb,
                       max(solid.a, layers.a));
    if (BEHIND != 0u) result.rgb += texelFetch(change, texel, 0).rgb;
    if (SPLIT != 0u) {
        // Behind a layer all of it is what comes through.
        const bool covered = layers.a > 0.0;
        const vec3 through = covered ? texelFetch(left, texel, 0).rgb * solid.rgb : vec3(0.0);
        for (int i = 0; i < LIGHT_PARTS; ++i) {
            const ivec3 at = ivec3(texel, i);
            vec4 part = imageLoad(front_parts, at);
            if (!covered) part = imageLoad(solid_parts, at);
            if (i == PART_TRANSMISSION) part.rgb += through;
            if (frame.sample_index > 0u) part += imageLoad(light_parts, at);
            imageStore(light_parts, at, part);
        }
    }
    if (frame.sample_index > 0u) result += imageLoad(accumulated, texel);
    imageStore(accumulated, texel, result);
}
