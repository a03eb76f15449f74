// Banks: what deep snow makes of the steps of wide ground. Caps lie on surfaces that face up, each of its own; over a kerb,
// its joints and the gutter at its foot there is one sheet that knows nothing of where they end.
#ifndef PETRICHOR_SCENE_SNOW_DETAIL_BANK_H
#define PETRICHOR_SCENE_SNOW_DETAIL_BANK_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/snow/detail/borders.h"
#include "scene/snow/detail/one_ground.h"
#include "scene/snow/detail/sheet.h"
#include "scene/snow/snow_caps.h"
#include "scene/subdivide/subdivide.h"

namespace petrichor::scene::detail {

/// A part of a bank: triangles over one primitive of the mesh.
struct BankPart {
    std::uint32_t primitive = 0;                ///< of the mesh
    Primitive source;                           ///< its corners and triangles
    std::vector<std::uint32_t> points;          ///< of each corner: the point of the caps
};

/// Lays banks over the steps of wide ground, up to `kHighestStep_m` high, and over its joints, near the eyes: a grid seen
/// from above, whose points are added to the caps. Their heights are those of the highest ground of each cell, smoothed as the
/// snow of a depth does, whatever lies on which side of a step.
///
///   sheet  of the ground near the eyes
///   parts  of the mesh come with what their surfaces carry (texture coordinates, tangents, colours)
///   open   borders beyond which the ground falls away: caps are round there, and no bank is near
std::vector<BankPart> lay_banks(SnowCaps& caps, const CutMesh& mesh, const Sheet& sheet, const std::vector<Border>& open,
                                const SnowCapOptions& options);

}  // namespace petrichor::scene::detail

#endif
