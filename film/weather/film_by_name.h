#ifndef PETRICHOR_FILM_WEATHER_FILM_BY_NAME_H
#define PETRICHOR_FILM_WEATHER_FILM_BY_NAME_H

#include "scene/scene.h"

namespace petrichor::film {

/// Gives materials that say nothing of the film of water on them (MaterialWeather::film) what their
/// names say: lawns and leaves a third. They look every way, so that a wet lawn is no mirror, and darkens by a
/// tenth where stones do by a third (the surface "lawn": albedo 0.22 dry, 0.20 wet).
void set_films_by_name(scene::Scene& scene);

/// Gives materials that say nothing of beads of water (MaterialWeather::beads) some: clear glass, what has a
/// clear coat, and all of a model of at most 3 m, which is seen from near. The ground that was laid below it has none.
///   size_m  longest side of what the scene brings
void set_beads(scene::Scene& scene, float size_m);

}  // namespace petrichor::film

#endif
