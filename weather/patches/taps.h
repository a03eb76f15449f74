#ifndef PETRICHOR_WEATHER_PATCHES_TAPS_H
#define PETRICHOR_WEATHER_PATCHES_TAPS_H

#include <cstdint>
#include <limits>
#include <vector>

#include "weather/patches/patches.h"

namespace petrichor::weather {

/// A way down to a pond, or out of the scene.
struct TapStretch {
    std::vector<std::uint32_t> way;    ///< patches that water wets on it
    std::uint32_t runs_to = kRunsOut;  ///< kToPond | number, or kRunsOut
    /// Where the pond stands as high as this, what comes runs on along the next stretch.
    double spill_m = std::numeric_limits<double>::infinity();
};

/// Water that is let in: a hydrant, a burst pipe, a hose. It runs along its stretches; each patch takes
/// what its stores lack and its ground soaks up, and the rest goes to the first pond that has room. On
/// its way it warms the ground, or cools it, and melts the ice that lies there.
struct PatchTap {
    std::vector<TapStretch> stretches;  ///< the first where it stands; none: it runs out
    double flow_kg_s = 0.0;             ///< >= 0
    double temp_k = 283.15;             ///< of the water, 273.15..373.15: of a pipe in the ground
    std::int64_t from_us = std::numeric_limits<std::int64_t>::min();
    std::int64_t to_us = std::numeric_limits<std::int64_t>::max();  ///< >= from_us
};

/// Where the heat of the water went that taps have let in, J over water at 0 C.
struct TapHeat {
    double let_in = 0.0;
    double ground = 0.0;  ///< given to the ground on the way, and to ice on it; below 0 where water cooled it
    double kept = 0.0;    ///< in water that stayed on patches or soaked away there
    double ponds = 0.0, out = 0.0;
    double residual() const { return let_in - (ground + kept + ponds + out); }
};

/// Heat that passes from water to what it runs over, two bodies that both change, J:
///   (water - ground) W G / (W + G) (1 - exp(-contact (1 / W + 1 / G)))
/// so neither passes the temperature at which they meet.
///   water_j_k, ground_j_k  W, G: capacities, >= 0, 0: none passes
///   contact_j_k            what would pass per kelvin if neither changed, >= 0
double heat_to_ground_j(double water_c, double ground_c, double water_j_k, double ground_j_k,
                        double contact_j_k);

/// What a tap lets in between two moments, kg.
double let_in_kg(const PatchTap& tap, std::int64_t begin_us, std::int64_t end_us);

/// Throws Error that names the tap and the number when one cannot be used.
void check_taps(const std::vector<PatchTap>& taps, const PatchSet& set);

}  // namespace petrichor::weather

#endif
