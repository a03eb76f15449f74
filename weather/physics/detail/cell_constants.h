// What a kernel needs of the parameters, worked out once.
#ifndef PETRICHOR_WEATHER_PHYSICS_DETAIL_CELL_CONSTANTS_H
#define PETRICHOR_WEATHER_PHYSICS_DETAIL_CELL_CONSTANTS_H

#include "weather/physics/detail/horton.h"
#include "weather/physics/detail/reservoir.h"
#include "weather/physics/exchange.h"
#include "weather/physics/ground.h"
#include "weather/physics/phase.h"
#include "weather/physics/snow.h"
#include "weather/physics/surfaces.h"

namespace petrichor::weather {
struct PhysicalParams;
struct Site;
}  // namespace petrichor::weather

namespace petrichor::weather::detail {

// Water on the ground: what stays, and what covers all of it (film_cover.h), kg/m2.
struct FilmConstants {
    double held, inverse_full;
};

struct CellConstants {
    Surface surface;
    SnowParams snow;
    ExchangeParams exchange;
    PhaseParams phase;
    double deep_temp_c = 8.0;
    double back_resistance = 0.0;  // m2 K / W behind the layers; 0: ground
    double wind_height_m = 10.0;
    // surface
    double albedo_dry, albedo_wet, emissivity, snow_emissivity;
    double log_roughness, log_snow_roughness, log_wind_height, log_temp_height_10;
    double heat_roughness = 0.0;  // ln(10 z0h / z0) of the bare surface; of snow 0
    double neutral_bare;          // exchange coefficient without snow
    double leaf_exchange = 0.0;   // of leaves in a wind of 1 m/s, kg m-2 s-1; it grows with its root
    double convection_bare, convection_snow, inverse_cover_depth, least_wind,
        least_wind_by_night;
    // water
    double film_capacity, inverse_film_capacity, crack_capacity, puddle_capacity;
    FilmConstants film;
    bool permeable = false;
    double canopy_capacity = 0.0;  // 0: no canopy
};
CellConstants make_cell_constants(const PhysicalParams& params, const Site& site,
                                  double deep_temp_k);

constexpr int kFillingTurns = 6;  // of filling and soaking at the same time

// Factors that depend on the length of a substep.
struct PartConstants {
    double dt_s = 0.0, inverse_dt_1_s = 0.0;
    GroundStack ground;
    ReservoirConstants film, film_in_snow;
    HortonStep horton, horton_turn;  // over the substep, and over a turn of it
    double sprayed = 0.0;            // share of the film that traffic takes
    double cleared = 0.0;            // and of the snow that wheels and ploughs take
    double salt_kept = 1.0;          // share of the salt that wheels leave
};
// Factors that depend on the length of the step.
struct StepConstants {
    double dt_s = 0.0;
    int whole_parts = 1, parts = 1;  // parts of the step at rest, and while much happens
    PartConstants whole, part;       // their constants
    double albedo_cold = 1.0, albedo_melting = 1.0;        // ageing over the step
    double settling = 1.0;                                 // exponential law
    double unloading_cold = 0.0, unloading_melting = 0.0;  // shares of what the canopy holds
};
StepConstants make_step_constants(const CellConstants& k, double dt_s, double substep_s);

}  // namespace petrichor::weather::detail

#endif
