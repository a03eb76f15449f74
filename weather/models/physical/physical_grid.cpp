#include "weather/models/physical/physical_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <thread>

#include "base/error.h"
#include "weather/models/physical/detail/cell_steps.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"

namespace petrichor::weather {

namespace {

using detail::CellBlock;
using detail::kLaneCount;
using detail::PlaceBlock;

constexpr std::size_t kLanes = static_cast<std::size_t>(kLaneCount);

void put_cell(CellBlock& block, std::size_t lane, const CellState& cell)
{
    double numbers[kCellNumbers];
    std::memcpy(numbers, &cell, sizeof cell);
    for (std::size_t i = 0; i < kCellNumbers; ++i) block.numbers[i][lane] = numbers[i];
}

CellState get_cell(const CellBlock& block, std::size_t lane)
{
    double numbers[kCellNumbers];
    for (std::size_t i = 0; i < kCellNumbers; ++i) numbers[i] = block.numbers[i][lane];
    CellState cell;
    std::memcpy(&cell, numbers, sizeof cell);
    return cell;
}

detail::CellPlace<double> place_of(const GridCell& cell, double station_m,
                                   const PhysicalParams& model)
{
    auto place =
        detail::station_place(model.sky_view * cell.sky_view * horizon_sky_view(model.horizon),
                              model.precip_factor * cell.precip_factor);
    place.height_difference_m = cell.elevation_m - station_m;
    if (place.height_difference_m != 0.0) {
        place.pressure_factor =
            standard_pressure_pa(cell.elevation_m) / standard_pressure_pa(station_m);
    }
    const auto slope = detail::sine_cosine(cell.slope_rad);
    const auto aspect = detail::sine_cosine(cell.aspect_rad);
    place.normal_east = slope.sin * aspect.sin;
    place.normal_north = slope.sin * aspect.cos;
    place.normal_up = slope.cos;
    place.air_offset_k = cell.air_offset_k;
    place.wind_factor = cell.wind_factor;
    place.shortwave_factor = cell.shortwave_factor;
    place.longwave_offset = cell.longwave_offset_w_m2;
    return place;
}

}  // namespace

struct PhysicalGrid::Impl {
    struct Group {  // blocks with one surface
        detail::CellConstants constants;
        detail::StepConstants whole, tail;
        std::size_t first = 0, count = 0;
    };
    PhysicalParams model;
    int threads = 1;
    std::vector<detail::StepForcing> steps;
    std::vector<Group> groups;
    std::vector<CellBlock> blocks;
    std::vector<PlaceBlock> places;
    std::vector<std::uint32_t> group_of;    // of a block
    std::vector<std::size_t> slot_of_cell;  // block * 8 + lane
    std::size_t step = 0;

