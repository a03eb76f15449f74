#version 460
// As depth_relief, of many instances at once.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/passes/depth_maps/depth_maps_io.h"

layout(constant_id = DEPTH_SPEC_FLATTEN) const uint FLATTEN = 1u;

layout(location = 0) in vec3 in_position;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;

layout(set = 1, binding = 0) uniform samplerBuffer places;  // columns: before the map, of all; in the world, of all
layout(push_constant, scalar) uniform Push { ReliefRun run; };

layout(location = 0) out vec4 out_uv;
layout(location = 1) out vec3 out_world;
layout(location = 2) flat out vec4 out_eye;

mat4 place(int number)
{
    const int at = 4 * number;
    return mat4(texelFetch(places, at), texelFetch(places, at + 1), texelFetch(places, at + 2), texelFetch(places, at + 3));
}

void main()
{
    const vec4 p = vec4(in_position, 1.0);
    gl_Position = place(gl_InstanceIndex) * p;
    if (FLATTEN != 0u) gl_Position.z = min(gl_Position.z, gl_Position.w);
    out_uv = vec4(in_uv0, in_uv1);
    const mat4 rows = transpose(place(gl_InstanceIndex + int(run.count)));
    out_world = vec3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
    out_eye = run.eye;
}
