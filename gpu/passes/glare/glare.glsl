// Twice as fine as the level: four texels around, each kernel's weights sum to one. Where the device filters floats, each pair of
// weights is a place between two texels, and four texels are one look-up.
#ifndef PETRICHOR_GLARE_GLSL
#define PETRICHOR_GLARE_GLSL

vec4 glare_at(sampler2D level, ivec2 texel)
{
    return texelFetch(level, clamp(texel, ivec2(0), textureSize(level, 0) - 1), 0);
}

// What a texel of a picture twice the level's size sees of it.
vec4 glare_between(sampler2D level, ivec2 texel)
{
    if (FILTERS != 0u) return textureLod(level, (vec2(texel) + 0.5) / (2.0 * vec2(textureSize(level, 0))), 0.0);
    const ivec2 near = texel / 2;
    const ivec2 side = (texel & 1) * 2 - 1;
    return (9.0 * glare_at(level, near) + 3.0 * glare_at(level, near + ivec2(side.x, 0)) +
            3.0 * glare_at(level, near + ivec2(0, side.y)) + glare_at(level, near + side)) / 16.0;
}

// What a texel of a picture half the level's size sees of it: (1 3 3 1) / 8 across and down, so that every texel gives a quarter.
vec4 glare_below(sampler2D level, ivec2 texel)
{
    if (FILTERS != 0u) {
        const vec2 size = vec2(textureSize(level, 0));
        const vec2 middle = (2.0 * vec2(texel) + 1.0) / size;
        const vec2 aside = 0.75 / size;
        const vec4 sum = textureLod(level, middle - aside, 0.0) + textureLod(level, middle + vec2(aside.x, -aside.y), 0.0) +
                         textureLod(level, middle + vec2(-aside.x, aside.y), 0.0) + textureLod(level, middle + aside, 0.0);
        return 0.25 * sum;
    }
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 2; ++y) {
        vec4 row = vec4(0.0);
        for (int x = -1; x <= 2; ++x) {
            row += glare_at(level, 2 * texel + ivec2(x, y)) * ((x & 2) == 0 ? 3.0 : 1.0);
        }
        sum += row * ((y & 2) == 0 ? 3.0 : 1.0);
    }
    return sum / 64.0;
}

#endif