    void run_block(std::size_t b, std::size_t from, std::size_t to)
    {
        const Group& group = groups[group_of[b]];
        const auto advance = detail::fastest_advance_block();
        const bool tail = to == steps.size() && steps.back().dt_s != group.whole.dt_s;
        const std::size_t whole_to = tail ? to - 1 : to;
        if (whole_to > from)
            advance(blocks[b], places[b], &steps[from], whole_to - from, group.constants,
                    group.whole);
        if (tail) advance(blocks[b], places[b], &steps[to - 1], 1, group.constants, group.tail);
    }
};

PhysicalGrid::PhysicalGrid(const ForcingTable& table, const GridParams& params,
                           std::span<const GridCell> cells)
    : impl_(std::make_unique<Impl>())
{
    if (cells.empty()) throw Error("grid: there are no cells", "Give at least one cell.");
    if (params.surfaces.empty())
        throw Error("grid: there is no surface", "Give at least one surface.");
    if (params.threads < 1 || params.threads > 1024) {
        throw Error("grid: threads must be 1..1024, got " + std::to_string(params.threads),
                    "Give the number of cores to use.");
    }
    if (table.rows() == 0 || !table.has(Field::Longwave) || !table.has(Field::Precip)) {
        throw Error("grid: the forcing table is not complete",
                    "Call fill_forcing on the table first.");
    }
    if (!params.model.events.empty()) {
        throw Error("grid: road events are of one cell, not of ensembles and landscapes",
                    "Leave the events out.");
    }
    for (const GridCell& cell : cells) {
        const double numbers[] = {cell.elevation_m,      cell.slope_rad,           cell.aspect_rad,
                                  cell.precip_factor,    cell.air_offset_k,        cell.wind_factor,
                                  cell.shortwave_factor, cell.longwave_offset_w_m2};
        const bool finite = std::all_of(std::begin(numbers), std::end(numbers),
                                        [](double v) { return std::isfinite(v); });
        if (!finite || !(cell.sky_view >= 0.0 && cell.sky_view <= 1.0) ||
            cell.surface >= params.surfaces.size() || cell.precip_factor < 0.0 ||
            cell.wind_factor < 0.0 || cell.shortwave_factor < 0.0) {
            throw Error("grid: cell " + std::to_string(&cell - cells.data()) +
                            " has a value that cannot be used",
                        "Give finite numbers, sky_view in 0..1, factors of 0 or more and a surface "
                        "index below " +
                            std::to_string(params.surfaces.size()) + ".");
        }
    }
    if (!params.model.horizon.empty() &&
        (std::isnan(table.site.latitude_deg) || std::isnan(table.site.longitude_deg))) {
        throw Error("grid: a horizon without a place: where the sun stands is not known",
                    "Give latitude and longitude.");
    }
    Impl& m = *impl_;
    m.model = params.model;
    m.threads = params.threads;
    m.steps = detail::make_step_forcings(
        table, static_cast<std::int64_t>(std::llround(params.model.step_s * 1e6)),
        params.model.horizon);
    const double station = std::isnan(table.site.elevation_m) ? 0.0 : table.site.elevation_m;
    const double deep = std::isnan(m.model.deep_temp_k)
                            ? kZeroCelsiusK + detail::yearly_wave(table).mean_c
                            : m.model.deep_temp_k;
    m.slot_of_cell.resize(cells.size());
    for (std::size_t s = 0; s < params.surfaces.size(); ++s) {
        PhysicalParams one = params.model;
        one.surface = params.surfaces[s];
        check_params(one);
        std::vector<std::size_t> members;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (cells[i].surface == s) members.push_back(i);
        }
        if (members.empty()) continue;
        Impl::Group group;
        group.constants = detail::make_cell_constants(one, table.site, deep);
        group.whole =
            detail::make_step_constants(group.constants, m.steps.front().dt_s, one.substep_s);
        group.tail =
            detail::make_step_constants(group.constants, m.steps.back().dt_s, one.substep_s);
        group.first = m.blocks.size();
        group.count = (members.size() + kLanes - 1) / kLanes;
        const CellState initial = detail::initial_cell(table, group.constants);
        for (std::size_t b = 0; b < group.count; ++b) {
            CellBlock block;
            PlaceBlock place_block;
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                // Spare lanes repeat the last cell.
                const std::size_t cell = members[std::min(b * kLanes + lane, members.size() - 1)];
                const auto place = place_of(cells[cell], station, one);
                double numbers[detail::kPlaceNumbers];
                std::memcpy(numbers, &place, sizeof place);
                for (std::size_t i = 0; i < detail::kPlaceNumbers; ++i)
                    place_block.numbers[i][lane] = numbers[i];
                // Higher ground starts colder.
                CellState start = initial;
                const double shift =
                    -kLapseRate_k_m * place.height_difference_m + place.air_offset_k;
                if (shift != 0.0) {
                    start.surface_temp_c += shift;
                    double depth = 0.0;
                    for (std::size_t g = 0; g < kGroundLayers; ++g) {
                        depth += kGroundThickness_m[g];
                        start.ground_temp_c[g] += shift * (1.0 - depth / 6.0);
                    }
                }
                put_cell(block, lane, start);
                if (b * kLanes + lane < members.size())
                    m.slot_of_cell[cell] = m.blocks.size() * kLanes + lane;
            }
            m.blocks.push_back(block);
            m.places.push_back(place_block);
            m.group_of.push_back(static_cast<std::uint32_t>(m.groups.size()));
        }
        m.groups.push_back(std::move(group));
    }
}

PhysicalGrid::PhysicalGrid(PhysicalGrid&&) noexcept = default;
PhysicalGrid& PhysicalGrid::operator=(PhysicalGrid&&) noexcept = default;
PhysicalGrid::~PhysicalGrid() = default;

std::size_t PhysicalGrid::cells() const
{
    return impl_->slot_of_cell.size();
}
std::size_t PhysicalGrid::steps() const
{
    return impl_->steps.size();
}
std::size_t PhysicalGrid::step() const
{
    return impl_->step;
}

std::int64_t PhysicalGrid::time_us() const
{
    if (impl_->step < impl_->steps.size()) return impl_->steps[impl_->step].begin_us;
    return impl_->steps.back().begin_us +
           static_cast<std::int64_t>(std::llround(impl_->steps.back().dt_s * 1e6));
}

void PhysicalGrid::advance(std::size_t count)
{
    Impl& m = *impl_;
    const std::size_t from = m.step;
    const std::size_t to = std::min(from + count, m.steps.size());
    if (to == from) return;
    // Whole blocks through all steps: their state stays in the cache. Blocks are independent, so
    // which thread takes which does not matter.
    const std::size_t workers = std::min(static_cast<std::size_t>(m.threads), m.blocks.size());
    const auto work = [&](std::size_t worker) {
        for (std::size_t b = worker; b < m.blocks.size(); b += workers) m.run_block(b, from, to);
    };
    std::vector<std::thread> threads;
    for (std::size_t w = 1; w < workers; ++w) threads.emplace_back(work, w);
    work(0);
    for (std::thread& t : threads) t.join();
    m.step = to;
}

