#version 460
// Packs the linear picture as halves and the display picture as sRGB bytes, or as light for a curve of the host.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/resolve/resolve.glsl"

layout(local_size_x = RESOLVE_TILE, local_size_y = RESOLVE_TILE) in;
layout(constant_id = RESOLVE_SPEC_EXPOSED_LIGHT) const uint EXPOSED_LIGHT = 0u;
layout(binding = RESOLVE_BEAUTY, scalar) writeonly buffer Beauty { uvec2 beauty[]; };
layout(binding = RESOLVE_DISPLAY, scalar) writeonly buffer Display { uint display[]; };

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    const vec4 mean = sum_of_samples(texel) / frame.samples;
    const int index = texel.y * frame.size.x + texel.x;
    beauty[index] = beauty_of(mean);
    const vec3 exposed = exposed_light(mean, texel);
    if (EXPOSED_LIGHT != 0u) {  // the host has a curve of its own
        const vec3 light = min(exposed, vec3(65504.0));
        display[2 * index] = half_codes(light.r, light.g);
        display[2 * index + 1] = half_codes(light.b, 1.0);
        return;
    }
    display[index] = display_of(exposed, texel);
}
