// What weather does to a material: the dry material and its cover in, what light meets out.
//
// One text for C++ and GLSL: the lighting pass calls apply_weather for every pixel, and the tests
// call the same. Symbols: Lux 2.02 (docs/lux.md, 9): water darkens, then tints; snow
// lies over both.
#ifndef PETRICHOR_FORMULAS_WEATHER_APPLY_WEATHER_H
#define PETRICHOR_FORMULAS_WEATHER_APPLY_WEATHER_H

#include "base/interop.h"
#include "formulas/weather/deep_water.h"
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
    float deeper_m;  // how much deeper standing water is than where it closes over the ground (kClosedWater_m)
    float way;       // of light through it and back, over its depth (water_way)
};

// A material in the specular workflow: metallic is converted before weather is applied.
struct WeatheredMaterial {
    vec3 albedo;
    vec3 specular;     // F0
    float smoothness;  // 1 - perceptual roughness
    float occlusion;
    float emission_scale;  // V: what is left of emission and translucency
    float normal_mix;      // weight of the cover normal (water, snow) against the base normal
    float metallic;        // 1: of a metal, which has no albedo and keeps its F0 below water
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
    m.metallic = dry.metallic;
    return m;
}

// Albedo of a matt ground below water: light that it sends out is turned back at the surface of
// the water, to the ground again (Angstrom 1925; Lekner & Dorf 1988). Diffuse light meets
// water, n = 1.33, with a reflectance of 0.0659 from above and 0.4719 from below.
SHARED_FN vec3 wet_albedo(vec3 dry)
{
    return dry * (0.9341f * 0.5281f) / (splat3(1.0f) - 0.4719f * dry);
}

// Share of a surface that a film darkens so: all of what is matt. Below gloss (paint, glaze, polish) light
// is turned back in dry weather too. Whole from a porosity of a half on: setts, brick and plaster lose
// the third to the half that is measured (Angstrom 1925: sand 0.18 to 0.09, mould 0.14 to 0.08).
SHARED_FN float darkened_share(float porosity)
{
    return saturate(2.0f * porosity);
}

// A film darkens what is matt, and smooths it: the smoothness in the form of Lagarde 2013 (Water
// drop 3b) with the numbers of Lux. Metals keep their reflectance below water.
//
// film           thin wetness for (albedo, smoothness), slope factor included
// water          ax
// water_color    linear RGB, alpha = opacity of standing water
// porosity       0 dense .. 1 porous
SHARED_FN WeatheredMaterial apply_water(WeatheredMaterial dry, vec2 film, float water,
                                        vec4 water_color, float porosity)
{
    const float specular_mean = 0.33f * (dry.specular.x + dry.specular.y + dry.specular.z);
    const float metalness = max(dry.metallic, saturate(1000.0f * specular_mean - 500.0f));
    const float pore_factor = mix(1.0f, 0.2f, saturate((1.0f - metalness) * porosity));

    const float t1 = max(water, film.x);
    const float t2 = max(water, film.y * (1.0f - pore_factor));
    const float t3 = max(water, film.y * (1.0f - pore_factor) * 0.5f);
    const float opacity = water_color.w * water;

    WeatheredMaterial wet = dry;
    wet.albedo = mix(dry.albedo, wet_albedo(dry.albedo),
                     (1.0f - metalness) * darkened_share(porosity) * t1);
    wet.albedo = mix(wet.albedo, vec3(water_color.x, water_color.y, water_color.z), opacity);
    wet.occlusion = mix(dry.occlusion, 1.0f, opacity);
    wet.emission_scale = dry.emission_scale * (1.0f - opacity);
    wet.normal_mix = t3;
    const float smoothed = mix(dry.smoothness, mix(0.85f, 0.60f, pore_factor), t2);
    wet.smoothness = mix(smoothed, 0.9f, t2);
    wet.specular = mix(dry.specular, splat3(0.02f), t2 * (1.0f - metalness));
    return wet;
}

