// All weather on a surface point. It comes before the material: it decides where that is read.
#ifndef PETRICHOR_SURFACE_COVER_GLSL
#define PETRICHOR_SURFACE_COVER_GLSL

#include "gpu/passes/surface/shelter.glsl"
#include "gpu/passes/surface/snow.glsl"
#include "gpu/passes/surface/water.glsl"

struct Cover {
    float film;
    float water;
    float snow;
    float frost;
    vec3 normal;      // of the water or snow
    vec2 refraction;  // shift of the texture coordinates below the water
};

Cover no_cover(SurfaceInput at)
{
    Cover c;
    c.film = 0.0;
    c.water = 0.0;
    c.snow = 0.0;
    c.frost = 0.0;
    c.normal = at.normal;
    c.refraction = vec2(0.0);
    return c;
}

// mapped: tangent normal of the normal map.
Cover cover_on(SurfaceInput at, TangentFrame f, vec3 mapped)
{
    Cover c = no_cover(at);
    const float open = exposure_to_sky(at);
    // Thin wetness creeps further than rain falls.
    const float damp = sqrt(open);

    const float amount_raw = snow_amount_raw(at, open);
    const float amount = saturate(amount_raw);
    const vec3 smoothed = normalize(
        to_world(f, normalize(mix(mapped, vec3(0.0, 0.0, 1.0), saturate(amount_raw * 0.5)))));
    SnowCover snow;
    snow.snow = 0.0;
    snow.melt = 0.0;
    if (SNOW != 0u && amount > 0.0) snow = snow_on(at, amount, smoothed.y);

    const vec2 flood = flood_level(open);
    WaterCover water;
    water.anywhere = 0.0;
    water.deep = 0.0;
    if (WATER != 0u) water = water_on(at, flood);
    c.film = damp * saturate(smoothed.y + 1.0 - material.water_slope_damp);
    c.frost = frame.weather.frost * open * saturate(at.normal.y * 0.6 + 0.5) * (1.0 - water.anywhere);

    const float left_m = frame.look.detail_distance_m - length(at.position - frame.camera_m);
    const float fade = pow(saturate(left_m / max(frame.look.detail_fade_m, 1.0e-3)), 2.0);
    vec3 ripple = vec3(0.0, 0.0, 1.0);
    vec3 flow = vec3(0.0, 0.0, 1.0);
    if (WATER != 0u && frame.weather.rain * open > 0.0 && water.deep > 0.0 && fade > 0.001) {
        ripple = ripple_normal(at, water, open);
    }
    if (WATER != 0u && flood.y > 0.0 && water.anywhere > 0.0 && fade > 0.001) {
        flow = flow_normal(at, f, water);
    }
    const vec3 bent = mix(vec3(0.0, 0.0, 1.0),
                          normalize(vec3(ripple.xy + flow.xy, ripple.z * flow.z)), fade);
    c.refraction =
        (ripple.xy * frame.look.ripple_refraction + flow.xy * material.flow_refraction) *
        water.deep * (1.0 - saturate(2.0 * snow.snow)) *
        saturate(1.0 - frame.weather.water_to_snow + material.water_accumulation.z) * fade * 0.1;
    c.normal = normalize(vec3(bent.x, 0.0, bent.y) + at.normal * max(bent.z, 0.05));

    c.water = water.anywhere;
    c.snow = snow.snow;
    if (SNOW != 0u) {
        c.water = melt_wetness(water.anywhere, snow.melt, frame.weather.melt_exp);
        const float snow_share = snow.snow / max(snow.snow + c.water, 1.0e-4);
        c.normal = normalize(
            mix(c.normal, snow_normal(at, amount, smoothed, fade), saturate(snow_share)));
    }
    return c;
}

#endif
