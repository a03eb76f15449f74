#ifndef PETRICHOR_FILM_JOBS_SUN_H
#define PETRICHOR_FILM_JOBS_SUN_H

#include <glm/glm.hpp>

#include "film/scenario/scenario.h"
#include "scene/scene.h"

namespace petrichor::film {

struct SunDirection {
    double elevation_rad = 0.0;
    double azimuth_rad = 0.0;  ///< clockwise from north (-z) towards east (+x)
};

/// Where the sun stands by local solar time; hours beyond 0..24 are other days. Good to half a
/// degree. source: Cooper 1969, The absorption of radiation in solar stills (declination);
/// spherical astronomy.
SunDirection solar_position(double latitude_rad, double day_of_year, double hours);

/// The direction that light travelling along `travel` comes from.
SunDirection direction_against(const glm::vec3& travel);

/// The sun of a moment: the scenario's angles, else its time of day, else against the scene's first
/// directional light, else 35 degrees high in the south-east.
SunDirection sun_at(const ScenarioSun& sun, const scene::Scene& scene, double time_s);

}  // namespace petrichor::film

#endif