CellState PhysicalGrid::state(std::size_t cell) const
{
    const std::size_t slot = impl_->slot_of_cell.at(cell);
    return get_cell(impl_->blocks[slot / kLanes], slot % kLanes);
}

std::uint64_t PhysicalGrid::hash() const
{
    return state_hash(save());
}

std::size_t PhysicalGrid::bytes() const
{
    return impl_->blocks.size() * (sizeof(CellBlock) + sizeof(PlaceBlock)) +
           impl_->slot_of_cell.size() * sizeof(std::size_t) +
           impl_->steps.size() * sizeof(detail::StepForcing);
}

std::vector<CellState> PhysicalGrid::save() const
{
    std::vector<CellState> out(cells());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = state(i);
    return out;
}

void PhysicalGrid::restore(std::span<const CellState> states, std::size_t step)
{
    if (states.size() != cells() || step > steps()) {
        throw Error("grid: the saved states do not fit: " + std::to_string(states.size()) +
                        " for " + std::to_string(cells()) + " cells",
                    "Restore states that were saved from the same grid and weather.");
    }
    for (std::size_t i = 0; i < states.size(); ++i) {
        const std::size_t slot = impl_->slot_of_cell[i];
        put_cell(impl_->blocks[slot / kLanes], slot % kLanes, states[i]);
    }
    impl_->step = step;
}

std::vector<GridCell> make_grid_cells(std::span<const float> heights_m, std::size_t width,
                                      std::size_t height, double spacing_m)
{
    if (width == 0 || height == 0 || heights_m.size() != width * height) {
        throw Error("grid: " + std::to_string(heights_m.size()) + " heights for " +
                        std::to_string(width) + " x " + std::to_string(height) + " cells",
                    "Give one height a cell.");
    }
    if (!(spacing_m > 0.0) || !std::isfinite(spacing_m)) {
        throw Error(
            "grid: the spacing of cells must be above 0 m, got " + std::to_string(spacing_m),
            "Give the distance between cells in metres.");
    }
    for (const float h : heights_m) {
        if (!std::isfinite(h))
            throw Error("grid: a height is not finite",
                        "Fill the holes of the height field first.");
    }
    const auto at = [&](std::ptrdiff_t x, std::ptrdiff_t y) {
        const auto cx = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(x, 0, static_cast<std::ptrdiff_t>(width) - 1));
        const auto cy = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(y, 0, static_cast<std::ptrdiff_t>(height) - 1));
        return static_cast<double>(heights_m[cy * width + cx]);
    };
    std::vector<GridCell> cells(width * height);
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const auto x = static_cast<std::ptrdiff_t>(column);
            const auto y = static_cast<std::ptrdiff_t>(row);
            GridCell& cell = cells[row * width + column];
            cell.elevation_m = at(x, y);
            const double span_x =
                static_cast<double>(
                    std::min<std::ptrdiff_t>(x + 1, static_cast<std::ptrdiff_t>(width) - 1) -
                    std::max<std::ptrdiff_t>(x - 1, 0)) *
                spacing_m;
            const double span_y =
                static_cast<double>(
                    std::min<std::ptrdiff_t>(y + 1, static_cast<std::ptrdiff_t>(height) - 1) -
                    std::max<std::ptrdiff_t>(y - 1, 0)) *
                spacing_m;
            const double east = span_x > 0.0 ? (at(x + 1, y) - at(x - 1, y)) / span_x : 0.0;
            const double north = span_y > 0.0 ? (at(x, y - 1) - at(x, y + 1)) / span_y : 0.0;
            cell.slope_rad = std::atan(std::hypot(east, north));
            // The slope faces downhill.
            cell.aspect_rad = cell.slope_rad > 0.0 ? std::atan2(-east, -north) : 0.0;
            if (cell.aspect_rad < 0.0) cell.aspect_rad += 2.0 * kPi;
            // Sky view: mean of cos^2 of the horizon's elevation over eight directions, up to 20
            // cells away.
            double open = 0.0;
            constexpr std::array<std::array<int, 2>, 8> kDirections{
                {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
            for (const auto& d : kDirections) {
                double steepest = 0.0;
                const double unit = spacing_m * std::hypot(d[0], d[1]);
                for (int n = 1; n <= 20; ++n) {
                    const auto px = x + n * d[0], py = y + n * d[1];
                    if (px < 0 || py < 0 || px >= static_cast<std::ptrdiff_t>(width) ||
                        py >= static_cast<std::ptrdiff_t>(height))
                        break;
                    steepest = std::max(steepest, (at(px, py) - cell.elevation_m) / (unit * n));
                }
                open += 1.0 / (1.0 + steepest * steepest);
            }
            cell.sky_view = open / 8.0;
        }
    }
    return cells;
}

}  // namespace petrichor::weather
