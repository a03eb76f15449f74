#ifndef PETRICHOR_GPU_FRAME_FRAME_H
#define PETRICHOR_GPU_FRAME_FRAME_H

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "formulas/weather/moment.h"
#include "gpu/frame/switches.h"
#include "gpu/upload/scene_names.h"
#include "scene/material_table.h"

namespace petrichor::gpu {

/// A lat-long HDR environment: linear RGB radiance, row 0 = straight up, column 0 = -x... The image
/// centre looks along -z; u grows to the right (+x).
struct EnvironmentMap {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;  ///< width * height * 3
};

/// Light from the sky. With an environment map the map lights the scene (scaled), else an analytic
/// sky does: clear air by single scattering, clouds over it.
struct Sky {
    float sun_elevation_rad = 0.7f;  ///< -pi/2 .. pi/2
    float sun_azimuth_rad = 0.6f;    ///< from -z (north) clockwise towards +x (east)
    float sun_illuminance =
        100000.0f;                   ///< lux, on a plane facing the sun above the atmosphere's haze
    float cloud_cover = 0.0f;        ///< 0 clear .. 1 overcast
    float turbidity = 2.5f;          ///< 1.5 very clear .. 10 hazy
    float ground_albedo = 0.2f;      ///< of the land beyond the scene
    float environment_scale = 1.0f;  ///< multiplies the environment map
    float environment_rotation_rad = 0.0f;
    bool analytic_sun = true;  ///< false: the scene's own directional lights replace the sun
    float moon_elevation_rad = -1.0f;
    float moon_azimuth_rad = 0.0f;  ///< as the sun's
    float moon_lux = 0.0f;          ///< above the air, on a plane that faces it; 0: there is none
    float moon_illuminated = 1.0f;  ///< share of its disc
    float latitude_rad = 0.87f;     ///< of the place: where the pole of the stars stands
    float sidereal_rad = 0.0f;      ///< hour angle of the vernal equinox: how far they have turned
    float north_rad = 0.0f;         ///< of the stars: where north is, from -z towards +x
};

/// How the G-buffer is filled: by fragments, or by resolving a buffer of triangle numbers.
enum class SurfacePath {
    Auto,  ///< what is faster on the device
    Fragment,
    Visibility,
};

/// The curve from exposed light to the display (formulas/color).
enum class ToneMap {
    Linear,   ///< clipped
    Filmic,   ///< a gentle shoulder; the default
    Agx,      ///< Sobotka's
    Aces,     ///< the fit of ACES 1
    Neutral,  ///< Khronos' PBR Neutral
};

/// How fog thickens with the path (formulas/light/fog.h).
enum class FogMode {
    Off,
    Metres,  ///< by the visibility of the weather: 2 % contrast is left there
    Exp,
    Exp2,
    Linear,
};

/// Fog over the scene and up to the analytic sky. It glows with the sky's light: there is none
/// without image-based light.
struct Fog {
    FogMode mode = FogMode::Metres;
    float per_m = 0.01f;  ///< of Exp and Exp2
    float start_m = 0.0f, end_m = 100.0f;  ///< of Linear
    float height_m = 120.0f;  ///< scale height of the layer over the scene's lowest point; 0: endless
};

/// How a frame is taken.
struct FrameSettings : FrameSwitches {
    int width = 640;
    int height = 360;
    int samples = 8;         ///< jittered samples a pixel, 1..256
    double time_s = 0.0;     ///< drives ripples and flow
    std::uint32_t seed = 1;  ///< jitter
    float exposure = 0.0f;   ///< > 0: linear scale; 0: by the light that falls in, of sun and sky
    float exposure_bias_stops = 0.0f;
    float occlusion_direct = 0.0f;  ///< 0..1: how much occlusion maps darken sun and lamps too
    bool gamma = false;  ///< colours are lit as the codes that they are stored as, and shown so
    int lamp_shadows =
        4;  ///< so many lamps throw shadows, 0 to 16: the brightest as the eye sees them
    ToneMap tone_map = ToneMap::Filmic;
    float white_balance_k = 0.0f;  ///< light of this temperature is white; 0: as it is
    float bloom = 0.0f;  ///< 0..1: share of light that the lens scatters around; display only
    SurfacePath surface_path = SurfacePath::Auto;
    bool all_lights = false;  ///< every pixel asks every light: slow, for checking light lists
    std::vector<std::string> aovs;  ///< names from aov_table()
};

struct Frame {
    Camera camera;
    Sky sky;
    Fog fog;
    shared::WeatherMoment weather;    ///< all of it: what is seen, and the SI values beside it
    shared::WeatherLook look;         ///< how weather is drawn
    std::vector<Light> extra_lights;  ///< added to the scene's own (a lamp lit at dusk)
    float scene_light_scale = 1.0f;   ///< multiplies point and spot lights of the scene
    float emissive_scale = 1.0f;      ///< multiplies emission of materials
    std::vector<MaterialChange> materials; ///< those that are not named are as loaded
    bool emissive_lights = true;      ///< what glows lights its surroundings
    FrameSettings settings;
};

}  // namespace petrichor::gpu

#endif
