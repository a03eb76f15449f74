// The sky's light from the quads of its maps (formulas/light/cube_quads.h). The includer has
//
//   usamplerBuffer sky_quads   SkyMaps::quads
#ifndef PETRICHOR_SKY_QUADS_GLSL
#define PETRICHOR_SKY_QUADS_GLSL

#include "formulas/light/cube_quads.h"
#include "gpu/frame/sky_quads_io.h"

// Linear between the texels of a level.
vec3 quad_light(CubePlace place, int begin, int side)
{
    // Quads lie between texels: the first one left of the first texel.
    const vec2 p = (place.st * 0.5 + 0.5) * float(side) + 0.5;
    const vec2 low = floor(p);
    const vec2 share = p - low;
    const uvec4 quad = texelFetch(sky_quads, cube_quad(begin, side, place.face, ivec2(low)));
    const vec2 rest = 1.0 - share;
    return light_of_word(quad.x, rest.x * rest.y) + light_of_word(quad.y, share.x * rest.y) +
           light_of_word(quad.z, rest.x * share.y) + light_of_word(quad.w, share.x * share.y);
}

// The sky as a lobe of a roughness sees it; level: 0 a mirror's .. SKY_PREFILTER_MIPS - 1.
vec3 sky_lobe(vec3 direction, float level)
{
    const CubePlace place = cube_place(direction);
    const float held = clamp(level, 0.0, float(SKY_PREFILTER_MIPS - 1));
    const int finer = int(held);
    const int coarser = min(finer + 1, SKY_PREFILTER_MIPS - 1);
    const int finer_log2 = SKY_SPECULAR_LOG2 - finer;
    const int coarser_log2 = SKY_SPECULAR_LOG2 - coarser;
    const vec3 a = quad_light(place, cube_quads_begin(finer_log2), 1 << finer_log2);
    const vec3 b = quad_light(place, cube_quads_begin(coarser_log2), 1 << coarser_log2);
    return a + (b - a) * (held - float(finer));
}

// Its blurred light, that of the air before a view.
vec3 sky_veil(vec3 direction)
{
    return quad_light(cube_place(direction), SKY_AIR_QUADS, SKY_AIR_SIDE);
}

#endif
