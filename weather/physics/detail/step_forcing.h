// The forcing of one model step, made once for all cells: integrals exact, shape linear.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_STEP_FORCING_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_STEP_FORCING_H

#include <cstdint>
#include <span>
#include <vector>

#include "weather/forcing/forcing.h"
#include "weather/physics/horizon.h"

namespace petrichor::weather::detail {

// A quantity over a step: linear, with the mean of the table over the step.
struct Ramp {
    double start = 0.0, rise = 0.0;
    __attribute__((always_inline)) double at(double x) const { return start + rise * x; }
};

// The station's weather at one instant, in the form that every cell asks for.
struct StationMoment {
    double air_c, from_middle_k;  // from the middle of the step
    double rh_share, wind, pressure, shortwave;
    double reflecting;   // as of the step
    double sky_w_m2_k4;  // longwave / T^4: the sky keeps its emissivity over warmer or colder air
    // What still changes until the end of the substep; wind and humidity as shares.
    double later_air_k, later_wind, later_rh, later_shortwave, later_longwave;
};

struct StepForcing {
    std::int64_t begin_us = 0;
    double dt_s = 0.0;
    Ramp air_c, rh_pct, wind, pressure, shortwave, longwave;
    double reflecting = 1.0;  // 0 where shortwave is what the ground takes up, whatever its albedo
    StationMoment middle;     // until the end of the step
    double precip = 0.0;      // kg m-2 s-1, mean of the step
    double snow_share = 0.0;  // of it, by the file
    bool phase_known = false;
    double sun_east = 0.0, sun_north = 0.0, sun_up = 0.0;  // at the middle
    double diffuse = 1.0;                                  // share of shortwave
    double beam = 1.0;  // share of the beam on flat ground that gets past the horizon
};

/// The moment x of a step, 0..1, the middle of a substep that lasts until `until`.
StationMoment moment_of(const StepForcing& step, double x, double until);

/// Where the sun stands matters for slopes and under a narrow sky only; it is the dearest part of a
/// step.
enum class SunUse { Direction, FlatOpenGround };

/// One step [begin, begin + length] of a filled table.
///   horizon  what hides the beam, or nothing; used with SunUse::Direction
StepForcing make_step_forcing(const ForcingTable& table, std::int64_t begin_us,
                              std::int64_t length_us, SunUse sun,
                              std::span<const double> horizon = {});

/// The steps of a table: whole ones from the first row; the last one may be shorter.
struct StepPlan {
    std::int64_t begin_us = 0, end_us = 0, length_us = 1;
    std::size_t count = 0;

    std::int64_t begin_of(std::size_t step) const
    {
        return begin_us + static_cast<std::int64_t>(step) * length_us;
    }
    std::int64_t length_of(std::size_t step) const;
};
StepPlan make_step_plan(const ForcingTable& table, std::int64_t step_us);

/// Makes the steps of a plan one after the other: 272 bytes each are quicker made again than kept.
class StepWalk {
public:
    StepWalk(const ForcingTable& table, const StepPlan& plan, std::size_t first_step, SunUse sun,
             std::span<const double> horizon = {});
    StepForcing next();

private:
    const ForcingTable* table_;
    const StepPlan* plan_;
    std::size_t step_, row_;
    SunUse sun_;
    Observer observer_;
    Skyline skyline_;
};

/// All steps, for many cells.
std::vector<StepForcing> make_step_forcings(const ForcingTable& table, std::int64_t step_us,
                                            std::span<const double> horizon = {});

}  // namespace petrichor::weather::detail

#endif
