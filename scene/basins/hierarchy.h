#ifndef PETRICHOR_SCENE_BASINS_HIERARCHY_H
#define PETRICHOR_SCENE_BASINS_HIERARCHY_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/basins/height_field.h"

namespace petrichor::scene {

/// Label of cells whose water leaves the scene, and the place it goes to.
inline constexpr std::uint32_t kOutside = 0;
/// Label of solid cells.
inline constexpr std::uint32_t kNoLabel = 0xFFFFFFFFu;

/// A hollow: a pit of its own, or two hollows that have run together.
struct Hollow {
    std::uint32_t parent = 0;      ///< the hollow that this one and its neighbour make; 0: none
    std::uint32_t child[2]{0, 0};  ///< 0, 0 for a pit
    std::uint32_t spills_to = kOutside;  ///< the pit its overflow runs to, or kOutside
    float pit_m = 0.0f;                  ///< lowest height
    float spill_m = 0.0f;                ///< level at which it is full
    double capacity_m3 = 0.0;            ///< up to spill_m, what its children hold included
    // Its own cells, those that drown between the levels of its children and its own: a piece of
    // Basins::band_m, sorted; and how many lie lower, and the sum of their heights above pit_m.
    std::size_t band_begin = 0, band_end = 0;
    double lower_cells = 0.0, lower_sum_m = 0.0;
};

/// The hollows of a height field as a forest: pits are leaves, and two hollows that meet at a
/// saddle make a parent, which fills when both are full (Barnes, Callaghan & Wickert 2020). A root
/// spills to a pit of another tree or out of the scene; those ways form no circle.
struct Basins {
    std::size_t width = 0, depth = 0;  ///< of the field
    double cell_area_m2 = 1.0;
    std::vector<std::uint32_t> label;  ///< of a cell: its pit, kOutside or kNoLabel
    std::vector<Hollow> hollow;        ///< [0] is the outside; children come before parents
    std::uint32_t pits = 0;            ///< hollow[1 .. pits] are the leaves
    std::vector<float> band_m;         ///< see Hollow
    std::vector<double> pit_cells;     ///< cells with a label, by pit; [0]: outside
};

/// Finds the hollows: pits by Priority-Flood (Barnes, Lehman & Mulla 2014) from the lowest cell up,
/// eight neighbours, ties by the order of cells; cells at the border of the field, beside cells
/// without ground, and drains lead out. O(n log n), the same bits always.
///   drains  cells that swallow all water; out of range: ignored
Basins find_basins(const HeightField& field, std::span<const std::size_t> drains = {});

/// Height to which a field fills when it rains without end; kSolid_m and kNoGround_m stay. The
/// volume between it and the field is what the roots of `find_basins` hold.
std::vector<float> filled_heights(const HeightField& field,
                                  std::span<const std::size_t> drains = {});

/// Area under water at a level, m2; `level_m` between the levels of its children and its own.
double wet_area_m2(const Basins& basins, std::uint32_t hollow, double level_m);
/// Volume at a level at or above that of its children, all that they hold included.
double volume_at_m3(const Basins& basins, std::uint32_t hollow, double level_m);
/// Its inverse: level = (V + sum of the heights below) / their number.
double level_at_m(const Basins& basins, std::uint32_t hollow, double volume_m3);

}  // namespace petrichor::scene

#endif
