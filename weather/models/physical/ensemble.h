#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_ENSEMBLE_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_ENSEMBLE_H

#include <cstdint>
#include <string>
#include <vector>

#include "weather/models/physical/physical.h"

namespace petrichor::weather {

/// How uncertain the weather is: one standard deviation each.
struct EnsembleSpread {
    double precip_log = 0.20;  ///< of ln(precipitation factor)
    double air_k = 1.0;
    double wind_log = 0.25;    ///< of ln(wind factor)
    double cloud_w_m2 = 15.0;  ///< of longwave; shortwave goes down as longwave goes up
};
struct EnsembleParams {
    int members = 32;        ///< 1..10000; member 0 is unperturbed
    std::uint64_t seed = 1;  ///< the same seed gives the same bits
    EnsembleSpread spread{};
    int threads = 1;
};
/// Percentiles over the members at one time.
struct EnsembleRow {
    std::int64_t time_us = 0;
    double depth_m[3] = {}, swe_kg_m2[3] = {}, film_kg_m2[3] = {}, puddle_kg_m2[3] = {},
           surface_c[3] = {};  ///< 10, 50, 90 %
};
/// Runs all members side by side; a row every `every_steps` steps.
std::vector<EnsembleRow> run_ensemble(const ForcingTable& table, const PhysicalParams& params,
                                      const EnsembleParams& ensemble, std::size_t every_steps);

/// What one change does to a run.
struct Sensitivity {
    std::string change;
    double peak_swe_kg_m2 = 0.0, snow_days = 0.0, mean_film_kg_m2 = 0.0, mean_puddle_kg_m2 = 0.0,
           mean_surface_c = 0.0;
};
/// The unchanged run first, then precipitation, temperature, wind and cloud down and up by one
/// standard deviation.
std::vector<Sensitivity> sensitivity_table(const ForcingTable& table, const PhysicalParams& params,
                                           const EnsembleSpread& spread = {});

}  // namespace petrichor::weather

#endif
