#ifndef PETRICHOR_FILM_WEATHER_TAP_SITES_H
#define PETRICHOR_FILM_WEATHER_TAP_SITES_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/weather/patch_sites.h"

namespace petrichor::film {

/// A tap of a scenario on the ground of its scene. Times are the film's, so `tap` has none.
struct TapSite {
    weather::PatchTap tap;
    std::optional<double> from_s, to_s;
};

/// Cells of the ground that water runs over from `start`, the steepest of eight ways, on level ground
/// the shortest to what lies lower.
///   height_m  of the field: down to the lowest that it reaches; scene::filled_heights of it: as if all
///             hollows were full, on over their brims and out
///   stays     only over cells that drain to the same hollow
std::vector<std::size_t> way_of_water(const SceneGround& ground, std::span<const float> height_m,
                                      std::size_t start, bool stays);

/// Where the taps of a scenario stand and what they wet.
///   throws  Error for a tap outside of the ground, or where something solid stands
std::vector<TapSite> tap_sites(const std::vector<ScenarioTap>& taps, const SceneGround& ground,
                               const scene::Patches& patches);

/// Taps with the times of a run.
///   utc_us  of a time of the film
std::vector<weather::PatchTap> taps_of_run(
    const std::vector<TapSite>& sites, const std::function<std::int64_t(double time_s)>& utc_us);

}  // namespace petrichor::film

#endif
