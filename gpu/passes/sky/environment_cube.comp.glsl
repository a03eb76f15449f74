#version 460
// A lat-long environment map, turned about the vertical, as a cube map.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "base/interop.h"
#include "formulas/light/cube_map.h"
#include "gpu/passes/sky/sky_io.h"

layout(local_size_x = SKY_TILE, local_size_y = SKY_TILE) in;
layout(binding = SKY_SOURCE) uniform sampler2D map;
layout(binding = SKY_TARGET, rgba16f) uniform writeonly image2DArray target;

layout(push_constant, scalar) uniform Push { EnvironmentParams params; };

void main()
{
    const ivec3 id = ivec3(gl_GlobalInvocationID);
    const ivec3 size = imageSize(target);
    if (any(greaterThanEqual(id.xy, size.xy))) return;
    const vec2 st = (vec2(id.xy) + 0.5) / vec2(size.xy) * 2.0 - 1.0;
    const vec3 d = normalize(cube_direction(id.z, st));
    const float u = atan(d.x, -d.z) / 6.2831853 + 0.5 + params.rotation_rad / 6.2831853;
    const float v = acos(clamp(d.y, -1.0, 1.0)) / 3.14159265;
    const vec3 radiance = textureLod(map, vec2(u, v), 0.0).rgb * params.scale;
    imageStore(target, id, vec4(clamp(radiance, vec3(0.0), vec3(60000.0)), 1.0));
}
