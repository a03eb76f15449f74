#version 460
// The twelve triangles of a decal's box.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/passes/decals/decals_io.h"

layout(set = 0, binding = SURFACE_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(push_constant, scalar) uniform Push { DecalBoxDraw draw; };

void main()
{
    // A face by its axis and side, two triangles each, counter-clockwise from outside.
    const int corners[6] = int[6](0, 1, 2, 0, 2, 3);
    const int face = gl_VertexIndex / 6;
    const int corner = corners[gl_VertexIndex % 6];
    const int axis = face >> 1;
    const float side = (face & 1) != 0 ? 0.5 : -0.5;
    const vec2 across = vec2(corner == 1 || corner == 2 ? 0.5 : -0.5, corner >= 2 ? 0.5 : -0.5);
    vec3 p;
    p[axis] = side;
    p[(axis + 1) % 3] = side > 0.0 ? across.x : across.y;
    p[(axis + 2) % 3] = side > 0.0 ? across.y : across.x;
    const vec4 q = vec4(p, 1.0);
    const vec3 world = vec3(dot(draw.to_world[0], q), dot(draw.to_world[1], q), dot(draw.to_world[2], q));
    gl_Position = frame.world_to_clip * vec4(world, 1.0);
    // Its far sides are drawn, also beyond what a picture can hold.
    gl_Position.z = clamp(gl_Position.z, 0.0, gl_Position.w);
}
