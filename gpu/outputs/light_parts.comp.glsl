#version 460
// One part of the picture as it leaves: the mean of the samples, behind what falls and glows in the air.
// The reflection label leaves as it is.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/outputs/light_parts_io.h"

layout(local_size_x = LIGHT_PARTS_TILE, local_size_y = LIGHT_PARTS_TILE) in;
layout(binding = LIGHT_PARTS_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = LIGHT_PARTS_SUM, rgba32f) uniform readonly image2DArray sum;
layout(binding = LIGHT_PARTS_AIR) uniform sampler2D air;
layout(binding = LIGHT_PARTS_VALUES, scalar) writeonly buffer Values { float values[]; };
layout(push_constant, scalar) uniform Push { LightPartsPush push; };

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const int pixel = texel.y * frame.size.x + texel.x;
    const vec4 held = imageLoad(sum, ivec3(texel, push.layer));
    if (push.layer == REFLECTION_LABEL_LAYER) {
        values[pixel * 2] = push.mirrors != 0 ? held.x : REFLECTS_NOTHING;
        values[pixel * 2 + 1] = push.mirrors != 0 ? held.y : 0.0;
        return;
    }
    const vec4 before = texelFetch(air, texel, 0);
    vec3 part = held.rgb * (1.0 - before.a);
    if (push.layer == PART_VOLUME) part += before.rgb;
    part /= frame.samples;
    for (int i = 0; i < 3; ++i) values[pixel * 3 + i] = part[i];
}
