// A pixel of the picture: the mean of its samples as halves, and as the display shows it. The display alone sees
// through the lens: its drops, glare, white balance, exposure, tone curve. Before the include:
//   RESOLVE_DRAWN   by a fragment of a CPU: the sum of the samples is read as rows of its image, numbers of the frame come
//                   with the vertices, since each word of a uniform block is gathered lane by lane
#ifndef PETRICHOR_RESOLVE_GLSL
#define PETRICHOR_RESOLVE_GLSL

#include "formulas/codec/half.h"
#include "formulas/color/tone_map.h"
#include "formulas/color/white_balance.h"
#include "formulas/light/wet_lens.h"
#include "gpu/frame/frame_io.h"
#include "gpu/passes/resolve/resolve_io.h"
layout(constant_id = RESOLVE_SPEC_FILTERS) const uint FILTERS = 0u;
#include "gpu/passes/glare/glare.glsl"
#include "gpu/passes/sky/sky_light_io.h"
#include "formulas/noise/noise.h"

layout(constant_id = RESOLVE_SPEC_TONE_MAP) const int TONE_MAP = TONE_MAP_FILMIC;
layout(constant_id = RESOLVE_SPEC_BLOOM) const uint BLOOM = 0u;
layout(constant_id = RESOLVE_SPEC_WET_LENS) const uint WET_LENS = 0u;
#ifdef RESOLVE_DRAWN
#include "gpu/passes/resolve/resolve_frame.glsl"
ResolveFrame frame;
float exposure;
layout(binding = RESOLVE_ACCUMULATED) uniform samplerBuffer accumulated;
#else
layout(binding = RESOLVE_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = RESOLVE_SKY_LIGHT, scalar) uniform Sky { SkyLight sky_light; };
#define exposure sky_light.exposure
layout(binding = RESOLVE_ACCUMULATED, rgba32f) uniform readonly image2D accumulated;
#endif
layout(binding = RESOLVE_GLARE) uniform sampler2D glare;

vec4 sum_of_samples(ivec2 texel)
{
#ifdef RESOLVE_DRAWN
    return texelFetch(accumulated, texel.y * frame.size.x + texel.x);
#else
    return imageLoad(accumulated, texel);
#endif
}

// The picture's light through a drop, blurred as what is far out of focus is: the mean of a disc.
vec3 through_drop(ivec2 texel, LensDrop drop)
{
    const vec2 size = vec2(frame.size);
    const vec2 middle = vec2(texel) + 0.5 + drop.shift * vec2(1.0, -1.0) * size.y;
    const float radius = 0.02 * size.y;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 16; ++i) {
        const float turn = 2.39996323 * float(i);
        vec2 at = middle + radius * sqrt((float(i) + 0.5) / 16.0) * vec2(cos(turn), sin(turn));
        at = size - abs(mod(at, 2.0 * size) - size);  // beyond the picture: its mirror image
        const ivec2 there = clamp(ivec2(floor(at)), ivec2(0), frame.size - 1);
        sum += sum_of_samples(there).rgb;
    }
    return sum * (drop.bright / (16.0 * frame.samples));
}

uvec2 beauty_of(vec4 mean)
{
    const vec3 kept = min(mean.rgb, vec3(65504.0));  // a half has no more
    return uvec2(half_codes(kept.r, kept.g), half_codes(kept.b, mean.a));
}

// Behind lens and exposure.
vec3 exposed_light(vec4 mean, ivec2 texel)
{
    vec3 seen = mean.rgb;
    if (WET_LENS != 0u && frame.wet_lens > 0.0) {
        const vec2 p = (vec2(texel) + 0.5 - 0.5 * vec2(frame.size)) / float(frame.size.y);
        const LensDrop drop = lens_drops(vec2(p.x, -p.y), frame.wet_lens, frame.time_s);
        if (drop.cover > 0.0) seen = mix(seen, through_drop(texel, drop), drop.cover);
    }
    if (BLOOM != 0u) seen = mix(seen, glare_between(glare, texel).rgb, frame.bloom);
    if ((frame.flags & FRAME_WHITE_BALANCE) != 0u) {
        seen = max(white_balanced(seen, frame.white_gains), vec3(0.0));
    }
    return seen * exposure;
}

// Four bytes.
uint display_of(vec3 exposed, ivec2 texel)
{
    // Codes are shown as they are.
    const bool gamma = (frame.flags & FRAME_GAMMA) != 0u;
    const vec3 mapped = display_light(TONE_MAP, exposed);
    const vec3 encoded =
        gamma ? clamp(exposed, vec3(0.0), vec3(1.0))
              : vec3(srgb_encode(mapped.r), srgb_encode(mapped.g), srgb_encode(mapped.b));
    // Half a step of dither hides banding in soft gradients such as the sky.
    const float noise = (frame.flags & FRAME_DITHER) != 0u ? dither(texel, 0u) - 0.5 : 0.0;
    const uvec3 bytes = uvec3(clamp(encoded * 255.0 + 0.5 + noise, vec3(0.0), vec3(255.0)));
    return bytes.r | (bytes.g << 8) | (bytes.b << 16) | 0xff000000u;
}

#endif
