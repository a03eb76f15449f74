#ifndef PETRICHOR_CLI_SIMULATE_LANDSCAPE_H
#define PETRICHOR_CLI_SIMULATE_LANDSCAPE_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cli/simulate/terrain.h"
#include "film/weather/weather_input.h"
#include "weather/models/physical/physical_grid.h"

namespace petrichor::cli {

/// Weather at the middle of each of side x side equal parts of a terrain, row by row from the
/// north.
struct WeatherField {
    std::size_t side = 0;  ///< 0: none, one weather for all
    std::vector<weather::ForcingTable> tables;
};

/// Reads a grid of weather (NetCDF, GRIB) at the middles of the parts of a terrain whose own middle
/// lies at the place of `site`: between the points of the file, or at the nearest of them.
///   words   the inputs as on the command line
///   throws  Error without a place, for inputs that are one place only (all parts alike), for parts
///           that differ in their times or whose height is not known, and as reading does
WeatherField read_weather_field(const std::vector<std::string>& words,
                                const film::SiteOptions& site, const Terrain& terrain,
                                std::size_t side, bool nearest);

/// Cells of a terrain under one weather, or under that of their part of it.
class Landscape {
public:
    ///   places  of the cells in the terrain
    Landscape(const weather::ForcingTable& table, const WeatherField& field,
              const weather::GridParams& params, std::span<const weather::GridCell> cells,
              const std::vector<std::size_t>& places, const Terrain& terrain);

    std::size_t step() const { return grids_.front().step(); }
    std::size_t steps() const { return grids_.front().steps(); }
    std::int64_t time_us() const { return grids_.front().time_us(); }
    void advance(std::size_t count);
    weather::CellState state(std::size_t cell) const;
    std::uint64_t hash() const;
    std::size_t bytes() const;
    /// The only grid, for checkpoints; nothing under several weathers.
    weather::PhysicalGrid* only() { return grids_.size() == 1 ? &grids_.front() : nullptr; }

private:
    struct Slot {
        std::size_t grid, cell;
    };
    std::vector<weather::PhysicalGrid> grids_;
    std::vector<Slot> slots_;
};

}  // namespace petrichor::cli

#endif
