#ifndef PETRICHOR_GPU_FRAME_SUN_H
#define PETRICHOR_GPU_FRAME_SUN_H

#include "gpu/frame/frame.h"

namespace petrichor::gpu {

/// The sun as the ground sees it: direction towards it and illuminance after air and clouds. By night
/// the moon.
struct Sun {
    glm::vec3 direction{0.0f, 1.0f, 0.0f};
    glm::vec3 illuminance{0.0f};
    bool disc = false;
    bool analytic = false;  ///< of the analytic sky
    float shadow_strength = 1.0f;
    LightFacts::Direct kind = LightFacts::Direct::None;
};

/// From the analytic sky, or from `scene_sun` (a directional light) when the frame asks for it.
Sun sun_of(const Sky& sky, const Light* scene_sun, bool has_environment);

/// Towards the sun, unit, by the angles of the sky.
glm::vec3 sun_direction(const Sky& sky);

/// Radians: half of what the sun spans, and the moon.
inline constexpr float kSunAngularRadius = 0.00465f;
/// Towards a point of its disc: the middle for sample 0, evenly over it for the others.
glm::vec3 toward_sun_disc(const glm::vec3& middle, std::uint32_t sample, int samples, std::uint32_t seed);

/// Towards the moon, and its light on a plane at the ground that faces it, lux by channel; none where
/// the sky has no moon or it is down.
glm::vec3 moon_direction(const Sky& sky);
glm::vec3 moonlight_at_ground(const Sky& sky);

/// Lux by channel on a plane that faces a sun without clouds, at the ground: its way through the
/// air.
glm::vec3 sunlight_at_ground(const Sky& sky);

}  // namespace petrichor::gpu

#endif
