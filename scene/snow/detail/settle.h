// How snow settles on the points of its caps: over joints, and as steep as it holds.
#ifndef PETRICHOR_SCENE_SNOW_DETAIL_SETTLE_H
#define PETRICHOR_SCENE_SNOW_DETAIL_SETTLE_H

#include <cstdint>
#include <vector>

#include "scene/snow/detail/borders.h"
#include "scene/snow/snow_caps.h"
#include "scene/subdivide/subdivide.h"

namespace petrichor::scene::detail {

/// Of edges with ground beyond: the points there.
void find_beyond(std::vector<Border>& edges, const SnowCaps& caps);

/// Points of neighbouring surfaces that snow lies over as one, though no vertex is shared: a kerb and the bed behind it,
/// a manhole's lid and the setts around it.
struct Joint {
    std::uint32_t here, beyond;
    float apart_m;  // in plan
};
std::vector<Joint> joints_of(const SnowCaps& caps);

/// Snow slides off where its own surface would be steeper than repose, from the edges on: round things carry
/// what lies on their crown and little at their sides. Sets most_m; normals of the points.
void hold_by_repose(SnowCaps& caps, const CutMesh& mesh, const std::vector<glm::vec3>& normals,
                    const std::vector<Joint>& joints);

}  // namespace petrichor::scene::detail

#endif
