#ifndef PETRICHOR_SCENE_SNOW_DETAIL_CAP_POINTS_H
#define PETRICHOR_SCENE_SNOW_DETAIL_CAP_POINTS_H

#include <glm/glm.hpp>
#include <vector>

#include "scene/snow/detail/borders.h"
#include "scene/snow/detail/settle.h"
#include "scene/snow/snow_caps.h"
#include "scene/subdivide/subdivide.h"

namespace petrichor::scene::detail {

/// What of the depth lies at each point. `broad`: at first what shelter leaves, on any slope.
void fill_shares(SnowCaps& caps, const CutMesh& mesh, const std::vector<glm::vec3>& normals, const SnowCapOptions& options);

/// Edges in the open, slots, edges that are closed, and those of low steps.
struct Grids {
    const EdgeGrid &edges, &slots, &closed, &low;
};

/// What each point has of the edges around it.
void fill_points(SnowCaps& caps, const CutMesh& mesh, const Grids& grids, const std::vector<glm::vec3>& normals);

/// How wide the ground is below each, which is told from point to point.
void find_supports(SnowCaps& caps, const CutMesh& mesh);

/// Surfaces that meet reach over each other a little: on a slope their borders would stand off each other.
void narrow_bridges(SnowCaps& caps, const std::vector<Joint>& joints);

/// What tracks press down, at last: the snow around them does not know of them.
void tread(SnowCaps& caps, const SnowCapOptions& options);

}  // namespace petrichor::scene::detail

#endif
