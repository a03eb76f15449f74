// The normal of the mesh at a pixel, of the depths around it. Before the include: frame and depth_rows.
#ifndef PETRICHOR_GEOMETRY_NORMAL_GLSL
#define PETRICHOR_GEOMETRY_NORMAL_GLSL

float depth_at(ivec2 texel)
{
    const ivec2 at = clamp(texel, ivec2(0), frame.size - 1);
    return texelFetch(depth_rows, at.y * frame.size.x + at.x).r;
}

vec3 position_at(ivec2 texel, float depth)
{
    return pixel_position(frame, vec2(texel) + 0.5, depth);
}

// The way to the neighbour along an axis that is nearer in depth.
vec3 along_surface(ivec2 texel, vec3 x, float depth, ivec2 step)
{
    const float after = depth_at(texel + step);
    const float before = depth_at(texel - step);
    const bool forth = abs(after - depth) < abs(before - depth);
    const vec3 other = position_at(forth ? texel + step : texel - step,
                                   max(forth ? after : before, 1.0e-9));
    return forth ? other - x : x - other;
}

// The normal of the geometry, by the depths around; `mapped`, that of the normal map, where the surface is too
// small for them.
vec3 geometry_normal(ivec2 texel, vec3 x, float depth, vec3 mapped)
{
    const vec3 across = cross(along_surface(texel, x, depth, ivec2(0, 1)),
                              along_surface(texel, x, depth, ivec2(1, 0)));
    const float size = dot(across, across);
    if (!(size > 0.0)) return mapped;
    vec3 n = across * inversesqrt(size);
    if (dot(n, mapped) < 0.0) n = -n;
    return dot(n, mapped) > 0.6 ? n : mapped;
}

#endif
