#ifndef PETRICHOR_FILM_WEATHER_UPWIND_H
#define PETRICHOR_FILM_WEATHER_UPWIND_H

#include <span>

#include "scene/patches/tracer.h"
#include "weather/forcing/forcing.h"
#include "weather/patches/patches.h"

namespace petrichor::film {

/// Whether the wind of a file may ever carry snow: it is asked before rays are traced for that.
bool wind_may_carry_snow(const weather::ForcingTable& table);

/// What stands upwind of every patch that snow lies on and the sky sees, PatchSet::upwind: level rays at
/// heights of 0.1 to 12.8 m, to obstacles within 100 m (Winstral, Elder & Davis 2002, J. Hydrometeorol. 3);
/// it is as high as the highest of them that meets it. Where patches see low sky all around nothing is traced.
///   position_m  middles of the patches of the set
void find_upwind(weather::PatchSet& set, std::span<const glm::vec3> position_m, const scene::Tracer& tracer);

}  // namespace petrichor::film

#endif