// Deep water over what it wets: the murk of a material grows with its depth, and rain water is not quite clear.
// mud: as water_takes_per_m; water: the cover.
SHARED_FN WeatheredMaterial apply_deep_water(WeatheredMaterial wet, vec4 water_color, float water, float deeper_m, float way, float mud)
{
    const float hides = murk_hides(water_color.w, deeper_m, way);
    const vec3 passes = standing_water_passes(water, deeper_m, way, mud);
    WeatheredMaterial deep = wet;
    deep.albedo = mix(wet.albedo, vec3(water_color.x, water_color.y, water_color.z), hides);
    deep.albedo = mix(bottomless_water(mud), deep.albedo, passes);
    const float seen = (1.0f - hides) * passes.y;
    deep.occlusion = mix(1.0f, wet.occlusion, seen);
    deep.emission_scale = wet.emission_scale * seen;
    return deep;
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

// melt_exp of a frame as it shows: the first melt already fills the gaps between the grains. Rises from 0 to 1.
SHARED_FN float melt_shown(float melt_exp)
{
    const float left = 1.0f - saturate(melt_exp);
    return 1.0f - left * left * left * left;
}

// Share of its albedo that melting snow keeps. Its grains grow and water fills the gaps between them: wet snow sends back
// four fifths of what fresh snow does, and where it is thin at its edges, slush on what it lies on, a half (Oke 1987 has
// 0.95 of fresh snow and 0.40 of old). The numbers between are ours.
//   cover     sx
//   melt_exp  of the weather of the frame, 0..1
SHARED_FN float melting_snow(float cover, float melt_exp)
{
    const float thin = 1.0f - smooth_edge(0.45f, 1.0f, cover);
    return 1.0f - melt_shown(melt_exp) * (0.2f + 0.3f * thin);
}

// Its water makes it smoother, up to that of a film on what is rough.
SHARED_FN float melting_smoothness(float smoothness, float cover, float melt_exp)
{
    const float thin = 1.0f - smooth_edge(0.45f, 1.0f, cover);
    return mix(smoothness, max(smoothness, 0.6f), melt_shown(melt_exp) * (0.3f + 0.7f * thin));
}

// Albedo with the light that snow scatters towards grazing eyes (Lux 2.02, diffuse scattering). facing:
// cosine of the normal with the eye; cover: sx.
SHARED_FN vec3 snow_scattered(vec3 albedo, WeatherLook look, float facing, float cover)
{
    const float x = facing * facing;
    return albedo + look.snow_scatter_color *
                        ((exp2(-look.snow_scatter_contraction * x) + look.snow_scatter_bias) * cover);
}

// Hoar frost: white crystals, matt as a whole. cover 0..1.
SHARED_FN WeatheredMaterial apply_frost(WeatheredMaterial under, float cover)
{
    WeatheredMaterial frosty = under;
    frosty.albedo = mix(under.albedo, vec3(0.87f, 0.88f, 0.89f), 0.85f * cover);
    frosty.specular = mix(under.specular, splat3(0.018f), cover);
    frosty.smoothness = mix(under.smoothness, 0.35f, cover);
    return frosty;
}

// Standing water as far as it is frozen: bubbles and cracks make it milky, and its surface is not
// quite smooth. F0 of ice, n = 1.31. Here they are their mean; patterned_ice draws them.
SHARED_CONST float kIceWhite = 0.24f;  // of its area, in the mean
SHARED_FN vec3 ice_color() { return vec3(0.76f, 0.80f, 0.83f); }
SHARED_FN WeatheredMaterial apply_ice(WeatheredMaterial under, float ice)
{
    WeatheredMaterial icy = under;
    icy.albedo = mix(under.albedo, ice_color(), kIceWhite * ice);
    icy.specular = mix(under.specular, splat3(0.018f), ice);
    icy.smoothness = mix(under.smoothness, 0.84f, ice);
    return icy;
}

// The albedo that apply_ice has with its mean, where ice is `white` (ice_white).
SHARED_FN vec3 patterned_ice(vec3 albedo, float ice, float white)
{
    const vec3 under = (albedo - ice_color() * (kIceWhite * ice)) / (1.0f - kIceWhite * ice);
    return mix(max(under, splat3(0.0f)), ice_color(), white * ice);
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
    // While it pours the film is thicker, and what is rough shines; it does not mirror yet.
    const float pouring = saturate(2.0f * moment.rain) * step(1.0e-4f, moment.film_smoothness);
    // Around what stands the ground is soaked: a damp rim.
    const float soaked = smooth_edge(0.0f, 0.12f, state.water);
    m = apply_water(m, vec2(max(moment.film_albedo * state.film, soaked),
                            mix(moment.film_smoothness, 0.65f, pouring) * state.film),
                    state.water, dry.water_color, dry.porosity);
    if (state.deeper_m > 0.0f || (look.water_mud > 1.0f && state.water > 0.0f))
        m = apply_deep_water(m, dry.water_color, state.water, state.deeper_m, state.way, look.water_mud);
    m = apply_snow(m, state.snow, look.snow_color * melting_snow(state.snow, moment.melt_exp), look.snow_specular,
                   melting_smoothness(state.snow_smoothness, state.snow, moment.melt_exp), dry.snow_opacity);
    const float closed = closed_water(state);
    m.smoothness = mix(m.smoothness, 0.94f, closed);
    m = apply_ice(m, closed * moment.water_to_snow);
    m.normal_mix = saturate(max(max(m.normal_mix, closed), state.snow));
    return m;
}

SHARED_END

#endif
