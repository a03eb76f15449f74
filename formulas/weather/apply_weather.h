// What weather does to a material: the dry material and its cover in, what light meets out.
//
// One text for C++ and GLSL: the lighting pass calls apply_weather for every pixel, and the tests
// call the same. Symbols: Lux 2.02 (docs/lux.md, 9): water darkens, then tints; snow
// lies over both.
#ifndef PETRICHOR_FORMULAS_WEATHER_APPLY_WEATHER_H
#define PETRICHOR_FORMULAS_WEATHER_APPLY_WEATHER_H

#include "base/interop.h"
#include "formulas/weather/moment.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

// As the surface pass writes it: nothing in it knows of weather.
struct DryMaterial {
    vec3 base_color;
    float metallic;
    vec3 f0;             // of the dielectric part, at normal incidence
    float roughness;     // perceptual
    float occlusion;     // 1 open
    float porosity;      // 0 dense .. 1 porous
    vec4 water_color;    // of water that stands on it; alpha: opacity
    float snow_opacity;  // how much of its emission snow swallows
};

// The weather at a point of it, each 0..1.
struct SurfaceState {
    float film;   // where a film can form: shelter and slope
    float water;  // standing water, ax
    float snow;   // sx
    float frost;
    float snow_smoothness;  // of the snow here
};

// A material in the specular workflow: metallic is converted before weather is applied.
struct WeatheredMaterial {
    vec3 albedo;
    vec3 specular;     // F0
    float smoothness;  // 1 - perceptual roughness
    float occlusion;
    float emission_scale;  // V: what is left of emission and translucency
    float normal_mix;      // weight of the cover normal (water, snow) against the base normal
};

// Metallic to specular workflow, as weather wants it.
SHARED_FN WeatheredMaterial dry_material(DryMaterial dry)
{
    WeatheredMaterial m;
    m.albedo = dry.base_color * (1.0f - dry.metallic);
    m.specular = mix(dry.f0, dry.base_color, dry.metallic);
    m.smoothness = 1.0f - dry.roughness;
    m.occlusion = dry.occlusion;
    m.emission_scale = 1.0f;
    m.normal_mix = 0.0f;
    return m;
}

// Pores that fill darken the albedo to a fifth at most, and a film smooths what is above them: the
// form of Lagarde 2013 (Water drop 3b) with the numbers of Lux.
//
// film           thin wetness for (albedo, smoothness), slope factor included
// water          ax
// water_color    linear RGB, alpha = opacity of standing water
// porosity       0 dense .. 1 porous
SHARED_FN WeatheredMaterial apply_water(WeatheredMaterial dry, vec2 film, float water,
                                        vec4 water_color, float porosity)
{
    const float specular_mean = 0.33f * (dry.specular.x + dry.specular.y + dry.specular.z);
    const float metalness = saturate(1000.0f * specular_mean - 500.0f);
    const float pore_factor = mix(1.0f, 0.2f, saturate((1.0f - metalness) * porosity));

    const float t1 = max(water, film.x);
    const float t2 = max(water, film.y * (1.0f - pore_factor));
    const float t3 = max(water, film.y * (1.0f - pore_factor) * 0.5f);
    const float opacity = water_color.w * water;

    WeatheredMaterial wet = dry;
    wet.albedo = dry.albedo * mix(1.0f, pore_factor, t1);
    wet.albedo = mix(wet.albedo, vec3(water_color.x, water_color.y, water_color.z), opacity);
    wet.occlusion = mix(dry.occlusion, 1.0f, opacity);
    wet.emission_scale = dry.emission_scale * (1.0f - opacity);
    wet.normal_mix = t3;
    const float smoothed = mix(dry.smoothness, mix(0.85f, 0.60f, pore_factor), t2);
    wet.smoothness = mix(smoothed, 0.9f, t2);
    wet.specular = mix(dry.specular, vec3(0.02f), t2);
    return wet;
}

// cover          sx
// snow_opacity   how much of emission the snow swallows
SHARED_FN WeatheredMaterial apply_snow(WeatheredMaterial under, float cover, vec3 snow_color,
                                       vec3 snow_specular, float snow_smoothness,
                                       float snow_opacity)
{
    WeatheredMaterial snowy = under;
    snowy.albedo = mix(under.albedo, snow_color, cover);
    snowy.specular = mix(under.specular, snow_specular, cover);
    snowy.smoothness = mix(under.smoothness, snow_smoothness, cover);
    snowy.occlusion = mix(under.occlusion, 1.0f, cover);
    snowy.emission_scale = mix(under.emission_scale, 1.0f - cover * snow_opacity, cover);
    return snowy;
}

// Hoar frost: a thin, rough, whitish crust of crystals. cover 0..1.
SHARED_FN WeatheredMaterial apply_frost(WeatheredMaterial under, float cover)
{
    WeatheredMaterial frosty = under;
    frosty.albedo = mix(under.albedo, vec3(0.78f, 0.81f, 0.85f), 0.7f * cover);
    frosty.specular = mix(under.specular, vec3(0.018f), cover);
    frosty.smoothness = mix(under.smoothness, 0.35f, cover);
    return frosty;
}

// Share of a flat water surface that closes over the relief below: a film follows the bumps, water
// that stands is a mirror.
SHARED_FN float closed_water(SurfaceState state)
{
    return smooth_edge(0.08f, 0.55f, state.water) * (1.0f - state.snow);
}

// Metallic is converted first; then frost, water (darkens, then tints) and snow.
SHARED_FN WeatheredMaterial apply_weather(DryMaterial dry, SurfaceState state, WeatherMoment moment,
                                          WeatherLook look)
{
    WeatheredMaterial m = dry_material(dry);
    m = apply_frost(m, state.frost);
    m = apply_water(m, vec2(moment.film_albedo, moment.film_smoothness) * state.film, state.water,
                    dry.water_color, dry.porosity);
    m = apply_snow(m, state.snow, look.snow_color, look.snow_specular, state.snow_smoothness,
                   dry.snow_opacity);
    const float closed = closed_water(state);
    m.smoothness = mix(m.smoothness, 0.94f, closed);
    m.normal_mix = saturate(max(max(m.normal_mix, closed), state.snow));
    return m;
}

SHARED_END

#endif
