// Which registers a cell shares, and with whom, must not show in its bits.
#include "weather/physics/detail/lanes.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/weather/made_up.h"
#include "weather/models/physical/detail/cell_steps.h"
#include "weather/models/physical/physical_grid.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/step_forcing.h"

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

// Steps between rows that lie off the hour: means by the trapezoids between rows and ends, and by
// value_at, which looks for each of them by itself; before the first row and after the last too.
TEST(StepForcings, RowsOffTheHourAreMeansOfTheirPieces)
{
    constexpr std::int64_t kMinute_us = 60 * 1000000LL;
    ForcingTable table = testing_weather::rough_year(60);
    for (std::size_t i = 0; i < table.rows(); ++i)
        table.time_us[i] =
            table.time_us[0] + static_cast<std::int64_t>(i * 37 + i * i % 29) * kMinute_us;
    const auto check = [&](std::int64_t begin) {
        const std::int64_t end = begin + testing_weather::kHourUs;
        const auto step = detail::make_step_forcing(table, begin, end - begin,
                                                    detail::SunUse::FlatOpenGround, {});
        std::vector<std::int64_t> ends{begin};
        for (const std::int64_t t : table.time_us)
            if (t > begin && t < end) ends.push_back(t);
        ends.push_back(end);
        double sum = 0.0;
        for (std::size_t i = 0; i + 1 < ends.size(); ++i)
            sum += 0.5 *
                   (value_at(table, Field::AirTemp, ends[i]) +
                    value_at(table, Field::AirTemp, ends[i + 1])) *
                   static_cast<double>(ends[i + 1] - ends[i]);
        EXPECT_DOUBLE_EQ(step.air_c.at(0.5) + kZeroCelsiusK, sum / static_cast<double>(end - begin))
            << begin;
        EXPECT_EQ(step.air_c.rise, value_at(table, Field::AirTemp, end) -
                                       value_at(table, Field::AirTemp, begin));
    };
    for (int i = -3; i < 42; ++i)
        check(table.time_us[0] + i * testing_weather::kHourUs + 11 * kMinute_us);
}

}  // namespace
}  // namespace petrichor::weather
