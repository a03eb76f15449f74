#ifndef PETRICHOR_CLI_BENCH_SKILL_URBAN_H
#define PETRICHOR_CLI_BENCH_SKILL_URBAN_H

#include <vector>

#include "cli/bench/skill/skill_row.h"
#include "cli/bench/skill/urban_site.h"

namespace petrichor::cli {

/// Radiation at the station in the hours that were measured, by the weather of the patches around
/// it.
struct UrbanRadiation : UrbanHour {
    /// From the sky to the sensor that looks up, and from a black one as warm as the air; NaN: not
    /// clear.
    double clear_sky_w_m2 = weather::kMissing, black_sky_w_m2 = weather::kMissing;
    /// From all of a clear sky to level ground, by the six sensors alone: walls are what the four
    /// sides measure of them, ground is what the one that looks down does. NaN: not clear, or not
    /// measured.
    double measured_sky_w_m2 = weather::kMissing;
    double black_w_m2 = weather::kMissing, ours_sky_w_m2 = weather::kMissing;  ///< likewise
};
std::vector<UrbanRadiation> urban_radiation(const UrbanSite& site, const UrbanDay& day);

/// What meets a window.
struct WindowAir {
    double sun_w_m2 = 0.0, heat_w_m2 = 0.0;  ///< that arrive
    double wind_m_s = 0.0, air_k = 288.15, room_k = 293.15;
};
/// The outer pane of two: thin, so that the sun that it takes goes to the air (ISO 6946, 4 + 4 v),
/// to the sky and to the room at once; radiation is linear about the air's temperature.
double window_k(const WindowAir& window);
/// Longwave that it sends, with what it mirrors, W/m2.
double window_w_m2(const WindowAir& window);

/// Short and long wave from above, from below and from the four sides together, over all days:
/// root mean square errors of the hours. Last what the measured longwave leaves for the clear sky,
/// over a black one, by our walls and by their own. The clear air of a winter with a third of their
/// vapour has .70 (Ellingson et al. 1991).
std::vector<SkillRow> urban_rows(const UrbanSite& site);

}  // namespace petrichor::cli

#endif
