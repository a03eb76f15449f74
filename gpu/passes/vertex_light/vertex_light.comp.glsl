#version 460
// Lights vertices: each group finds the lamps that reach the box round its vertices, then each vertex adds them up
// in the order of the table.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/codec/shared_exponent.h"
#include "formulas/light/vertex_light.h"
#include "gpu/passes/lights/lights_io.h"
#include "gpu/passes/vertex_light/vertex_light_io.h"

layout(local_size_x = VERTEX_LIGHT_GROUP) in;
layout(constant_id = VERTEX_LIGHT_SPEC_WAYS) const uint WAYS = 0u;
layout(binding = VERTEX_LIGHT_LAMPS) uniform samplerBuffer lights;
layout(binding = VERTEX_LIGHT_PROFILES) uniform samplerBuffer light_profiles;
layout(binding = VERTEX_LIGHT_VERTICES) uniform usamplerBuffer vertices;
layout(binding = VERTEX_LIGHT_JOBS) uniform usamplerBuffer jobs;
layout(binding = VERTEX_LIGHT_DRAWS) uniform samplerBuffer draws;
layout(binding = VERTEX_LIGHT_OUT, scalar) writeonly buffer Out { uvec2 lit_vertices[]; };
layout(push_constant, scalar) uniform Push { VertexLightParams params; };

#include "gpu/passes/lighting/light_profile.glsl"

shared vec3 lows[VERTEX_LIGHT_GROUP];
shared vec3 highs[VERTEX_LIGHT_GROUP];
shared uint reaching[VERTEX_LIGHT_MOST / 32];  // a bit a lamp

void add_lamp(inout LitSides sum, vec3 position, vec3 normal, int lamp)
{
    const LightRow row = light_row(lamp);
    const vec3 to_lamp = row.sphere.xyz - position;
    float outer = -2.0;
    if ((WAYS & LIGHTS_CONE) != 0u) outer = row.color.w;
    vec3 facing = row.color.rgb * vertex_falloff(to_lamp, row.sphere.w, row.axis.xyz, row.axis.w, outer);
    if ((WAYS & (LIGHTS_PROFILE | LIGHTS_LANTERN)) != 0u) {
        const float far_m = length(to_lamp);
        facing *= light_profile(row, -to_lamp / max(far_m, 1.0e-4), far_m);
    }
    const LitSides one = lit_sides(normal, to_lamp, facing);
    sum.front += one.front;
    sum.back += one.back;
}

void main()
{
    const uint group = gl_WorkGroupID.y * VERTEX_LIGHT_GROUPS_X + gl_WorkGroupID.x;
    if (group >= params.groups) return;
    const uint lane = gl_LocalInvocationIndex;
    const uvec4 job = texelFetch(jobs, int(group));
    const int vertex = int(job.y + min(lane, job.z - 1u)) * 4;
    const uvec4 a = texelFetch(vertices, vertex);
    const uvec2 b = texelFetch(vertices, vertex + 1).xy;
    const vec4 p = vec4(uintBitsToFloat(a.xyz), 1.0);
    const vec3 n = uintBitsToFloat(uvec3(a.w, b));
    const int row = int(job.x) * VERTEX_LIGHT_DRAW_TEXELS;
    const vec3 position = vec3(dot(texelFetch(draws, row), p), dot(texelFetch(draws, row + 1), p), dot(texelFetch(draws, row + 2), p));
    vec3 normal = vec3(dot(texelFetch(draws, row + 3).xyz, n), dot(texelFetch(draws, row + 4).xyz, n),
                       dot(texelFetch(draws, row + 5).xyz, n));
    normal *= inversesqrt(max(dot(normal, normal), 1.0e-20));

    lows[lane] = position;
    highs[lane] = position;
    for (uint step = VERTEX_LIGHT_GROUP / 2u; step > 0u; step /= 2u) {
        barrier();
        if (lane < step) {
            lows[lane] = min(lows[lane], lows[lane + step]);
            highs[lane] = max(highs[lane], highs[lane + step]);
        }
    }
    barrier();
    const vec3 low = lows[0];
    const vec3 high = highs[0];
    const uint words = (params.lamps + 31u) / 32u;
    for (uint word = lane; word < words; word += VERTEX_LIGHT_GROUP) {
        uint bits = 0u;
        for (uint i = 0u; i < min(params.lamps - word * 32u, 32u); ++i) {
            const vec4 sphere = texelFetch(lights, int(params.first_lamp + word * 32u + i) * LIGHT_TEXELS);
            const vec3 gap = max(max(low - sphere.xyz, sphere.xyz - high), vec3(0.0));
            if (dot(gap, gap) < sphere.w * sphere.w) bits |= 1u << i;
        }
        reaching[word] = bits;
    }
    barrier();
    LitSides sum = LitSides(vec3(0.0), vec3(0.0));
    for (uint word = 0u; word < words; ++word) {
        for (uint bits = reaching[word]; bits != 0u; bits &= bits - 1u)
            add_lamp(sum, position, normal, int(params.first_lamp + word * 32u) + findLSB(bits));
    }
    if (lane < job.z) lit_vertices[job.w + lane] = uvec2(shared_exponent_code(sum.front), shared_exponent_code(sum.back));
}
