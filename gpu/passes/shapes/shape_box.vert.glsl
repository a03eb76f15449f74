#version 460
// The far sides of the box around a shape: every pixel that may show it once, also from inside of the box.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/box_corner.glsl"
#include "gpu/passes/shapes/shapes_io.h"

layout(push_constant, scalar) uniform Push { ShapeDraw shape; };
layout(location = 0) out vec3 out_place;

void main()
{
    out_place = 2.0 * box_corner(gl_VertexIndex) * shape.half_size;
    gl_Position = shape.clip_from_object * vec4(out_place, 1.0);
    // They are drawn also beyond what a picture or a map can hold.
    gl_Position.z = clamp(gl_Position.z, 0.0, gl_Position.w);
}
