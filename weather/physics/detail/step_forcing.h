// The forcing of one model step, made once for all cells: integrals exact, shape linear.
#ifndef PETRICHOR_WEATHER_DETAIL_STEP_FORCING_H
#define PETRICHOR_WEATHER_DETAIL_STEP_FORCING_H

#include <cstdint>
#include <vector>

#include "weather/forcing.h"

namespace petrichor::weather::detail {

// A quantity over a step: linear, with the mean of the table over the step.
struct Ramp {
    double start = 0.0, rise = 0.0;
    __attribute__((always_inline)) double at(double x) const { return start + rise * x; }
};

struct StepForcing {
    std::int64_t begin_us = 0;
    double dt_s = 0.0;
    Ramp air_c, rh_pct, wind, pressure, shortwave, longwave;
    double precip = 0.0;         // kg m-2 s-1, mean of the step
    double snow_share = 0.0;     // of it, by the file
    bool phase_known = false;
    double sun_east = 0.0, sun_north = 0.0, sun_up = 0.0;  // at the middle
    double diffuse = 1.0;        // share of shortwave
};

/// One step [begin, begin + length] of a filled table.
StepForcing make_step_forcing(const ForcingTable& table, std::int64_t begin_us, std::int64_t length_us);
/// All whole steps from the first row; the last one may be shorter.
std::vector<StepForcing> make_step_forcings(const ForcingTable& table, std::int64_t step_us);

}  // namespace petrichor::weather::detail

#endif
