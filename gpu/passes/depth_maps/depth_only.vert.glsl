#version 460
// Depth of the scene seen from the sun (shadow cascades) or along the falling rain (shelter).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "base/interop.h"
#include "gpu/passes/depth_maps/depth_maps_io.h"

layout(constant_id = DEPTH_SPEC_FLATTEN) const uint FLATTEN = 1u;

layout(location = 0) in vec3 in_position;

struct DepthDraw {
    mat4 clip_from_object;
};
layout(push_constant, scalar) uniform Push { DepthDraw draw; };

void main()
{
    gl_Position = draw.clip_from_object * vec4(in_position, 1.0);
    if (FLATTEN != 0u) gl_Position.z = min(gl_Position.z, gl_Position.w);
}
