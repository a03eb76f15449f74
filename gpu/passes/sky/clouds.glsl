// A layer of clouds over clear air.
#ifndef PETRICHOR_CLOUDS_GLSL
#define PETRICHOR_CLOUDS_GLSL

#include "gpu/passes/sky/sky_light_io.h"
#include "formulas/light/clouds.h"
#include "formulas/light/rain_clouds.h"

#define CLOUD_TEXEL_RAD 0.00409  // a quarter turn over 384 texels: of the cube that clouds are drawn into

// Distance to a layer over a round earth, in heights of the layer, for the cosine `up` with the vertical.
float cloud_reach(float up)
{
    const float radius = 4000.0;  // of the earth, in heights of 1.6 km
    return sqrt(radius * radius * up * up + 2.0 * radius + 1.0) - radius * up;
}

// What falls on level ground, lux: sun and clear air, less what clouds keep.
vec3 light_under_clouds(SkyParams sky)
{
    const float c = sky.cloud_cover;
    const vec3 level = sky.sun_at_ground * max(sky.sun_direction.y, 0.0) + sky.clear_level;
    // Cloud scatters all colours alike: under it even a low, red sun gives a grey, slightly blue light.
    const vec3 grey = dot(level, vec3(0.2126, 0.7152, 0.0722)) * vec3(0.95, 1.0, 1.07);
    // Kasten and Czeplak 1980: what an overcast sky lets through.
    return mix(level, grey, smoothstep(0.35, 0.95, c)) * (1.0 - 0.75 * pow(c, 3.4));
}

// What a direction meets of the clouds.
struct CloudSeen {
    float hides;   // share of the sky behind
    float depth;   // of cloud along the way, optical, about
    float sunward; // the same from there towards the sun
    float heavy;   // 0 the thinnest of the layer .. 1 the thickest
    float hidden;  // by rags below a layer that rains
    float up;      // 0 at the base .. 1 at the top of the tallest
    float crease;  // 1 in creases between lumps of a heap .. 0 on them
};

// Octaves that shade; all of them cut the edge.
const int kShadeOctaves = 4;
// A heap leans: else what is fine on its flanks would be stripes from the base to the top. Lengths of the field by its height.
const vec2 kCloudLean = vec2(0.62, 0.34);

