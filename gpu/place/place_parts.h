#ifndef PETRICHOR_GPU_PLACE_PLACE_PARTS_H
#define PETRICHOR_GPU_PLACE_PLACE_PARTS_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formulas/light/patch_cells.h"

namespace petrichor::gpu {

/// Cells of a patch along one side of its own that its parts are made of, and how much finer they are.
inline constexpr int kPartCells = 8;
inline constexpr int kPartLevels = 3;
inline constexpr std::size_t kMostParts = 4;

/// A patch whose weather is not the same all over, as where a shelter ends: parts of it have states of
/// their own, behind those of all patches. Its own state is their mean, for whoever does not ask so closely.
struct PlaceParts {
    std::uint32_t patch = 0;
    std::uint32_t first = 0;  ///< number of the first part, counted from the first of all
    std::uint32_t count = 0;  ///< 1..kMostParts
    /// The part of each cell, 0..count - 1: first along the next axis of its plane, then along the one behind that
    /// (of ground: along z, then along x).
    std::array<std::uint8_t, kPartCells * kPartCells> of_cell{};
};

/// Parts stand behind the nodes of a PlaceShape's table.
void append_parts(std::vector<glm::uvec4>& table, const PlaceParts& parts);
/// What is behind the nodes; grid: of the table.
std::vector<PlaceParts> parts_of(std::span<const glm::uvec4> table, const shared::PatchGrid& grid);
/// How many parts there are of all patches.
std::uint32_t count_of_parts(std::span<const PlaceParts> all);

}  // namespace petrichor::gpu

#endif
