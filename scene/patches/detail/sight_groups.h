// Samples of a cell that a wall, a roof or a floor parts.
#ifndef PETRICHOR_SCENE_PATCHES_DETAIL_SIGHT_GROUPS_H
#define PETRICHOR_SCENE_PATCHES_DETAIL_SIGHT_GROUPS_H

#include <array>
#include <cstdint>
#include <span>

#include "scene/patches/detail/cells.h"

namespace petrichor::scene {

/// How far over their surface samples look for each other, of a regular cell.
inline constexpr float kSightLift = 0.12f;

/// Of 48 rays from samples in turn, how many reach the sky; counted up to kSeesTheSky.
inline constexpr int kSeesTheSky = 6;
int sky_rays(const Tracer& tracer, std::span<const PatchSample> samples, float regular_cell_m, std::uint64_t hash);

/// Samples that see one another, or through others: each has the number of the first of its group.
struct SightGroups {
    int points = 0;
    std::array<int, kPatchSamples> of{};

    bool parted() const;
    /// Two of them with a fifth of the samples or more.
    bool large() const;
};
SightGroups sight_groups(const Tracer& tracer, const Cell& cell, float regular_cell_m);

/// Bits of the samples of groups that see none of the sky, where others of the cell do; none where all do, or no group does. A wall
/// that stands out of a roof goes on below it, and what is below is nothing of what is seen above.
std::uint32_t shut_in(const Tracer& tracer, const Cell& cell, const SightGroups& groups, float regular_cell_m,
                      std::uint64_t hash);

}  // namespace petrichor::scene

#endif
