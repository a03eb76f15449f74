#version 460
// One level of a cube map as quads (formulas/light/cube_quads.h).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/cube_quads.h"
#include "gpu/passes/sky/sky_io.h"

layout(local_size_x = SKY_TILE, local_size_y = SKY_TILE) in;
layout(binding = SKY_SOURCE, rgba16f) uniform readonly image2DArray level;
layout(binding = SKY_TARGET, scalar) writeonly buffer Target { uvec4 quads[]; };

layout(push_constant, scalar) uniform Push { SkyQuadsParams params; };

vec3 light_at(int face, ivec2 texel, int side)
{
    const bvec2 inside = equal(clamp(texel, ivec2(0), ivec2(side - 1)), texel);
    CubePlace place = cube_beside(face, texel, side);
    ivec2 there = clamp(ivec2(floor((place.st * 0.5 + 0.5) * float(side))), ivec2(0), ivec2(side - 1));
    if (all(inside)) {
        place.face = face;
        there = texel;
    }
    return imageLoad(level, ivec3(there, place.face)).rgb;
}

void main()
{
    const ivec3 id = ivec3(gl_GlobalInvocationID);
    const int side = imageSize(level).x;
    if (any(greaterThan(id.xy, ivec2(side)))) return;
    // The corner of the cube that lies in this quad: the texel of it that is on no face.
    const ivec2 high = ivec2(id.x == side ? 1 : 0, id.y == side ? 1 : 0);
    const bool corner = (id.x == 0 || id.x == side) && (id.y == 0 || id.y == side);
    vec3 light[4];
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 at = ivec2(i & 1, i >> 1);
        const bool missing = corner && at == high;
        light[i] = light_at(id.z, missing ? clamp(id.xy - 1 + at, ivec2(0), ivec2(side - 1)) : id.xy - 1 + at, side);
        sum += missing ? vec3(0.0) : light[i];
    }
    uvec4 quad;
    for (int i = 0; i < 4; ++i) {
        const bool missing = corner && ivec2(i & 1, i >> 1) == high;
        quad[i] = light_word(missing ? sum / 3.0 : light[i]);
    }
    quads[cube_quad(params.begin, side, id.z, id.xy)] = quad;
}
