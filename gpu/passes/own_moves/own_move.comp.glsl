#version 460
// Where NAME_move of users' own surfaces takes the vertices of what shows them. Compiled with their texts alone
// (gpu/surface/own_surfaces.h): OWN_MOVES has a row for each that moves.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SURFACE_WEATHER 0
#define SURFACE_EMISSION 0
#define SURFACE_BAKED 0
#include "gpu/passes/own_moves/own_move_io.h"
#include "gpu/passes/surface/evaluate_surface.glsl"

layout(local_size_x = OWN_MOVE_GROUP) in;
layout(set = 0, binding = OWN_MOVE_VERTICES) uniform usamplerBuffer vertices;
layout(set = 0, binding = OWN_MOVE_POINTS) uniform samplerBuffer points;
layout(set = 0, binding = OWN_MOVE_MOVED, scalar) writeonly buffer Moved { MovedVertex moved[]; };
layout(push_constant, scalar) uniform Push { OwnMoveParams params; };

vec3 moved_by(MoveInput at)
{
    vec3 by = vec3(0.0);
#define ROW(number_, name_) \
    if (OWN == uint(number_)) by = name_##_move(at);
    OWN_MOVES(ROW)
#undef ROW
    return by;
}

// Turned as the shortest way from a to b turns.
vec3 turned(vec3 v, vec3 a, vec3 b)
{
    const vec3 axis = cross(a, b);
    const float c = dot(a, b);
    return c < -0.999 ? -v : v * c + cross(axis, v) + axis * (dot(axis, v) / (1.0 + c));
}

void main()
{
    if (gl_GlobalInvocationID.x >= params.count) return;
    const int vertex = int(params.first + gl_GlobalInvocationID.x);
    const uvec4 a = texelFetch(vertices, vertex * 4);
    const uvec4 b = texelFetch(vertices, vertex * 4 + 1);
    const uvec4 c = texelFetch(vertices, vertex * 4 + 2);
    const uvec4 d = texelFetch(vertices, vertex * 4 + 3);
    const vec4 point = texelFetch(points, vertex);
    const vec4 p = vec4(uintBitsToFloat(a.xyz), 1.0);
    const mat3 normal_rows = mat3(params.normal_to_world[0].xyz, params.normal_to_world[1].xyz,
                                  params.normal_to_world[2].xyz);
    MoveInput at;
    at.position = vec3(dot(params.to_world[0], p), dot(params.to_world[1], p), dot(params.to_world[2], p));
    at.normal = normalize(point.xyz * normal_rows);
    at.uv = uintBitsToFloat(uvec4(c.zw, d.xy));
    at.color = unpackUnorm4x8(d.z);
    at.weather = unpackUnorm4x8(d.w);
    at.spacing = point.w;

    // The normal of what the mesh becomes here, from two places beside on its tangent plane.
    const vec3 by = moved_by(at);
    const float beside = max(0.02 * at.spacing, 1.0e-4);
    const vec3 u = normalize(abs(at.normal.y) < 0.9 ? cross(at.normal, vec3(0, 1, 0)) : cross(at.normal, vec3(1, 0, 0)));
    const vec3 v = cross(at.normal, u);
    MoveInput next = at;
    next.position = at.position + u * beside;
    const vec3 along_u = u * beside + (moved_by(next) - by);
    next.position = at.position + v * beside;
    const vec3 along_v = v * beside + (moved_by(next) - by);
    const vec3 face = cross(along_u, along_v);
    const float size = length(face);
    const vec3 normal = size > 0.0 ? face / size : at.normal;

    const vec3 own_normal = normalize(uintBitsToFloat(uvec3(a.w, b.xy)) * normal_rows);
    const vec3 t = uintBitsToFloat(uvec3(b.zw, c.x));
    const vec3 own_tangent = vec3(dot(params.to_world[0].xyz, t), dot(params.to_world[1].xyz, t), dot(params.to_world[2].xyz, t));
    moved[vertex] = MovedVertex(by, turned(own_normal, at.normal, normal), turned(own_tangent, at.normal, normal));
}
