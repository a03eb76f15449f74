#ifndef PETRICHOR_FILM_SCENES_GROUND_PLANE_H
#define PETRICHOR_FILM_SCENES_GROUND_PLANE_H

#include "scene/scene.h"

namespace petrichor::film {

/// Whether a scene stands on ground of its own that may end where it ends: it is a hundred metres wide or more, surfaces
/// that face up fill at least four fifths of the rectangle around it, and it is at least twice as wide as high. The rim of a
/// smaller plate (a yard, a plinth, a piece of land as a model) is seen, and nothing below the horizon beyond it.
bool brings_ground(const scene::Scene& scene, const scene::Bounds& content);

/// Lays level ground below a scene, out to the horizon, as a backdrop. Water and snow lie on it as on
/// any material. It is a yard paved with slabs (texproc/generate; "default ground"), 24 m or six of the scene's half
/// diagonals around, in a meadow ("default meadow"); below what is smaller than 20 cm all of it is asphalt.
void add_ground(scene::Scene& scene, const scene::Bounds& content);

}  // namespace petrichor::film

#endif
