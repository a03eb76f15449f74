#ifndef PETRICHOR_FILM_JOBS_SUN_H
#define PETRICHOR_FILM_JOBS_SUN_H

#include <glm/glm.hpp>

#include "film/scenario/scenario.h"
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

}  // namespace petrichor::film

#endif
