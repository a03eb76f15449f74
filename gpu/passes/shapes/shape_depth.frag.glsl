#version 460
// The depth of a shape in a map of the sun, a lamp, the sky or the falling rain.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/shapes/shape_ray.glsl"

void main()
{
    const ShapePoint p = meet_shape();
    if (!p.met) discard;
    gl_FragDepth = p.depth;
}
