// A layer of clouds over clear air.
#ifndef PETRICHOR_CLOUDS_GLSL
#define PETRICHOR_CLOUDS_GLSL

#include "gpu/passes/sky/sky_light_io.h"
#include "formulas/noise/noise.h"

#define CLOUD_TEXEL_RAD 0.00614  // a quarter turn over 256 texels: of the cube that clouds are drawn into

// Octaves of noise. One that is finer than `footprint`, the length of p that a texel sees, is its mean.
float cloud_noise(vec2 p, float footprint)
{
    float sum = 0.0;
    float weight = 0.5;
    for (int i = 0; i < 6; ++i) {
        const float shown = clamp(1.5 - 1.5 * footprint, 0.0, 1.0);
        sum += weight * mix(0.5, tileable_noise(p, 4096, 300u + uint(i)), shown);
        p = vec2(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y) * 2.03 + 17.0;
        footprint *= 2.03;
        weight *= 0.5;
    }
    return sum / 0.984375;
}

// Distance to a layer over a round earth, in heights of the layer, for the cosine `up` with the vertical.
float cloud_reach(float up)
{
    const float radius = 4000.0;  // of the earth, in heights of 1.6 km
    return sqrt(radius * radius * up * up + 2.0 * radius + 1.0) - radius * up;
}

// What falls on level ground, lux: sun and clear air, less what clouds keep.
vec3 light_under_clouds(SkyParams sky, vec3 sun_at_ground, vec3 clear_zenith)
{
    const float c = sky.cloud_cover;
    const vec3 level = sun_at_ground * max(sky.sun_direction.y, 0.02) + clear_zenith * 3.14159265;
    // Cloud scatters all colours alike: under it even a low, red sun gives a grey, slightly blue light.
    const vec3 grey = dot(level, vec3(0.2126, 0.7152, 0.0722)) * vec3(0.95, 1.0, 1.07);
    // Kasten and Czeplak 1980: what an overcast sky lets through.
    return mix(level, grey, smoothstep(0.35, 0.95, c)) * (1.0 - 0.75 * pow(c, 3.4));
}

// Share of the sky that cloud hides in this direction, x; how thick it is there, y.
vec2 cloud_cover_at(SkyParams sky, vec3 direction)
{
    if (sky.cloud_cover <= 0.0) return vec2(0.0);
    const float reach = cloud_reach(max(direction.y, 0.0));
    const vec2 p = direction.xz * reach * 2.2 + sky.time_s * sky.wind_m_s * 0.0015 + 40.0;
    // A texel's angle, seen slantwise; twice, for it must not flicker either.
    const float footprint = 2.2 * 2.0 * CLOUD_TEXEL_RAD * reach * reach;
    const float n = cloud_noise(p + 0.7 * cloud_noise(p * 0.5, 0.5 * footprint), footprint);
    const float edge = mix(0.80, -0.10, sky.cloud_cover);
    const float softness = mix(0.16, 0.5, sky.cloud_cover);
    const float mask = smoothstep(edge, edge + softness, n);
    return vec2(max(mask, smoothstep(0.75, 1.0, sky.cloud_cover)), n);
}

// Radiance of a cloud: `sun_at_ground` and `clear_zenith` are what clear air would let through and
// send.
vec3 cloud_radiance(SkyParams sky, vec3 direction, vec2 cover, vec3 sun_at_ground, vec3 clear_zenith)
{
    const float c = sky.cloud_cover;
    // CIE: an overcast sky is brighter towards the zenith.
    const vec3 through = light_under_clouds(sky, sun_at_ground, clear_zenith);
    const vec3 overcast = through * (0.4092557 / 3.0) * (1.0 + 2.0 * max(direction.y, 0.0));
    // Thin, sunlit edges of broken clouds.
    const float towards = max(dot(direction, sky.sun_direction), 0.0);
    const vec3 lit = (sun_at_ground * (0.16 + 0.25 * pow(towards, 12.0)) + clear_zenith * 0.7) *
                     mix(1.1, 0.55, cover.y);
    const float grey = smoothstep(0.35, 0.95, c);
    const float relief = mix(1.12, 0.82, cover.y);
    return mix(lit, overcast * relief, grey);
}

#endif
