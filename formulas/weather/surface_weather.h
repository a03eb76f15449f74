// Where water and snow lie on a surface point, and what they do to its material.
//
// One text for C++ and GLSL. Symbols: Lux 2.02 (docs/lux.md, 8 and 9), whose quirks are kept where
// results would differ; divisions by zero are not. All values are dimensionless unless the name
// says otherwise.
#ifndef PETRICHOR_FORMULAS_WEATHER_SURFACE_WEATHER_H
#define PETRICHOR_FORMULAS_WEATHER_SURFACE_WEATHER_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_FN float saturate(float x)
{
    return clamp(x, 0.0f, 1.0f);
}

// smoothstep that is defined for equal edges: a step at `high`.
SHARED_FN float smooth_edge(float low, float high, float x)
{
    const float u = saturate((x - low) / max(high - low, 1.0e-6f));
    return u * u * (3.0f - 2.0f * u);
}

// ---- water -------------------------------------------------------------------------------------

struct WaterCover {
    float anywhere;  // ax: standing water, 0..1
    float deep;      // ay: stronger where it stands deep; drives ripples and refraction
};

// flood          (cracks, puddles) level: published level * influence + constant; may exceed 1
// height         0 low .. 1 high, of the surface relief
// puddle_mask    1 puddles may stand, 0 never
// normal_up      y of the geometric normal
// slope_damp     0 water on flat ground only .. 1 on any slope up to vertical
SHARED_FN WaterCover water_cover(vec2 flood, float height, float puddle_mask, float normal_up,
                                 float slope_damp)
{
    const float slope = saturate(normal_up + 1.0f - slope_damp);
    const float cracks = flood.x - height;
    const float puddles = saturate((flood.y * slope - (1.0f - puddle_mask) - height) / 0.4f);
    const float x = slope * max(cracks, puddles);
    const float y = slope * max(cracks, 2.0f * puddles) * 0.5f;
    WaterCover cover;
    cover.anywhere = saturate(x);
    cover.deep = saturate(y * y);
    return cover;
}

// ---- snow --------------------------------------------------------------------------------------

struct SnowCover {
    float snow;  // sx: cover, 0..1
    float melt;  // sy: a wider mask, where melting snow wets the ground
};

// amount          S0 = saturate(published amount * influence + constant)
// height_factor   Z: 0 below the snow line .. 1 above the blend range, square-rooted
// normal_up       y of the smoothed pixel normal
// unique_mask     1 snow may lie, 0 never (footprints, wind-swept places)
// mask, detail    the two-frequency mask, each 0..1
// melt_influence  published melt * snow influence
SHARED_FN SnowCover snow_cover(float amount, float height_factor, float normal_up, float slope_damp,
                               float unique_mask, float mask, float detail, float melt_influence)
{
    const float slope = saturate(amount - slope_damp * saturate(1.0f - normal_up - amount * 0.25f));
    const float base = slope * height_factor;
    const float sharpened = saturate(4.0f * slope * unique_mask * (2.0f - base));
    const float noise = mask * detail;
    const float inside =
        smooth_edge(1.0f - base - base * (1.0f - base), 1.0f - base + 0.01f, noise);
    const float around = smooth_edge(1.0f - base - base * (4.0f - base), 1.0f - base + 0.1f,
                                     noise * (1.0f + melt_influence));
    const float depth = sharpened * mix(detail, 1.0f, base);
    SnowCover cover;
    cover.snow = inside * depth;
    cover.melt = around * depth;
    return cover;
}

// Z of snow_cover: start and blend range in metres; a range of 0 is a sharp snow line.
SHARED_FN float snow_height_factor(float world_y_m, float start_m, float blend_m)
{
    return sqrt(saturate((world_y_m - start_m) / max(blend_m, 1.0e-3f)));
}

// Melting snow wets the ground around it: raises the standing-water cover.
SHARED_FN float melt_wetness(float water_anywhere, float snow_melt_mask, float melt_exp)
{
    return saturate(water_anywhere + 0.75f * saturate(1.75f * snow_melt_mask * melt_exp));
}

// ---- what they do to a material
// ------------------------------------------------------------------

// A material in the specular workflow: metallic is converted before weather is applied.
struct WeatheredMaterial {
    vec3 albedo;
    vec3 specular;     // F0
    float smoothness;  // 1 - perceptual roughness
    float occlusion;
    float emission_scale;  // V: what is left of emission and translucency
    float normal_mix;      // weight of the cover normal (ripples, flow) against the base normal
};

// Porosity of a dry dielectric from its smoothness: the thresholds are those of Lagarde 2013 (Water
// drop 3b), in smoothness.
SHARED_FN float porosity_from_smoothness(float smoothness)
{
    return saturate((0.5f - smoothness) / 0.4f);
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

SHARED_END

#endif
