#include "weather/patches/taps.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "weather/physics/detail/portable_math.h"

namespace petrichor::weather {

double heat_to_ground_j(double water_c, double ground_c, double water_j_k, double ground_j_k,
                        double contact_j_k)
{
    if (!(water_j_k > 0.0 && ground_j_k > 0.0)) return 0.0;
    const double both = water_j_k * ground_j_k / (water_j_k + ground_j_k);
    return (water_c - ground_c) * both * (1.0 - detail::exponential(-contact_j_k / both));
}

double let_in_kg(const PatchTap& tap, std::int64_t begin_us, std::int64_t end_us)
{
    const std::int64_t from = std::max(tap.from_us, begin_us), to = std::min(tap.to_us, end_us);
    return to > from ? tap.flow_kg_s * (static_cast<double>(to - from) * 1e-6) : 0.0;
}

void check_taps(const std::vector<PatchTap>& taps, const PatchSet& set)
{
    for (std::size_t i = 0; i < taps.size(); ++i) {
        const PatchTap& tap = taps[i];
        const auto require = [&](bool good, const char* name, double found, const char* accepted) {
            if (good) return;
            throw Error("taps: number " + std::to_string(i) + " " + name + " must be " + accepted +
                            ", got " + std::to_string(found),
                        "Give numbers in the accepted range.");
        };
        require(tap.flow_kg_s >= 0.0 && std::isfinite(tap.flow_kg_s), "flow_kg_s", tap.flow_kg_s,
                "0 or more");
        require(tap.temp_k >= 273.15 && tap.temp_k <= 373.15, "temp_k", tap.temp_k, "in 273.15..373.15");
        require(tap.to_us >= tap.from_us, "to_us", static_cast<double>(tap.to_us),
                "from_us or later");
        for (const TapStretch& stretch : tap.stretches) {
            for (const std::uint32_t patch : stretch.way)
                require(patch < set.patches.size(), "way", patch, "numbers of patches");
            const bool to_pond = stretch.runs_to != kRunsOut && (stretch.runs_to & kToPond) != 0 &&
                                 (stretch.runs_to & ~kToPond) < set.ponds;
            require(stretch.runs_to == kRunsOut || to_pond, "runs_to", stretch.runs_to,
                    "a pond or kRunsOut");
            require(!std::isnan(stretch.spill_m), "spill_m", stretch.spill_m, "a height");
        }
    }
}

}  // namespace petrichor::weather
