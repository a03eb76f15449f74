#include "weather/patches/taps.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace petrichor::weather {

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
