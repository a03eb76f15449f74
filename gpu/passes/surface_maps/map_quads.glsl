// Tileable maps as texels of a buffer, four neighbours in each (map_quads.comp.glsl).
#ifndef PETRICHOR_MAP_QUADS_GLSL
#define PETRICHOR_MAP_QUADS_GLSL

// The first level lies at the left, the others one below the other beside it.
int quads_pitch(int size)
{
    return size + max(size / 2, 1);
}

ivec2 quads_corner(int size, int level)
{
    return level == 0 ? ivec2(0) : ivec2(size, size - (size >> (level - 1)));
}

// Red and green of a map of `size` texels a side, linear between the texels of one level.
vec2 quad_texel(usamplerBuffer quads, int size, vec2 uv, int level)
{
    const int side = max(size >> level, 1);
    const vec2 p = fract(uv) * float(side) - 0.5;
    const vec2 low = floor(p);
    const vec2 share = p - low;
    // Left of the first texel is the last one. A coordinate that rounds up to 1 reads the last, too.
    const ivec2 texel = ivec2(low) + ivec2(low.x < 0.0 ? side : 0, low.y < 0.0 ? side : 0);
    const ivec2 place = quads_corner(size, level) + texel;
    const uvec2 quad = texelFetch(quads, place.y * quads_pitch(size) + place.x).rg;
    const vec4 above = vec4(uvec4(quad.x, quad.x >> 8, quad.x >> 16, quad.x >> 24) & 255u);
    const vec4 below = vec4(uvec4(quad.y, quad.y >> 8, quad.y >> 16, quad.y >> 24) & 255u);
    const vec4 rows = above + (below - above) * share.y;
    return (rows.xy + (rows.zw - rows.xy) * share.x) * (1.0 / 255.0);
}

// The level whose texels are nearest to as far apart as steps of the picture; dx, dy: repeats of the map.
int quad_level(int size, vec2 dx, vec2 dy)
{
    const float texels = float(size);
    const float level = 0.5 * log2(max(dot(dx, dx), dot(dy, dy)) * texels * texels + 1.0e-12);
    return clamp(int(level + 0.5), 0, findMSB(size));
}

#endif
