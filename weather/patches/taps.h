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
/// what its stores lack and its ground soaks up, and the rest goes to the first pond that has room. It
/// brings no heat.
struct PatchTap {
    std::vector<TapStretch> stretches;  ///< the first where it stands; none: it runs out
    double flow_kg_s = 0.0;             ///< >= 0
    std::int64_t from_us = std::numeric_limits<std::int64_t>::min();
    std::int64_t to_us = std::numeric_limits<std::int64_t>::max();  ///< >= from_us
};

/// What a tap lets in between two moments, kg.
double let_in_kg(const PatchTap& tap, std::int64_t begin_us, std::int64_t end_us);

/// Throws Error that names the tap and the number when one cannot be used.
void check_taps(const std::vector<PatchTap>& taps, const PatchSet& set);

}  // namespace petrichor::weather

#endif
