#ifndef PETRICHOR_WEATHER_PHYSICS_CELL_STATE_H
#define PETRICHOR_WEATHER_PHYSICS_CELL_STATE_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "weather/physics/ground.h"

namespace petrichor::weather {

inline constexpr std::size_t kSnowLayers = 3;

/// Everything a cell remembers, as a template so that eight cells can share registers. Temperatures
/// here are in degrees Celsius: the melting point is then exactly 0. All masses are kg per m2 of
/// cell.
template <class Real>
struct CellVars {
    Real snow_ice[kSnowLayers];  ///< top layer first
    Real snow_liquid[kSnowLayers];
    Real snow_thickness[kSnowLayers];  ///< m
    Real snow_temp_c[kSnowLayers];
    Real snow_albedo;
    Real surface_temp_c;
    Real ground_temp_c[kGroundLayers];
    Real film, crack, puddle;              ///< liquid
    Real film_ice, crack_ice, puddle_ice;  ///< frozen
    Real canopy_snow;                      ///< on branches above the cell
    Real salt;                             ///< de-icing salt, dissolved or dry
    Real infiltration_mm_h;                ///< what wet ground would take up now
    Real frozen_fraction;                  ///< last known, for the renderer's water-to-snow

    // Running totals since the start, kg/m2; evaporation and sublimation count dew and frost as
    // negative.
    Real total_precip, total_evaporation, total_sublimation, total_drainage, total_infiltration;
    Real total_melt;
    Real total_salt_lost;  ///< with water that left, and thrown off by wheels

    // Means of the last step: W/m2, and kg/m2 of the step.
    Real flux_shortwave, flux_longwave, flux_sensible, flux_latent, flux_ground, flux_melt,
        flux_residual;
    Real step_rain, step_snow, step_runoff;

    // How well the books close: of the last step, and over the run.
    Real mass_residual, mass_residual_most, energy_residual_squares, energy_seconds;
};

/// One cell. Plain doubles in a fixed order: copying the bytes saves it.
using CellState = CellVars<double>;
inline constexpr std::size_t kCellNumbers = sizeof(CellState) / sizeof(double);

struct CellDiagnostics {
    double snow_depth_m = 0.0, swe_kg_m2 = 0.0, snow_liquid_kg_m2 = 0.0, snow_density_kg_m3 = 0.0;
    double snow_temp_k = 273.15;
    double surface_water_kg_m2 = 0.0, surface_ice_kg_m2 = 0.0;
};
CellDiagnostics diagnostics(const CellState& state);

/// What lies on the ground. Film water below a pack counts as the pack's.
enum class Cover {
    Bare,
    Snow,   ///< no more water than snow and pores hold
    Slush,  ///< snow on water: at least kSlushWater_kg_m2 that the pores do not hold
    Water,  ///< more water than half the ice: the snow floats in it
};
inline constexpr double kSlushWater_kg_m2 = 0.01;
Cover cover_of(const CellState& state, double film_capacity_kg_m2);

/// All stores of the cell, kg/m2.
double stored_mass_kg_m2(const CellState& state);
/// stores - initial - (precipitation - outputs): 0 to rounding, for a run that began with
/// `initial`.
double mass_balance_kg_m2(const CellState& state, const CellState& initial);
/// Root mean square of the residual of the surface balance since the start, W/m2.
double energy_residual_rms_w_m2(const CellState& state);

/// 64-bit hash of the bits of a state (FNV-1a); equal states have equal hashes on every machine.
std::uint64_t state_hash(const CellState& state);
std::uint64_t state_hash(const std::vector<CellState>& states);
std::string hash_text(std::uint64_t hash);

/// A state as text that restores the same bits, and back.
///   throws  Error when the text is not a saved state of this version
std::string save_state(const CellState& state);
CellState load_state(std::string_view text);

}  // namespace petrichor::weather

#endif
