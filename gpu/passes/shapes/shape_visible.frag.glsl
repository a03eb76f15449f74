#version 460
// Which shape a pixel shows, how deep, and its normal there in its own space, with how open it is
// (passes/surface_resolve shades it).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/codec/octahedral.h"
#include "gpu/passes/shapes/shape_ray.glsl"

layout(location = 0) out uvec2 out_id;

void main()
{
    const ShapePoint p = meet_shape();
    if (!p.met) discard;
    gl_FragDepth = p.depth;
    const vec3 normal = shape_normal(marched_shape(), p.place, p.footprint);
    const float open = shape_open(marched_shape(), p.place, normal, p.footprint);
    out_id = uvec2(shape.draw + 1u, shape_code(octahedral_encode(normal), open));
}