CloudSeen cloud_seen(SkyParams sky, vec3 direction)
{
    CloudSeen seen = CloudSeen(0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0);
    const float reach = cloud_reach(max(direction.y, 0.0));
    const vec2 at = direction.xz * reach * 2.2 + sky.time_s * sky.wind_m_s * 0.0015 + 40.0;
    // A texel's angle, seen slantwise.
    const float footprint = 2.2 * CLOUD_TEXEL_RAD * reach * reach;
    const float full = smoothstep(0.75, 1.0, sky.cloud_cover);
    const float edge = cloud_threshold(sky.cloud_cover) - 0.5 * full;
    // Heaps, and the way through them: low over the horizon they are as tall as the steps can follow.
    const float tall = min(cloud_tall(sky.cloud_cover), 0.75 / reach);
    const vec2 through = (direction.xz * reach * 2.2 + kCloudLean) * tall;
    const int steps = tall > 0.0 ? kCloudSteps : 1;
    // Towards the sun: over a cloud's half width, and upwards in heaps.
    const vec2 sunward = 0.16 * sky.sun_direction.xz / max(sky.sun_direction.y, 0.35);
    const float rising = tall > 0.0 ? min(0.16 * max(sky.sun_direction.y, 0.0) / max(sky.sun_direction.y, 0.35) / (2.2 * tall), 0.35) : 0.0;
    // Branches: a loop for each would take its body once more than it is asked (docs/platform.md, 2), and those in it again.
    if (sky.cloud_cover > 0.0) {
        const vec2 bent = at + cloud_bend(at);
        // No finer than the steps of the way: else heaps have a shelf for each.
        const CloudMet met = cloud_met(bent, through, max(footprint, 0.12 * length(through)), edge, steps);
        seen.up = met.up;
        if (met.above > -0.09) {
            const vec2 there = bent + through * met.up;
            // What is finer than the heaps is on the flank that is met; tops are seen at a slant.
            float above = met.above;
            if (tall > 0.0) {
                const float rough = cloud_lumps(there, 2.2 * tall * met.up, 1.5 * footprint);
                // A base is flat, what wells up from it is not.
                above += rough * mix(0.4, 1.0, smoothstep(0.0, 0.25, met.up));
                seen.crease = 1.0 - smoothstep(-0.05, 0.04, rough);
            }
            if (!(tall > 0.0)) above = cloud_field(there, footprint, kCloudOctaves) - edge;
            seen.hides = smoothstep(0.0, mix(0.11, 0.3, full), above);
            seen.depth = max(above, 0.0) / 0.25;
            float broad = 0.5;
            if (sky.rain > 0.0) {
                broad = layer_broad(bent);
                seen.hidden = rags_hide(direction, sky.time_s * sky.wind_m_s, CLOUD_TEXEL_RAD, sky.rain);
            }
            seen.heavy = layer_heavy(above + edge, broad, reach, sky.rain);
            // A closed layer hides the sun.
            if (seen.hides > 0.0 && sky.cloud_cover < 0.95)
                seen.sunward = max(cloud_field(there + sunward, max(footprint, 0.1), kShadeOctaves) - edge -
                                       (tall > 0.0 ? cloud_rise(met.up + rising) : 0.0), 0.0) / 0.25;
        }
        // Where even the widest are smaller than a texel: the share of the layer.
        seen.hides = mix(sky.cloud_cover, seen.hides, clamp(1.6 - 0.8 * footprint, 0.0, 1.0));
    }
    return seen;
}

// Radiance of a cloud: `clear_zenith` is what clear air would send from there.
vec3 cloud_radiance(SkyParams sky, vec3 direction, CloudSeen cloud, vec3 clear_zenith)
{
    const float c = sky.cloud_cover;
    // CIE: an overcast sky is brighter towards the zenith.
    const vec3 through = light_under_clouds(sky);
    const vec3 overcast = through * (0.4092557 / 3.0) * (1.0 + 2.0 * max(direction.y, 0.0));
    // Sunlight that comes through to the side that is seen: forward where cloud is thin, from all sides where
    // it is thick.
    const float towards = max(dot(direction, sky.sun_direction), 0.0);
    const float thin = exp(-2.2 * cloud.depth);
    // What is met at its base is lit through all of the heap above, its flanks are not.
    const float heaps = cloud_tall(c) / cloud_tall(0.0);
    const float below = 1.0 - 0.5 * heaps * (1.0 - thin) * (1.0 - smoothstep(0.0, 0.3, cloud.up));
    const float reached = below * (0.09 + 0.91 * exp(-3.2 * cloud.sunward)) * (1.0 - 0.3 * cloud.crease);
    const vec3 lit = sky.sun_at_ground * reached *
                         (0.26 + thin * (0.06 + 0.45 * pow(towards, 10.0) + 1.2 * pow(towards, 80.0))) +
                     sky.clear_level * ((0.35 + 0.3 * cloud.up) / 3.14159265) + sky.ground_radiance * 0.25 + clear_zenith * 0.3;
    const float grey = smoothstep(0.35, 0.95, c);
    // What is thick of a layer that rains is slate, of the same luminance.
    const float slate = sky.rain * (2.0 * max(cloud.heavy, cloud.hidden) - 1.0);
    const vec3 relief = sky.relief_gain * layer_relief(cloud.heavy, cloud.hidden, sky.rain) * (1.0 + slate * vec3(-0.05, 0.0058, 0.09));
    return mix(lit * mix(1.0, 0.72, clamp(cloud.depth * 0.6, 0.0, 1.0)), overcast * relief, grey);
}

#endif
