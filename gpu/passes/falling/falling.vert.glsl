#version 460
// A streak or flake as a rectangle along its way, and the light it sends.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/spherical_harmonics.h"
#include "formulas/light/weak_shadow.h"
#include "formulas/weather/falling.h"
#include "gpu/frame/frame_io.h"
#include "gpu/passes/falling/falling_io.h"
#include "gpu/passes/sky/sky_light_io.h"

layout(constant_id = FALLING_SPEC_SHELTER) const uint SHELTER = 1u;
layout(constant_id = FALLING_SPEC_SUN) const uint SUN = 1u;
layout(binding = FALLING_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = FALLING_SKY_LIGHT, scalar) uniform Sky { SkyLight sky_light; };
layout(binding = FALLING_DROPS) uniform samplerBuffer drops;
layout(binding = FALLING_SHELTER) uniform sampler2D shelter_map;
layout(binding = FALLING_SHADOW) uniform sampler2DArrayShadow shadow_map;

layout(location = 0) noperspective out vec2 at_px;  // along the way from its middle, across it
layout(location = 1) flat out vec4 shape;           // half the way, half the width, opacity, flake
layout(location = 2) flat out vec4 light;           // radiance; distance along the view axis

const vec2 kCorners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1),
                                vec2(-1, 1));

vec3 sky_mean(vec3 n)
{
    vec3 e = vec3(0.0);
    for (int i = 0; i < kHarmonics; ++i) e += sky_light.harmonics[i].xyz * harmonic(i, n);
    return max(e, vec3(0.0));
}

bool sheltered(vec3 p)
{
    const vec4 map = frame.shelter_from_world * vec4(p, 1.0);
    if (any(greaterThan(abs(map.xyz - 0.5), vec3(0.5)))) return false;
    return textureLod(shelter_map, map.xy, 0.0).r > map.z;
}

float sun_seen(vec3 p, float view_m)
{
    int cascade = 0;
    while (cascade < SHADOW_CASCADES - 1 && view_m > frame.cascade_end_m[cascade]) ++cascade;
    const vec4 map = frame.arrays.shadow_from_world[cascade] * vec4(p, 1.0);
    if (any(greaterThan(abs(map.xyz - 0.5), vec3(0.5)))) return 1.0;
    return weak_shadow(texture(shadow_map, vec4(map.xy, float(cascade), map.z)), frame.cascade_scale.w);
}

void main()
{
    const int drop = gl_VertexIndex / 6;
    const vec2 corner = kCorners[gl_VertexIndex - 6 * drop];
    const vec4 way = texelFetch(drops, drop * FALLING_TEXELS);
    shape = texelFetch(drops, drop * FALLING_TEXELS + 1);
    const vec4 place = texelFetch(drops, drop * FALLING_TEXELS + 2);
    const vec4 lamps = texelFetch(drops, drop * FALLING_TEXELS + 3);
    const float view_m = shape.x;
    const float half_px = shape.y;
    const bool flake = shape.w > 0.5;

    const vec2 whole = way.zw - way.xy;
    const float length_px = length(whole);
    const vec2 along = length_px > 1.0e-3 ? whole / length_px : vec2(0.0, 1.0);
    const vec2 across = vec2(-along.y, along.x);
    const float half_way = 0.5 * length_px;
    const float wide_px =
        flake ? half_px / (1.0 - 1.42 * flake_raggedness(half_way, half_px)) : half_px;
    at_px = corner * vec2(half_way + wide_px, wide_px);
    const vec2 pixel = 0.5 * (way.xy + way.zw) + along * at_px.x + across * at_px.y;
    gl_Position = vec4(pixel / vec2(frame.size) * 2.0 - 1.0, 0.5, 1.0);
    shape.x = half_way;

    const vec3 from_eye = place.xyz - frame.camera_m;
    const vec3 view = normalize(from_eye);
    // A drop bends the hemisphere before the camera into its disc (Garg and Nayar 2007) and reflects
    // 6 % of it away; a flake sends on what comes from all around.
    vec3 radiance = flake ? 0.9 * sky_light.harmonics[0].xyz * harmonic(0, view)
                          : 0.94 * sky_mean(view);
    radiance *= frame.ambient_scale;
    if (SUN != 0u) {
        const float cosine = dot(view, frame.sun_direction);
        const float phase = flake ? flake_phase(cosine) : drop_phase(cosine);
        radiance += frame.sun_illuminance * (phase * sun_seen(place.xyz, view_m));
    }
    radiance += lamps.rgb;
    light = vec4(min(radiance, vec3(60000.0)), view_m);
    if (SHELTER != 0u && shape.w > -0.5 && sheltered(place.xyz)) gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
}
