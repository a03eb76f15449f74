// The ray through a fragment of a shape's box, in the shape's space, and where it meets the shape.
#ifndef PETRICHOR_SHAPE_RAY_GLSL
#define PETRICHOR_SHAPE_RAY_GLSL

#include "formulas/geometry/shapes.h"
#include "gpu/passes/shapes/shapes_io.h"

layout(constant_id = SHAPE_SPEC_KIND) const int KIND = SHAPE_SPHERE;
layout(constant_id = SHAPE_SPEC_FLATTEN) const uint FLATTEN = 0u;

layout(push_constant, scalar) uniform Push { ShapeDraw shape; };
layout(location = 0) in vec3 in_place;

struct ShapePoint {
    bool met;
    vec3 place;
    float footprint;
    float depth;
};

MarchedShape marched_shape()
{
    return MarchedShape(KIND, shape.iterations, shape.power, shape.half_size);
}

ShapePoint meet_shape()
{
    vec3 origin = shape.eye.xyz;
    vec3 along = in_place - origin;
    if (shape.eye.w == 0.0) {
        along = -shape.eye.xyz;
        origin = in_place - along * (2.1 * length(shape.half_size));
    }
    along = normalize(along);
    vec2 ends = through_box(origin, along, shape.half_size);
    ends.x = max(ends.x, 0.0);
    if (FLATTEN == 0u) {
        // Depth above 1 lies before the near plane; along a ray it falls.
        const mat4 m = shape.clip_from_object;
        const vec4 row = vec4(m[0].z - m[0].w, m[1].z - m[1].w, m[2].z - m[2].w, m[3].z - m[3].w);
        const float over = dot(row, vec4(origin, 1.0));
        const float falls = dot(row.xyz, along);
        if (over > 0.0) ends.x = max(ends.x, falls < 0.0 ? -over / falls : 1.0e30);
    }
    ShapePoint p;
    p.met = false;
    if (!(ends.x < ends.y)) return p;
    const float t = shape_met(marched_shape(), origin, along, ends.x, ends.y, shape.footprint);
    p.met = t >= 0.0;
    p.place = origin + along * t;
    p.footprint = shape.footprint.x + shape.footprint.y * t;
    const vec4 clip = shape.clip_from_object * vec4(p.place, 1.0);
    p.depth = min(clip.z / clip.w, 1.0);
    return p;
}

#endif
