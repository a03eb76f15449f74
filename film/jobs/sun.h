#ifndef PETRICHOR_FILM_JOBS_SUN_H
#define PETRICHOR_FILM_JOBS_SUN_H

#include <glm/glm.hpp>
#include <optional>

#include "film/scenario/scenario.h"
#include "gpu/frame/frame.h"
#include "scene/animation/rig.h"
#include "scene/scene.h"
#include "weather/moment.h"

namespace petrichor::film {

/// The direction that light travelling along `travel` comes from, in a scene whose north lies
/// north_rad clockwise from -z.
weather::SunAngles direction_against(const glm::vec3& travel, double north_rad = 0.0);

/// The sun of a moment, from north: the scenario's angles, else its time of day, else what the
/// weather file's place and clock say, else against the scene's first directional light, else 35
/// degrees high in the south-east. `posture`: where the scene's animations have carried that light.
weather::SunAngles sun_at(const ScenarioSun& sun, const scene::Scene& scene,
                          const weather::Moment& moment, double north_rad, double time_s,
                          const scene::Posture* posture = nullptr);

/// What `sky`'s sun must have above the air so that a clear one is as bright on the ground as the scene's first
/// directional light: the sky goes with the sun that shines. None where the scene has none, or one without light.
/// The air is taken as long as that light says, but one below 10 degrees as if it stood there, since what the air leaves
/// of it goes to 0. Lux, at most 200 000, the most that [sun] illuminance_lux may be: brighter suns have a darker sky.
std::optional<float> illuminance_of_scene(const scene::Scene& scene, const gpu::Sky& sky);

}  // namespace petrichor::film

#endif
