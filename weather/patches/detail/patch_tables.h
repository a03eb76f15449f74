// Patches in the order of the kernel: blocks of eight of one kind, and what does not change.
#ifndef PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_TABLES_H
#define PETRICHOR_WEATHER_PATCHES_DETAIL_PATCH_TABLES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "weather/models/physical/detail/cell_steps.h"
#include "weather/patches/patch_weather.h"

namespace petrichor::weather::detail {

inline constexpr std::size_t kPatchLanes = static_cast<std::size_t>(kLaneCount);

// Place of a field of CellState among its numbers.
#define PETRICHOR_CELL_NUMBER(field) (offsetof(CellState, field) / sizeof(double))
inline double& number(CellBlock& block, std::size_t which, std::size_t lane)
{
    return block.numbers[which][lane];
}
inline double number(const CellBlock& block, std::size_t which, std::size_t lane)
{
    return block.numbers[which][lane];
}
CellState cell_in(const CellBlock& block, std::size_t lane);
void put_cell(CellBlock& block, std::size_t lane, const CellState& cell);

// What a slot (a patch, or a spare lane that repeats one) is for the steps.
struct PatchSlot {
    Direction normal;
    double sky_share, patch_share, out_share;
    double horizon, zenith, log_secant, sine_tilt, snow_holds, slide_pull;
    double wall_factor;
    VisibleBits visible;
    std::array<float, kWindClasses> blocked;
};

struct PatchGroup {  // blocks of one kind
    std::uint32_t kind = 0;
    CellConstants constants;
};

struct PatchTables {
    PatchSet set;  // with the open twin as its last patch: flat, open, of no area
    std::uint32_t twin = 0;
    std::vector<PatchSlot> slot;
    std::vector<PatchGroup> groups;
    std::vector<std::uint32_t> group_of_block;
    std::vector<std::uint32_t> slot_of_patch;
    std::vector<std::uint32_t> patch_of_slot;
    // Patches seen, as slots; rows by slot.
    std::vector<std::uint32_t> link_begin, links;
    // Patches from the uppermost down: nothing runs to one that comes earlier.
    std::vector<std::uint32_t> downhill;
    std::vector<std::uint32_t> splashed;  // patches with a foot
    std::vector<std::uint32_t> shedding;  // patches that snow slides from, the uppermost first
    std::vector<double> slide_patience;   // by patch

    std::size_t blocks() const { return group_of_block.size(); }
    std::size_t slots() const { return slot.size(); }
    const PatchKind& kind_of(std::size_t patch) const { return set.kinds[set.patches[patch].kind]; }
};
PatchTables make_patch_tables(PatchSet set, const PatchParams& params, const Site& site,
                              double deep_temp_k);

}  // namespace petrichor::weather::detail

#endif
