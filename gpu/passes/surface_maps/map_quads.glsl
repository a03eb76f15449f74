// Tileable maps as texels of a buffer, four neighbours in each (map_quads.comp.glsl).
#ifndef PETRICHOR_MAP_QUADS_GLSL
#define PETRICHOR_MAP_QUADS_GLSL

// Maps have 2^bits texels a side. A level of s texels a side lies from s * s on, so the next one ends before it.
int quads_place(int bits, int level, ivec2 texel)
{
    const int side = 1 << (bits - level);
    return ((side + texel.y) << (bits - level)) + texel.x;
}

// Red and green of a map, linear between the texels of one level.
vec2 quad_texel(usamplerBuffer quads, int bits, vec2 uv, int level)
{
    const int side = 1 << (bits - level);
    const vec2 p = fract(uv) * float(side) - 0.5;
    const vec2 low = floor(p);
    const vec2 share = p - low;
    // Left of the first texel is the last one.
    const ivec2 texel = ivec2(low) & (side - 1);
    const uvec2 quad = texelFetch(quads, quads_place(bits, level, texel)).rg;
    const vec4 above = vec4(uvec4(quad.x, quad.x >> 8, quad.x >> 16, quad.x >> 24) & 255u);
    const vec4 below = vec4(uvec4(quad.y, quad.y >> 8, quad.y >> 16, quad.y >> 24) & 255u);
    const vec4 rows = above + (below - above) * share.y;
    return (rows.xy + (rows.zw - rows.xy) * share.x) * (1.0 / 255.0);
}

// The level whose texels are nearest to as far apart as steps of the picture; dx, dy: in texels of the first. Half the
// logarithm of their square, rounded, is half the exponent of twice the square. Below 0 where they lie closer.
int whole_level(vec2 dx, vec2 dy)
{
    return ((floatBitsToInt(max(dot(dx, dx), dot(dy, dy)) * 2.0) >> 23) - 127) >> 1;
}

// dx, dy: repeats of a map of 2^bits texels a side.
int quad_level(int bits, vec2 dx, vec2 dy)
{
    const float texels = float(1 << bits);
    return clamp(whole_level(dx * texels, dy * texels), 0, bits);
}

#endif
