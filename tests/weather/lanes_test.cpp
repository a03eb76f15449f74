// Which registers a cell shares, and with whom, must not show in its bits.
#include "weather/physics/detail/lanes.h"

#include <gtest/gtest.h>

#include "tests/weather/made_up.h"
#include "weather/models/physical/detail/cell_steps.h"
#include "weather/models/physical/physical_grid.h"

namespace petrichor::weather {
namespace {

using testing_weather::rough_year;

// From bare valleys to deep snow.
std::vector<GridCell> mountainside(std::size_t count)
{
    std::vector<GridCell> cells(count);
    for (std::size_t i = 0; i < count; ++i) {
        cells[i].elevation_m = 400 + 2400.0 * static_cast<double>(i) / static_cast<double>(count);
        cells[i].slope_rad = 0.02 * static_cast<double>(i % 20);
        cells[i].aspect_rad = 0.7 * static_cast<double>(i % 9);
        cells[i].surface = static_cast<std::uint32_t>(i % 2);
    }
    return cells;
}

TEST(Lanes, AnyOrderOfCellsGivesTheSameBits)
{
    const ForcingTable table = rough_year();
    const std::vector<GridCell> cells = mountainside(64);
    GridParams params;
    params.surfaces = {surface_preset("grass"), surface_preset("asphalt")};
    std::vector<GridCell> mixed;
    const auto place = [&](std::size_t i) { return i * 37 % cells.size(); };
    for (std::size_t i = 0; i < cells.size(); ++i) mixed.push_back(cells[place(i)]);
    PhysicalGrid sorted(table, params, cells), shuffled(table, params, mixed);
    while (sorted.step() < sorted.steps()) {
        sorted.advance(730);
        shuffled.advance(730);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            ASSERT_EQ(state_hash(shuffled.state(i)), state_hash(sorted.state(place(i))))
                << "cell " << i << " before step " << sorted.step();
        }
    }
}

TEST(Lanes, OneCellWithAndWithoutWideRegisters)
{
    if (!detail::machine_has_wide_registers()) GTEST_SKIP() << "this machine has no AVX2";
    const ForcingTable table = rough_year();
    PhysicalParams params;
    params.surface = surface_preset("grass");
    const auto k = detail::make_cell_constants(params, table.site, 280);
    const auto s = detail::make_step_constants(k, 3600, 600);
    const auto steps = detail::make_step_forcings(table, testing_weather::kHourUs);
    const auto place = detail::station_place();
    CellState plain = detail::initial_cell(table, k), wide = plain;
    for (const auto& step : steps) {
        if (step.dt_s != s.dt_s) continue;
        detail::advance_cell_plain(plain, place, &step, 1, k, s);
        detail::advance_cell_wide(wide, place, &step, 1, k, s);
        ASSERT_EQ(state_hash(wide), state_hash(plain)) << step.begin_us;
    }
}

}  // namespace
}  // namespace petrichor::weather
