#ifndef PETRICHOR_FILM_SCENES_DISPLACEMENT_H
#define PETRICHOR_FILM_SCENES_DISPLACEMENT_H

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace petrichor::film {

/// Whether any material asks for it.
bool wants_displacement(const scene::Scene& scene);

/// Cuts the meshes of materials with displacement and moves their points along the normals by the
/// height map, filtered to the length of the edges there; of two mixed sets by both heights. Before
/// patches, light and hollows are looked for, so that all see one shape. Vertices that share a place
/// move alike: by the mean of their heights, along the mean of their normals; the edge to a material
/// of the same mesh that is not displaced stays where it is.
///
///   eyes_m  where cameras stand over the film: with the distance to the nearest, edges may be longer
///           and heights fade. None: as if near everywhere
///   returns a line each for what was asked for and cannot be, and for limits that bit
///
/// Throws Error for a height map that cannot be read.
std::vector<std::string> displace(scene::Scene& scene, std::span<const glm::vec3> eyes_m);

}  // namespace petrichor::film

#endif
