#ifndef PETRICHOR_SCENE_SNOW_COARSER_CAPS_H
#define PETRICHOR_SCENE_SNOW_COARSER_CAPS_H

#include <vector>

#include "scene/snow/snow_caps.h"

namespace petrichor::scene {

/// How far snow lies at most over itself as coarser triangles have it, so far from the nearest eye: they may shadow it where a
/// map's texels are not wider. Below itself it lies up to four times as far.
float casters_over_m(float away_m);

/// Coarser triangles for the shadows of caps, SnowCaps::Part::casters: points are left out where those that stay carry the
/// snow to where it lay, whatever its depth. Borders are borders still, and what meets along an edge still does, over parts
/// too, so caps without cracks throw shadows without. Pure.
///
///   eyes_m  where cameras stand over the film; none: as if near everywhere
///   source  half-edge collapses, Kobbelt et al. 1998, A General Framework for Mesh Decimation, Graphics Interface
void add_casters(SnowCaps& caps, const std::vector<glm::vec3>& eyes_m);

}  // namespace petrichor::scene

#endif
