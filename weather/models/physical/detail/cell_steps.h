// Entry points of the kernel: one cell, or blocks of eight in the registers of the machine.
#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_DETAIL_CELL_STEPS_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_DETAIL_CELL_STEPS_H

#include "weather/physics/detail/cell_kernel.h"

namespace petrichor::weather::detail {

/// One cell through some steps of equal length.
using AdvanceCell = void (*)(CellState& cell, const CellPlace<double>& place,
                             const StepForcing* steps, std::size_t count, const CellConstants& k,
                             const StepConstants& s);
/// The fastest version this machine can run; all versions give the same bits.
AdvanceCell fastest_advance_cell();
/// For any machine, and with the instructions of AVX2, for tests.
void advance_cell_plain(CellState&, const CellPlace<double>&, const StepForcing*, std::size_t,
                        const CellConstants&, const StepConstants&);
void advance_cell_wide(CellState&, const CellPlace<double>&, const StepForcing*, std::size_t,
                       const CellConstants&, const StepConstants&);

/// Eight cells: every number of CellVars eight times, side by side.
struct alignas(64) CellBlock {
    double numbers[kCellNumbers][kLaneCount];
};
inline constexpr std::size_t kPlaceNumbers = sizeof(CellPlace<double>) / sizeof(double);
struct alignas(64) PlaceBlock {
    double numbers[kPlaceNumbers][kLaneCount];
};
using AdvanceBlock = void (*)(CellBlock& block, const PlaceBlock& place, const StepForcing* steps,
                              std::size_t count, const CellConstants& k, const StepConstants& s);
/// The fastest version this machine can run; all versions give the same bits.
AdvanceBlock fastest_advance_block();
/// Registers of 16 bytes (any machine), of 32 bytes (AVX2) and of 64 (AVX-512), for tests.
void advance_block_16(CellBlock&, const PlaceBlock&, const StepForcing*, std::size_t,
                      const CellConstants&, const StepConstants&);
void advance_block_32(CellBlock&, const PlaceBlock&, const StepForcing*, std::size_t,
                      const CellConstants&, const StepConstants&);
void advance_block_64(CellBlock&, const PlaceBlock&, const StepForcing*, std::size_t,
                      const CellConstants&, const StepConstants&);
bool machine_has_wide_registers();
bool machine_has_widest_registers();

/// The place of a station on flat, open ground.
CellPlace<double> station_place(double sky_view = 1.0, double precip_factor = 1.0);
/// The year behind a series of any length: air temperature as a mean and a cosine. Of a series of
/// less than 120 days the mean is half that of its latitude and height (climate_mean_c), half its
/// own less the season of its latitude (climate_amplitude_k), where the latitude is known.
struct YearlyWave {
    double mean_c = 8.0, amplitude_k = 0.0;
    double recent_k = 0.0;  // of a short series: its own mean over mean_c
    bool south = false;
};
/// Yearly mean of the air by latitude and height: zonal means at sea level as North, Cahalan &
/// Coakley 1981 (Rev. Geophys. 19, 91) expand them, 14.9 - 28 P2(sin latitude), less 6.5 K a km.
double climate_mean_c(double latitude_deg, double elevation_m);
/// How far the warmest day's mean is over that of the year: 16 K sin^2(latitude), chosen (8 K at 45
/// degrees, 12 at 60: the west of continents; inland it is up to twice that).
double climate_amplitude_k(double latitude_deg);
YearlyWave yearly_wave(const ForcingTable& table);
/// Ground as the yearly wave leaves it at a time of the table (at its beginning), dry, no snow.
CellState initial_cell(const ForcingTable& table, const CellConstants& k, std::int64_t at_us);
/// Behind the layers of a wall of a house: lining, and the air of the room.
double behind_wall_m2_k_w(const CellConstants& k);
/// The wall of a house.
CellState initial_wall(const ForcingTable& table, const CellConstants& k, std::int64_t at_us);
CellState initial_cell(const ForcingTable& table, const CellConstants& k);

}  // namespace petrichor::weather::detail

#endif
