#ifndef PETRICHOR_GPU_DETAIL_FRAME_CONSTANTS_H
#define PETRICHOR_GPU_DETAIL_FRAME_CONSTANTS_H

#include "gpu/detail/view.h"
#include "gpu/passes/surface.h"
#include "gpu/shaders/interface/sky_light.h"

namespace petrichor::gpu {

/// The sun as the ground sees it: direction towards it and illuminance after air and clouds.
struct Sun {
    glm::vec3 direction{0.0f, 1.0f, 0.0f};
    glm::vec3 illuminance{0.0f};
    bool disc = false;
};

/// From the analytic sky, or from `scene_sun` (a directional light) when the frame asks for it.
Sun sun_of(const Sky& sky, const Light* scene_sun, bool has_environment);

/// Analytic sky of the frame, with the land lit by it (snow brightens the land).
shared::SkyParams sky_params(const Frame& frame);

/// Constants of one jittered sample. Views of the depth maps are filled in by the caller.
shared::FrameConstants frame_constants(const Frame& frame, const Sun& sun, const Bounds& scene,
                                       std::uint32_t sample_index);

/// What of the weather can show in a frame, constant water and snow of materials included.
VisibleWeather visible_weather(const Frame& frame, bool scene_has_constant_weather);

}  // namespace petrichor::gpu

#endif
