// How a lamp shines by direction: its profile, or what its lantern leaves of it. The includer has the table
// `light_profiles` and WAYS.
#ifndef PETRICHOR_LIGHT_PROFILE_GLSL
#define PETRICHOR_LIGHT_PROFILE_GLSL

#include "formulas/light/light_profile.h"
#include "gpu/passes/lighting/light_row.glsl"

bool in_lantern(LightRow light) { return (WAYS & LIGHTS_LANTERN) != 0u && fract(light.size.w) > 0.25; }

vec3 profile_texels(int first, vec2 place, bool wraps)
{
    const ivec2 low = ivec2(place);
    const vec2 part = place - vec2(low);
    const ivec2 last = ivec2(LIGHT_PROFILE_SIDE - 1);
    ivec2 high = min(low + 1, last);
    if (wraps && low.x == last.x) high.x = 0;
    const int row = first + low.y * LIGHT_PROFILE_SIDE;
    const int below = first + high.y * LIGHT_PROFILE_SIDE;
    const vec3 a = mix(texelFetch(light_profiles, row + low.x).rgb,
                       texelFetch(light_profiles, row + high.x).rgb, part.x);
    const vec3 b = mix(texelFetch(light_profiles, below + low.x).rgb,
                       texelFetch(light_profiles, below + high.x).rgb, part.x);
    return mix(a, b, part.y);
}

// How a lamp shines that way, of its profile; `away` points from the lamp, so many metres.
vec3 light_profile(LightRow light, vec3 away, float far_m)
{
    const float number = light.size.w;
    const int first = max(int(number), 0) * LIGHT_PROFILE_SIDE * LIGHT_PROFILE_SIDE;
    vec3 told = vec3(1.0);
    if ((WAYS & LIGHTS_LANTERN) != 0u && in_lantern(light))
        told = vec3(lantern_seen(profile_texels(first, lantern_place(away), false).rg, away, far_m));
    if ((WAYS & LIGHTS_PROFILE) == 0u || number < 0.0 || in_lantern(light)) return told;
    const vec4 axis = light.axis;
    const vec3 up = light.across.xyz;
    const vec3 right = cross(axis.xyz, up);
    const vec3 at = vec3(dot(away, right), dot(away, up), dot(away, axis.xyz));
    const bool picture = texelFetch(light_profiles, first).w > 0.5;
    if (picture && at.z <= 0.0) return vec3(0.0);
    return profile_texels(first, picture ? cookie_place(at, light.color.w) : photometry_place(at), !picture);
}

#endif
