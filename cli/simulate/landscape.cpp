#include "cli/simulate/landscape.h"

#include <cmath>

#include "base/error.h"
#include "film/weather/inputs.h"
#include "weather/physics/constants.h"

namespace petrichor::cli {
namespace {

constexpr std::size_t kMostSide = 32;
constexpr double kMetresADegree = 111195.0;  // of latitude, on a sphere of 6371 km

// The part of a terrain's side that an index lies in.
std::size_t part_of(std::size_t index, std::size_t length, std::size_t side)
{
    return std::min(side - 1, index * side / length);
}

bool alike(const weather::ForcingTable& a, const weather::ForcingTable& b)
{
    return a[weather::Field::AirTemp] == b[weather::Field::AirTemp] &&
           a[weather::Field::Precip] == b[weather::Field::Precip];
}

}  // namespace

WeatherField read_weather_field(const std::vector<std::string>& words,
                                const film::SiteOptions& site, const Terrain& terrain,
                                std::size_t side, bool nearest)
{
    if (side < 1 || side > kMostSide)
        throw Error("grid: --weather-parts must be 1.." + std::to_string(kMostSide) + ", got " +
                        std::to_string(side),
                    "Give how many parts a side of the terrain is cut into.");
    if (!site.latitude_deg || !site.longitude_deg)
        throw Error("grid: --weather-parts without a place",
                    "Give --latitude and --longitude of the middle of the terrain.");
    WeatherField field{side, {}};
    const double width_m = static_cast<double>(terrain.width) * terrain.spacing_m;
    const double height_m = static_cast<double>(terrain.height) * terrain.spacing_m;
    const double shrink = std::cos(*site.latitude_deg * weather::kPi / 180.0);
    for (std::size_t i = 0; i < side * side; ++i) {
        const auto share = [&](std::size_t part) {
            return (static_cast<double>(part) + 0.5) / static_cast<double>(side) - 0.5;
        };
        film::SiteOptions there = site;
        *there.latitude_deg -= share(i / side) * height_m / kMetresADegree;
        *there.longitude_deg += share(i % side) * width_m / (kMetresADegree * shrink);
        const auto inputs =
            film::read_inputs(words, {there.latitude_deg, there.longitude_deg, nearest});
        field.tables.push_back(film::read_forcing(inputs, there).table);
        const weather::ForcingTable& table = field.tables.back();
        if (std::isnan(table.site.elevation_m))
            throw Error("grid: the weather does not say how high its points lie",
                        "Add the height of the model's ground to the file (z, orog, HGT), or give "
                        "--elevation-m.");
        if (table.time_us != field.tables.front().time_us)
            throw Error("grid: the weather has other times at other places", "Repair the file.");
    }
    bool one_place = side > 1;
    for (const weather::ForcingTable& table : field.tables)
        one_place = one_place && alike(table, field.tables.front());
    if (one_place)
        throw Error("grid: --weather-parts: the weather is the same in all parts",
                    "Give a grid of weather that spans the terrain, or leave --weather-parts out.");
    return field;
}

Landscape::Landscape(const weather::ForcingTable& table, const WeatherField& field,
                     const weather::GridParams& params, std::span<const weather::GridCell> cells,
                     const std::vector<std::size_t>& places, const Terrain& terrain)
{
    if (field.side == 0) {
        grids_.emplace_back(table, params, cells);
        for (std::size_t i = 0; i < cells.size(); ++i) slots_.push_back({0, i});
        return;
    }
    const std::size_t side = field.side;
    std::vector<std::vector<weather::GridCell>> parts(side * side);
    slots_.resize(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::size_t row = part_of(places[i] / terrain.width, terrain.height, side);
        const std::size_t column = part_of(places[i] % terrain.width, terrain.width, side);
        auto& part = parts[row * side + column];
        slots_[i] = {row * side + column, part.size()};
        part.push_back(cells[i]);
    }
    // Parts without a cell make no grid.
    std::vector<std::size_t> grid_of(parts.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (parts[p].empty()) continue;
        grid_of[p] = grids_.size();
        grids_.emplace_back(field.tables[p], params, parts[p]);
    }
    for (Slot& slot : slots_) slot.grid = grid_of[slot.grid];
}

void Landscape::advance(std::size_t count)
{
    for (weather::PhysicalGrid& grid : grids_) grid.advance(count);
}

weather::CellState Landscape::state(std::size_t cell) const
{
    return grids_[slots_[cell].grid].state(slots_[cell].cell);
}

std::uint64_t Landscape::hash() const
{
    std::vector<weather::CellState> states;
    states.reserve(slots_.size());
    for (std::size_t i = 0; i < slots_.size(); ++i) states.push_back(state(i));
    return weather::state_hash(states);
}

std::size_t Landscape::bytes() const
{
    std::size_t sum = 0;
    for (const weather::PhysicalGrid& grid : grids_) sum += grid.bytes();
    return sum;
}

}  // namespace petrichor::cli
