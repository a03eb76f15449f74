// Twice as fine as the level: four texels around, each kernel's weights sum to one.
#ifndef PETRICHOR_GLARE_GLSL
#define PETRICHOR_GLARE_GLSL

vec4 glare_at(sampler2D level, ivec2 texel)
{
    return texelFetch(level, clamp(texel, ivec2(0), textureSize(level, 0) - 1), 0);
}

// What a texel of a picture twice the level's size sees of it.
vec4 glare_between(sampler2D level, ivec2 texel)
{
    const ivec2 near = texel / 2;
    const ivec2 side = (texel & 1) * 2 - 1;
    return (9.0 * glare_at(level, near) + 3.0 * glare_at(level, near + ivec2(side.x, 0)) +
            3.0 * glare_at(level, near + ivec2(0, side.y)) + glare_at(level, near + side)) / 16.0;
}

#endif
