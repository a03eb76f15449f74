#version 460
// Depth of the surface pass ahead of it: the same position to the last bit, nothing else.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/upload/material_io.h"

layout(location = 0) in vec3 in_position;

layout(set = 0, binding = 0, scalar) uniform Frame { FrameConstants frame; };
#include "gpu/passes/surface/surface_place.glsl"

invariant gl_Position;

void main()
{
    const DrawConstants here = draw_here(gl_InstanceIndex);
    const vec4 p = vec4(in_position, 1.0);
    const vec3 world = vec3(dot(here.to_world[0], p), dot(here.to_world[1], p), dot(here.to_world[2], p));
    gl_Position = frame.world_to_clip * vec4(world, 1.0);
}
