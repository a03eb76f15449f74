#version 460
// The light that a drop or flake sends, once for all corners of its rectangle.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/light/spherical_harmonics.h"
#include "formulas/light/weak_shadow.h"
#include "formulas/weather/falling.h"
#include "gpu/frame/frame_io.h"
#include "gpu/passes/falling/falling_io.h"
#include "gpu/passes/sky/sky_light_io.h"

layout(local_size_x = FALLING_LIT_GROUP) in;
layout(constant_id = FALLING_SPEC_SHELTER) const uint SHELTER = 1u;
layout(constant_id = FALLING_SPEC_SUN) const uint SUN = 1u;
layout(push_constant, scalar) uniform Push { FallingLitParams params; };
layout(binding = FALLING_LIT_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = FALLING_LIT_SKY_LIGHT, scalar) uniform Sky { SkyLight sky_light; };
layout(binding = FALLING_LIT_DROPS) uniform samplerBuffer drops;
layout(binding = FALLING_LIT_SHELTER) uniform sampler2D shelter_map;
layout(binding = FALLING_LIT_SHADOW) uniform sampler2DArrayShadow shadow_map;
layout(binding = FALLING_LIT_LIGHT, scalar) writeonly buffer Light { vec4 lit[]; };

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
    const int drop = int(gl_GlobalInvocationID.x);
    if (drop >= params.count) return;
    const vec4 shape = texelFetch(drops, drop * FALLING_TEXELS + 1);
    const vec4 place = texelFetch(drops, drop * FALLING_TEXELS + 2);
    const vec4 lamps = texelFetch(drops, drop * FALLING_TEXELS + 3);
    const float view_m = shape.x;
    const bool flake = shape.w > 0.5;
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
    const bool kept_off = SHELTER != 0u && shape.w > -0.5 && sheltered(place.xyz);
    lit[drop] = vec4(min(radiance, vec3(60000.0)), kept_off ? 0.0 : 1.0);
}
