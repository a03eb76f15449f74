// A point of a marched shape (passes/shapes), from its depth and its normal. It has no texture coordinates of its
// own: each of the six sides of its box lays the texture over what looks its way, a repeat a metre.
#ifndef PETRICHOR_SHAPE_POINT_GLSL
#define PETRICHOR_SHAPE_POINT_GLSL

#include "formulas/geometry/shapes.h"

vec3 shape_to_world(int draw, vec3 v)
{
    return vec3(dot(row_of(draw, 3).xyz, v), dot(row_of(draw, 4).xyz, v), dot(row_of(draw, 5).xyz, v));
}

// No farther round than edge-on: a normal is that of more than the point that is seen.
vec3 shape_normal_at(int draw, uint code, vec3 view)
{
    const vec3 n = normalize(shape_to_world(draw, octahedral_decode(shape_decode(code).xy)));
    const float away = dot(n, view);
    return away > 0.0 ? normalize(n - away * view) : n;
}

// By how much the normal changes to the pixel beside: that of the one before where the next shows something else.
vec3 shape_normal_step(ivec2 pixel, ivec2 way, int draw, vec3 normal, vec3 view)
{
    for (int i = 0; i < 2; ++i) {
        const ivec2 beside = i == 0 ? pixel + way : pixel - way;
        if (any(lessThan(beside, ivec2(0))) || any(greaterThanEqual(beside, frame.size))) continue;
        const uvec2 id = texelFetch(ids, beside.y * int(params.width) + beside.x).rg;
        if (int(id.x) - 1 == draw) return (shape_normal_at(draw, id.y, view) - normal) * (i == 0 ? 1.0 : -1.0);
    }
    return vec3(0.0);
}

void shape_point(inout SurfaceInput s, int draw, uint code)
{
    const vec2 centre = vec2(s.pixel) + 0.5;
    const vec3 view = pixel_view_direction(frame, centre);
    s.position = pixel_position(frame, centre, max(texelFetch(depth_map, s.pixel, 0).r, 1.0e-9));
    s.normal = shape_normal_at(draw, code, view);
    s.normal_dx = shape_normal_step(s.pixel, ivec2(1, 0), draw, s.normal, view);
    s.normal_dy = shape_normal_step(s.pixel, ivec2(0, 1), draw, s.normal, view);
    s.position_dx = plane_step(s.position, s.normal, centre + vec2(1.0, 0.0));
    s.position_dy = plane_step(s.position, s.normal, centre + vec2(0.0, 1.0));

    // Its axes in the world, of length 1.
    const vec3 axes[3] = vec3[3](normalize(vec3(row_of(draw, 0).x, row_of(draw, 1).x, row_of(draw, 2).x)),
                                 normalize(vec3(row_of(draw, 0).y, row_of(draw, 1).y, row_of(draw, 2).y)),
                                 normalize(vec3(row_of(draw, 0).z, row_of(draw, 1).z, row_of(draw, 2).z)));
    const vec3 own = vec3(dot(s.normal, axes[0]), dot(s.normal, axes[1]), dot(s.normal, axes[2]));
    const vec3 size = abs(own);
    vec3 right = axes[0];
    vec3 up = own.y < 0.0 ? axes[2] : -axes[2];
    if (size.x > size.y && size.x >= size.z) {
        right = own.x < 0.0 ? axes[2] : -axes[2];
        up = axes[1];
    } else if (size.z > size.y) {
        right = own.z < 0.0 ? -axes[0] : axes[0];
        up = axes[1];
    }
    const vec3 from_middle = s.position - vec3(row_of(draw, 0).w, row_of(draw, 1).w, row_of(draw, 2).w);
    s.tangent = vec4(right, 1.0);
    s.uv = vec2(dot(from_middle, right), -dot(from_middle, up)).xyxy;
    s.uv_dx = vec2(dot(s.position_dx, right), -dot(s.position_dx, up)).xyxy;
    s.uv_dy = vec2(dot(s.position_dy, right), -dot(s.position_dy, up)).xyxy;
    s.color = vec4(1.0);
    s.weather = vec4(1.0);
}

#endif
