#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_PHYSICAL_GRID_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_PHYSICAL_GRID_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "weather/models/physical/physical.h"

namespace petrichor::weather {

/// A cell of a landscape and how it differs from the station.
struct GridCell {
    double elevation_m = 0.0;
    double slope_rad = 0.0;      ///< 0 flat .. pi/2
    double aspect_rad = 0.0;     ///< where the slope faces: 0 north, pi/2 east
    double sky_view = 1.0;       ///< 0..1
    double precip_factor = 1.0;  ///< 0 under a roof
    std::uint32_t surface = 0;   ///< index into GridParams::surfaces
    // Perturbations, for ensembles.
    double air_offset_k = 0.0, wind_factor = 1.0, shortwave_factor = 1.0,
           longwave_offset_w_m2 = 0.0;
};

/// Cells from a height field: slope and aspect by central differences, sky view by the horizon in
/// eight directions.
///   heights_m   row by row from the north, west to east
///   spacing_m   > 0
///   throws      Error when sizes do not match or heights are not finite
std::vector<GridCell> make_grid_cells(std::span<const float> heights_m, std::size_t width,
                                      std::size_t height, double spacing_m);

struct GridParams {
    PhysicalParams model;           ///< its surface is not used
    std::vector<Surface> surfaces;  ///< at least one
    int threads = 1;                ///< >= 1; the result does not depend on it
};

/// Many cells under one weather: eight cells in registers at a time, blocks spread over threads.
///
/// The same cell gives the same bits here as in PhysicalTimeline when it lies flat at the station's
/// height. Temperature falls by 6.5 K/km, precipitation changes phase with it, the sun strikes
/// slopes at its angle.
class PhysicalGrid {
public:
    /// Throws Error for parameters out of range, a surface index that does not exist, or no cells.
    PhysicalGrid(const ForcingTable& table, const GridParams& params,
                 std::span<const GridCell> cells);
    PhysicalGrid(PhysicalGrid&&) noexcept;
    PhysicalGrid& operator=(PhysicalGrid&&) noexcept;
    ~PhysicalGrid();

    std::size_t cells() const;
    std::size_t steps() const;     ///< in the whole series
    std::size_t step() const;      ///< taken so far
    std::int64_t time_us() const;  ///< of the present states
    /// Takes `count` steps, fewer at the end of the series.
    void advance(std::size_t count);
    CellState state(std::size_t cell) const;
    /// Hash of all states in the order of the cells.
    std::uint64_t hash() const;
    std::size_t bytes() const;  ///< memory held
    /// All states, and back: continuing gives the same bits.
    std::vector<CellState> save() const;
    void restore(std::span<const CellState> states, std::size_t step);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace petrichor::weather

#endif
