// Light of the sky as the lighting pass reads it; written by the sky_light pass.
#ifndef PETRICHOR_GPU_PASSES_SKY_SKY_LIGHT_IO_H
#define PETRICHOR_GPU_PASSES_SKY_SKY_LIGHT_IO_H

#include "base/interop.h"

SHARED_BEGIN

struct SkyLight {
    vec4 harmonics[9];  // irradiance / pi, order-2 spherical harmonics, in x, y, z
    vec4 missed[6];     // irradiance / pi along sky_axis(i), less what the harmonics say there
    float exposure;     // linear scale for the display
    float illuminance;  // metered, lux on level ground
};

// Analytic sky of one moment.
struct SkyParams {
    vec3 sun_direction;
    float turbidity;
    vec3 sun_illuminance;  // above the air
    float cloud_cover;
    vec3 ground_radiance;
    float time_s;
    vec2 wind_m_s;
    float night_radiance;
    float fog_per_m;  // towards the sky; 0: none
    int fog_mode;
    float fog_start_m;
    float fog_end_m;
    float fog_height_m;
    vec3 clear_level;  // what the clear sky sends onto level ground
    float land_albedo;
    vec3 sun_at_ground;  // of a clear sky; fades a little below the horizon, where clouds have it still
    float rain;          // 0..1: what a closed layer looks like from below
    float relief_gain;   // makes the light of such a layer that of an even one
};

SHARED_END

#endif
