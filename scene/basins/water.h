#ifndef PETRICHOR_SCENE_BASINS_WATER_H
#define PETRICHOR_SCENE_BASINS_WATER_H

#include <cstdint>
#include <span>
#include <vector>

#include "scene/basins/hierarchy.h"

namespace petrichor::scene {

/// Water in the hollows of a scene, m3 by hollow; a full pair of children stands in its parent's
/// volume as well. Plain numbers: copying them saves the water.
struct BasinWater {
    std::vector<double> volume_m3;  ///< as many as Basins::hollow; [0] is not used

    explicit BasinWater(const Basins& basins) : volume_m3(basins.hollow.size(), 0.0) {}
};

/// Pours water into the pits; what overflows goes on, and what leaves the scene is returned, m3
/// (Fill-Spill-Merge: Barnes, Callaghan & Wickert 2021). Water stands at once: there is no time in
/// it, and the order of pouring changes nothing but rounding.
///   into_pit_m3  by label: [kOutside] is what runs out unhindered, [1 .. pits]; all >= 0
double pour(const Basins& basins, BasinWater& water, std::span<const double> into_pit_m3);

/// Lowers every water level by what evaporates and soaks away, and returns the volume, m3; the
/// water of a hollow that falls dry is gone, no more. A level above a saddle that falls below it
/// parts into two.
///   loss_m  of the level over the time, by pit ([0] is not used), all >= 0; hollows that have run
///           together lose the mean of their pits, by cells
double evaporate(const Basins& basins, BasinWater& water, std::span<const double> loss_m);

/// All water, m3.
double stored_m3(const Basins& basins, const BasinWater& water);

/// The water over each pit by its label ([0] is not used): its mean depth, m, and its surface, m2; one
/// water's surface is parted among its pits by their cells. Depth times surface adds up to stored_m3.
struct WaterShape {
    double depth_m = 0.0, area_m2 = 0.0;
};
std::vector<WaterShape> water_shapes(const Basins& basins, const BasinWater& water);

/// Level of the water over each pit, world y in metres; the height of the pit where it is dry.
/// [0] is not used. With the label of a cell this draws the water: its depth there is
/// max(0, level[label] - height), and all of one water has one level, to the bit.
std::vector<float> levels_m(const Basins& basins, const BasinWater& water);

/// The same for a picture: kDry_m where a pit is dry, so that ground that lies a little below its cell is dry as well.
std::vector<float> drawn_levels_m(const Basins& basins, const BasinWater& water);
inline constexpr float kDry_m = -1.0e30f;

}  // namespace petrichor::scene

#endif
