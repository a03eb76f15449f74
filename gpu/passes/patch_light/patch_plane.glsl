// A normal in 30 bits, read more cheaply than an octahedral one; about unit. Whoever writes a plane
// takes its distance with the normal that is read.
#ifndef PETRICHOR_PATCH_PLANE_GLSL
#define PETRICHOR_PATCH_PLANE_GLSL

#include "gpu/frame/patch_points_io.h"

uint plane_code(vec3 n)
{
    const uvec3 c = uvec3(ivec3(round(clamp(n, vec3(-1.0), vec3(1.0)) * 511.0)) + 512);
    return c.x | (c.y << 10) | (c.z << 20);
}

vec3 plane_normal(uint code)
{
    const uvec3 c = uvec3(code, code >> 10, code >> 20) & 1023u;
    return vec3(ivec3(c) - 512) * (1.0 / 511.0);
}

#endif
