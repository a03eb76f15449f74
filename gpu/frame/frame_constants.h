#ifndef PETRICHOR_GPU_FRAME_FRAME_CONSTANTS_H
#define PETRICHOR_GPU_FRAME_FRAME_CONSTANTS_H

#include "gpu/frame/frame.h"
#include "gpu/frame/sun.h"
#include "gpu/frame/view.h"

namespace petrichor::gpu {

/// What of the weather can show in a frame; the rest is not compiled into its shaders.
struct VisibleWeather {
    bool any = false;    ///< anything at all, wet air and frost included
    bool water = false;  ///< standing water
    bool snow = false;
    bool frost = false;
    bool place = false;  ///< pixels find it in their patches
    bool ground_varies = true;  ///< wide ground does, from place to place
    std::uint32_t falls = 0;  ///< directions that it falls along (FrameConstants::falls)
};

/// Constants of one jittered sample. Views of the depth maps are filled in by the caller.
shared::FrameConstants frame_constants(const Frame& frame, const Sun& sun, const Bounds& scene,
                                       std::uint32_t sample_index);

/// A frame's weather where patches hold the film themselves: what all of it does to a surface.
shared::WeatherMoment with_closed_film(shared::WeatherMoment weather);

/// What of the weather can show in a frame, constant water and snow of materials included.
VisibleWeather visible_weather(const Frame& frame, bool scene_has_constant_weather);

/// How wet the lens is in this frame, 0 dry: the setting under the weather of the moment.
float lens_wetness(const Frame& frame);
/// Whether the display is white balanced, and the gains of the cones for it.
bool is_white_balanced(const FrameSettings& settings);
glm::vec3 white_gains(const FrameSettings& settings);

/// Extinction or density of the frame's fog at its base, 1/m; 0: no fog.
float fog_per_m(const Frame& frame);

}  // namespace petrichor::gpu

#endif
