#version 460
// As depth_masked, for holes in a relief.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/depth_maps/depth_maps_io.h"

layout(constant_id = DEPTH_SPEC_FLATTEN) const uint FLATTEN = 1u;

layout(location = 0) in vec3 in_position;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;

layout(push_constant, scalar) uniform Push { ReliefDraw draw; };

layout(location = 0) out vec4 out_uv;
layout(location = 1) out vec3 out_world;
layout(location = 2) flat out vec4 out_eye;

void main()
{
    const vec4 p = vec4(in_position, 1.0);
    gl_Position = draw.clip_from_object * p;
    if (FLATTEN != 0u) gl_Position.z = min(gl_Position.z, gl_Position.w);
    out_uv = vec4(in_uv0, in_uv1);
    out_world = vec3(dot(draw.to_world[0], p), dot(draw.to_world[1], p), dot(draw.to_world[2], p));
    out_eye = draw.eye;
}
