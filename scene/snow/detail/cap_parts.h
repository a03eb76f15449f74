#ifndef PETRICHOR_SCENE_SNOW_DETAIL_CAP_PARTS_H
#define PETRICHOR_SCENE_SNOW_DETAIL_CAP_PARTS_H

#include <cstdint>
#include <vector>

#include "scene/snow/detail/bank.h"
#include "scene/snow/detail/cap_ground.h"
#include "scene/snow/snow_caps.h"

namespace petrichor::scene::detail {

/// The triangles of a mesh that snow lies on, as parts of the caps; takes the mesh's vertices. first_cut: of each primitive,
/// which triangle of the ground's a triangle of the mesh before the last cut was.
void add_parts(SnowCaps& caps, CutMesh& mesh, Ground& ground, const std::vector<std::vector<std::uint32_t>>& first_cut);

/// Banks after them. They stand for nothing of the scene: caps lie below them.
void add_banks(SnowCaps& caps, const CutMesh& mesh, const Ground& ground, std::vector<BankPart>& banks);

/// Corners of no triangle go, and points that neither those that are left nor what lies below their edges ask for.
void leave_out_unused(SnowCaps& caps);

}  // namespace petrichor::scene::detail

#endif
