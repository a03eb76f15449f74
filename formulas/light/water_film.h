// A film of water as a lobe of its own over the surface: the surface keeps its roughness and loses what the film
// turns back on the way in and out; the film follows the bumps while it is thin and levels them when it is thick.
//
// Water mirrors 0.02 at normal incidence (n = 1.33) and is layered without gain, as the clear coat of
// formulas/light/layers.h. What is mirrored below is that of the surface in water (Fresnel 1823; Jensen, Legakis
// and Dorsey 1999).
#ifndef PETRICHOR_FORMULAS_LIGHT_WATER_FILM_H
#define PETRICHOR_FORMULAS_LIGHT_WATER_FILM_H

#include "base/interop.h"
#include "formulas/light/brdf.h"
#include "formulas/weather/apply_weather.h"

SHARED_BEGIN

struct WaterFilm {
    float share;      // of the surface that it covers, 0..1
    float roughness;  // of its surface, perceptual
    float level;      // 0: as bumpy as what is below .. 1: flat
    float lit;        // times its highlight
    vec3 normal;      // unit
};

SHARED_CONST float kWaterF0 = 0.02f;
// Lux's strongest film, `film_smoothness` of a wet hour; while it pours it is 0.65.
SHARED_CONST float kClosedFilm = 0.5f;

SHARED_FN float water_fresnel(float cosine)
{
    const float m = 1.0f - clamp(cosine, 0.0f, 1.0f);
    const float m2 = m * m;
    return kWaterF0 + (1.0f - kWaterF0) * m2 * m2 * m;
}

// Of thin wetness; standing water is a surface of its own, snow and hoar frost lie over it. Pores drink the first of
// it. What is frozen of it is glaze: a coat of clear ice, which lies over the pores and levels more of what is below, is a little
// uneven itself and mirrors about as water does (n = 1.31: 0.018). Its normal is left to the caller.
SHARED_FN WaterFilm water_film(DryMaterial dry, SurfaceState state, WeatherMoment moment)
{
    const float pouring = saturate(2.0f * moment.rain) * step(1.0e-4f, moment.film_smoothness);
    const float wet = mix(moment.film_smoothness, 0.65f, pouring) * state.film / kClosedFilm;
    // While less than half is frozen the film is what is liquid.
    const float icy = smooth_edge(0.5f, 1.0f, moment.water_to_snow);
    const float drunk = 0.3f * dry.porosity * (1.0f - dry.metallic) * (1.0f - icy);
    const float over = saturate((wet - drunk) / (1.0f - drunk));
    const float thick = smooth_edge(0.2f, 1.0f, over);
    WaterFilm film;
    film.share = smooth_edge(0.0f, 1.0f, over) * (1.0f - state.water) * (1.0f - state.snow) *
                 (1.0f - state.frost);
    // What is rough stands through the thickest film a little, and drops dent it.
    const float least = mix(0.1f, dry.roughness, 0.15f * (1.0f - icy)) + 0.03f * max(pouring, icy);
    film.roughness = mix(max(dry.roughness, 0.1f), min(least, max(dry.roughness, 0.1f)), thick);
    // Grain, not stones: chosen by eye on wet cobbles by day and under a lamp.
    film.level = mix(0.35f, 0.8f, icy) * thick;
    film.lit = 1.0f;
    film.normal = vec3(0.0f, 1.0f, 0.0f);
    return film;
}

// Reflectance at normal incidence of what lies in water, by that in air.
SHARED_FN float immersed_f0(float f0)
{
    const float root = sqrt(clamp(f0, 0.0f, 0.9f));
    const float ior = (1.0f + root) / (1.0f - root);
    const float r = (ior - 1.33f) / (ior + 1.33f);
    return r * r;
}

// The surface below its film; metals keep their reflectance.
SHARED_FN WeatheredMaterial below_film(WeatheredMaterial under, float share)
{
    WeatheredMaterial wet = under;
    const vec3 f0 = under.specular;
    wet.specular = mix(f0, vec3(immersed_f0(f0.x), immersed_f0(f0.y), immersed_f0(f0.z)),
                       share * (1.0f - under.metallic));
    return wet;
}

// Radiance per unit irradiance on a facing plane, times the cosine: `base` is the answer of the surface.
SHARED_FN vec3 under_film(vec3 base, WaterFilm film, vec3 v, vec3 l)
{
    const float nl = max(dot(film.normal, l), 0.0f);
    const float nv = clamp(abs(dot(film.normal, v)), 1.0e-4f, 1.0f);
    const vec3 h = half_vector(v, l);
    const float alpha = max(film.roughness * film.roughness, 0.002f);
    const float here = ggx_distribution(clamp(dot(film.normal, h), 0.0f, 1.0f), alpha) *
                       ggx_visibility(nl, nv, alpha);
    const float below = (1.0f - film.share * water_fresnel(nl)) * (1.0f - film.share * water_fresnel(nv));
    const float mirrored =
        film.share * film.lit * water_fresnel(clamp(dot(l, h), 0.0f, 1.0f)) * here * nl;
    return base * below + splat3(mirrored);
}

SHARED_END

#endif
