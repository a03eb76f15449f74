#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/frame/frame_io.h"
#include "gpu/upload/material_io.h"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
layout(location = 5) in vec4 in_color;
layout(location = 6) in vec4 in_weather;

layout(set = 0, binding = 0, scalar) uniform Frame { FrameConstants frame; };
#include "gpu/passes/surface/surface_place.glsl"
#define VERTEX_LIGHT_PLACE SURFACE_LIT_VERTICES
#define VERTEX_LIGHT_FIRSTS SURFACE_LIT_FIRSTS
#include "gpu/passes/vertex_light/vertex_light.glsl"
layout(constant_id = SURFACE_SPEC_VERTEX_LIGHT) const uint VERTEX_LIGHT = 0u;

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec4 out_uv;
layout(location = 4) out vec4 out_color;
layout(location = 5) out vec4 out_weather;
layout(location = 6) flat out uvec2 out_who;  // instance; its look
layout(location = 7) out vec3 out_lit_front;  // by lamps at vertices
layout(location = 8) out vec3 out_lit_back;

// The depth pre-pass must find the same depth to the last bit.
invariant gl_Position;

void main()
{
    const DrawConstants here = draw_here(gl_InstanceIndex);
    const vec4 p = vec4(in_position, 1.0);
    const vec3 world = vec3(dot(here.to_world[0], p), dot(here.to_world[1], p), dot(here.to_world[2], p));
    out_position = world;
    out_normal = vec3(dot(here.normal_to_world[0].xyz, in_normal),
                      dot(here.normal_to_world[1].xyz, in_normal),
                      dot(here.normal_to_world[2].xyz, in_normal));
    out_tangent.xyz = vec3(dot(here.to_world[0].xyz, in_tangent.xyz),
                           dot(here.to_world[1].xyz, in_tangent.xyz),
                           dot(here.to_world[2].xyz, in_tangent.xyz));
    out_tangent.w = in_tangent.w;
    out_uv = vec4(in_uv0, in_uv1);
    out_color = in_color;
    out_weather = in_weather;
    out_who = uvec2(here.instance_id, here.look);
    out_lit_front = vec3(0.0);
    out_lit_back = vec3(0.0);
    if (VERTEX_LIGHT != 0u) {
        const uvec2 lit = vertex_light_code(gl_InstanceIndex, gl_VertexIndex);
        out_lit_front = shared_exponent_value(lit.x);
        out_lit_back = shared_exponent_value(lit.y);
    }
    gl_Position = frame.world_to_clip * vec4(world, 1.0);
}
