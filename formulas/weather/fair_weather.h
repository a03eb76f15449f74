// Where others begin who call the formulas from shaders of their own: weather of a dry day, a material of an engine's
// usual numbers, a surface that nothing shelters. They set what differs and call apply_weather.
//
// One text for C++, GLSL and HLSL. Only C++ has members with defaults; these are the same
// (FairWeather.IsWhatMomentAndLookBeginWith).
#ifndef PETRICHOR_FORMULAS_WEATHER_FAIR_WEATHER_H
#define PETRICHOR_FORMULAS_WEATHER_FAIR_WEATHER_H

#include "base/interop.h"
#include "formulas/weather/apply_weather.h"

SHARED_BEGIN

SHARED_FN WeatherMoment fair_weather()
{
    WeatherMoment w;
    w.rain = 0.0f;
    w.snowfall = 0.0f;
    w.flood_cracks = 0.0f;
    w.flood_puddles = 0.0f;
    w.film_albedo = 0.0f;
    w.film_smoothness = 0.0f;
    w.snow_amount = 0.0f;
    w.water_to_snow = 0.0f;
    w.freeze_exp = 0.0f;
    w.melt = 0.0f;
    w.melt_exp = 0.0f;
    w.frost = 0.0f;
    w.snow_start_height_m = -100.0f;
    w.snow_height_blend_m = 10.0f;
    w.air_temperature_k = 288.15f;
    w.surface_temperature_k = kUnknown;
    w.rain_kg_m2_s = 0.0f;
    w.snowfall_kg_m2_s = 0.0f;
    w.snow_fraction = 0.0f;
    w.film_mm = 0.0f;
    w.crack_water_depth_m = 0.0f;
    w.puddle_depth_m = 0.0f;
    w.ice_kg_m2 = 0.0f;
    w.snow_depth_m = 0.0f;
    w.swe_kg_m2 = 0.0f;
    w.snow_liquid_fraction = 0.0f;
    w.snow_temperature_k = kUnknown;
    w.snow_albedo = kUnknown;
    w.wind_m_s = splat2(0.0f);
    w.relative_humidity = kUnknown;
    w.pressure_pa = kUnknown;
    w.visibility_m = 20000.0f;
    w.cloud_fraction = 0.0f;
    w.direct_normal_w_m2 = kUnknown;
    w.diffuse_horizontal_w_m2 = kUnknown;
    w.longwave_down_w_m2 = kUnknown;
    return w;
}

SHARED_FN WeatherLook usual_look()
{
    WeatherLook look;
    look.snow_color = vec3(0.92f, 0.94f, 0.97f);
    look.snow_specular = splat3(0.02f);
    look.snow_tiling = vec4(0.35f, 1.7f, 0.09f, 0.83f);
    look.snow_strength = vec2(1.0f, 0.25f);
    look.snow_scatter_color = splat3(0.0f);
    look.snow_scatter_bias = 0.0f;
    look.snow_scatter_contraction = 8.0f;
    look.snow_line_ragged = 1.0f;
    look.snow_sparkle = 1.0f;
    look.ground_variation = 1.0f;
    look.water_mud = 1.0f;
    look.ripple_tiling = 0.8f;
    look.ripple_speed = 1.0f;
    look.ripple_refraction = 0.05f;
    look.ripple_strength = 0.35f;
    look.detail_distance_m = 50.0f;
    look.detail_fade_m = 15.0f;
    return look;
}

// A material of metallic and roughness (perceptual), as glTF, Unity's Lit and Unreal's default have it: clear water on
// it, porous as it is rough.
SHARED_FN DryMaterial plain_material(vec3 base_color, float metallic, float roughness, float occlusion)
{
    DryMaterial m;
    m.base_color = base_color;
    m.metallic = metallic;
    m.f0 = splat3(0.04f);
    m.roughness = roughness;
    m.occlusion = occlusion;
    m.porosity = porosity_from_smoothness(1.0f - roughness);
    m.water_color = splat4(0.0f);
    m.snow_opacity = 0.5f;
    return m;
}

// A surface under the open sky that bears nothing yet but the film of the weather. Snow is as smooth as snow_texel has it
// in the mean.
SHARED_FN SurfaceState open_surface()
{
    SurfaceState s;
    s.film = 1.0f;
    s.water = 0.0f;
    s.snow = 0.0f;
    s.frost = 0.0f;
    s.snow_smoothness = 0.39f;
    s.deeper_m = 0.0f;
    s.way = kMeanWaterWay;
    return s;
}

SHARED_END

#endif
