#version 460
// The same bits drawn into images: a CPU stores the pixels of a draw as vectors, those of a compute shader word by word.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define RESOLVE_DRAWN
#include "gpu/passes/resolve/resolve.glsl"

RESOLVE_FRAME_WORDS(in)
layout(location = 0) out uvec2 beauty;
layout(location = 1) out uint display;

void main()
{
    frame = ResolveFrame(size_flags.xy, uint(size_flags.z), lens.x, lens.y, lens.z, lens.w, gains_exposure.xyz);
    exposure = gains_exposure.w;
    const ivec2 texel = ivec2(gl_FragCoord.xy);
    const vec4 mean = sum_of_samples(texel) / frame.samples;
    beauty = beauty_of(mean);
    display = display_of(exposed_light(mean, texel), texel);
}
