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
};

/// How the G-buffer is filled: by fragments, or by resolving a buffer of triangle numbers.
enum class SurfacePath {
    Auto,  ///< what is faster on the device
    Fragment,
    Visibility,
};

/// How a frame is taken.
struct FrameSettings : FrameSwitches {
    int width = 640;
    int height = 360;
    int samples = 8;         ///< jittered samples a pixel, 1..256
    double time_s = 0.0;     ///< drives ripples and flow
    std::uint32_t seed = 1;  ///< jitter
    float exposure = 0.0f;   ///< > 0: linear scale; 0: metered from sun and sky, statelessly
    float exposure_bias_stops = 0.0f;
    float occlusion_direct = 0.0f;  ///< 0..1: how much occlusion maps darken sun and lamps too
    bool gamma = false;  ///< colours are lit as the codes that they are stored as, and shown so
    bool patch_light = true;  ///< light between surfaces by patches, when the renderer holds some
    SurfacePath surface_path = SurfacePath::Auto;
    bool all_lights = false;  ///< every pixel asks every light: slow, for checking light lists
    std::vector<std::string> aovs;  ///< names from aov_table()
};

struct Frame {
    Camera camera;
    Sky sky;
    shared::WeatherMoment weather;    ///< all of it: what is seen, and the SI values beside it
    shared::WeatherLook look;         ///< how weather is drawn
    std::vector<Light> extra_lights;  ///< added to the scene's own (a lamp lit at dusk)
    float scene_light_scale = 1.0f;   ///< multiplies point and spot lights of the scene
    float emissive_scale = 1.0f;      ///< multiplies emission of materials
    std::vector<MaterialChange> materials; ///< those that are not named are as loaded
    /// Albedo of every patch under this frame's weather; empty: worked out from `weather`.
    std::vector<glm::vec3> patch_albedo = {};
    FrameSettings settings;
};

}  // namespace petrichor::gpu

#endif
