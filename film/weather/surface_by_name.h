#ifndef PETRICHOR_FILM_WEATHER_SURFACE_BY_NAME_H
#define PETRICHOR_FILM_WEATHER_SURFACE_BY_NAME_H

#include "scene/scene.h"
#include "weather/physics/surfaces.h"

namespace petrichor::film {

/// Surface of a material for the physical model, from what its name says ("old_cobblestone",
/// "roof tiles 2"); where it says nothing `otherwise`, for metals a metal roof.
weather::Surface surface_of_material(const scene::Material& material,
                                     const weather::Surface& otherwise);

/// Cut out by alpha, or so by name: needles, ivy, hedges.
bool is_leaves(const scene::Material& material);
bool is_foliage(const scene::Material& material);

/// Slope above which a pack with a wet base slides, where nothing holds it: 15 degrees on metal and
/// glass, 30 on tiles, 90 (never) on what is no roof. The angles at which ASCE 7 begins to take load
/// off slippery cold and off other warm roofs.
double slides_above_deg(const scene::Material& material, const weather::Surface& surface);

}  // namespace petrichor::film

#endif
