#version 460
// The twelve triangles of a decal's box.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/box_corner.glsl"
#include "gpu/frame/frame_io.h"
#include "gpu/passes/decals/decals_io.h"

layout(set = 0, binding = SURFACE_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(push_constant, scalar) uniform Push { DecalBoxDraw draw; };

void main()
{
    const vec4 q = vec4(box_corner(gl_VertexIndex), 1.0);
    const vec3 world = vec3(dot(draw.to_world[0], q), dot(draw.to_world[1], q), dot(draw.to_world[2], q));
    gl_Position = frame.world_to_clip * vec4(world, 1.0);
    // Its far sides are drawn, also beyond what a picture can hold.
    gl_Position.z = clamp(gl_Position.z, 0.0, gl_Position.w);
}
