// Grids of physical cells: the bits of a cell alone, and what a landscape does.
#include "weather/models/physical/physical_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/weather/made_up.h"
#include "tests/weather/winters.h"
#include "weather/models/physical/detail/cell_steps.h"

namespace petrichor::weather {
namespace {

using testing_weather::kHourUs;
using testing_weather::rough_year;
using namespace testing_winters;

std::vector<GridCell> hills(std::size_t count)
{
    std::vector<GridCell> cells(count);
    for (std::size_t i = 0; i < count; ++i) {
        cells[i].elevation_m = 600 + 10.0 * static_cast<double>(i % 100);
        cells[i].slope_rad = 0.01 * static_cast<double>(i % 30);
        cells[i].aspect_rad = 0.4 * static_cast<double>(i % 16);
        cells[i].sky_view = 1.0 - 0.01 * static_cast<double>(i % 20);
        cells[i].surface = static_cast<std::uint32_t>(i % 3 == 0);
    }
    cells[0] = {};
    cells[0].elevation_m = 600;
    return cells;
}
GridParams two_surfaces(int threads)
{
    GridParams p;
    p.surfaces = {surface_preset("grass"), surface_preset("asphalt")};
    p.threads = threads;
    return p;
}

TEST(Grid, TheSameBitsAsOneCellAndForAnyNumberOfThreads)
{
    const ForcingTable table = rough_year(1500);
    const auto cells = hills(101);
    PhysicalGrid one(table, two_surfaces(1), cells);
    one.advance(one.steps());
    const PhysicalTimeline alone(table, meadow());
    EXPECT_EQ(state_hash(one.state(0)), state_hash(alone.state_at(alone.end_us())));
    for (const int threads : {2, 3, 8}) {
        PhysicalGrid many(table, two_surfaces(threads), cells);
        many.advance(700);
        many.advance(many.steps());
        EXPECT_EQ(many.hash(), one.hash()) << threads;
    }
    PhysicalGrid part(table, two_surfaces(2), cells);
    part.advance(333);
    PhysicalGrid rest(table, two_surfaces(1), cells);
    rest.restore(part.save(), part.step());
    rest.advance(rest.steps());
    EXPECT_EQ(rest.hash(), one.hash());
}

// Work that a neighbour in the block asks for must not change a cell.
TEST(Grid, NeighboursDoNotMatter)
{
    const ForcingTable table = rough_year(1500);
    const auto cells = hills(40);
    PhysicalGrid all(table, two_surfaces(1), cells);
    all.advance(all.steps());
    for (std::size_t i = 0; i < cells.size(); i += 3) {
        PhysicalGrid alone(table, two_surfaces(1), {&cells[i], 1});
        alone.advance(alone.steps());
        EXPECT_EQ(state_hash(alone.state(0)), state_hash(all.state(i))) << i;
    }
}

TEST(Grid, NarrowAndWideRegistersAgree)
{
    if (!detail::machine_has_wide_registers()) GTEST_SKIP() << "this machine has no AVX2";
    const ForcingTable table = rough_year(600);
    const PhysicalParams params = meadow();
    const auto k = detail::make_cell_constants(params, table.site, 280);
    const auto s = detail::make_step_constants(k, 3600, 600);
    const auto steps = detail::make_step_forcings(table, 3600 * 1000000LL);
    detail::CellBlock narrow{}, wide{};
    detail::PlaceBlock places{};
    const CellState start = detail::initial_cell(table, k);
    for (std::size_t lane = 0; lane < 8; ++lane) {
        auto place = detail::station_place();
        place.height_difference_m = 100.0 * static_cast<double>(lane);
        const auto* p = reinterpret_cast<const double*>(&place);
        for (std::size_t i = 0; i < detail::kPlaceNumbers; ++i) places.numbers[i][lane] = p[i];
        const auto* c = reinterpret_cast<const double*>(&start);
        for (std::size_t i = 0; i < kCellNumbers; ++i) narrow.numbers[i][lane] = c[i];
    }
    const detail::CellBlock first = narrow;
    wide = first;
    detail::advance_block_16(narrow, places, steps.data(), steps.size(), k, s);
    detail::advance_block_32(wide, places, steps.data(), steps.size(), k, s);
    const auto expect_narrow = [&](const char* registers) {
        for (std::size_t i = 0; i < kCellNumbers; ++i) {
            for (std::size_t lane = 0; lane < 8; ++lane)
                ASSERT_EQ(narrow.numbers[i][lane], wide.numbers[i][lane])
                    << registers << ": " << i << " " << lane;
        }
    };
    expect_narrow("AVX2");
    if (!detail::machine_has_widest_registers()) return;
    wide = first;
    detail::advance_block_64(wide, places, steps.data(), steps.size(), k, s);
    expect_narrow("AVX-512");
}

TEST(Grid, HigherIsWhiterAndSouthIsWarmer)
{
    const ForcingTable table = rough_year(2000);
    std::vector<GridCell> cells(4);
    for (auto& c : cells) c.elevation_m = 600;
    cells[1].elevation_m = 1600;
    cells[2].slope_rad = cells[3].slope_rad = 0.5;
    cells[2].aspect_rad = 0.0;         // north
    cells[3].aspect_rad = 3.14159265;  // south
    GridParams params;
    params.surfaces = {surface_preset("grass")};
    PhysicalGrid grid(table, params, cells);
    double swe[4] = {};
    while (grid.step() < grid.steps()) {
        grid.advance(24);
        for (std::size_t i = 0; i < 4; ++i) swe[i] += diagnostics(grid.state(i)).swe_kg_m2;
    }
    EXPECT_GT(swe[1], 1.05 * swe[0]);
    EXPECT_GT(swe[2], swe[3]);
}

TEST(Grid, CellsFromAHeightField)
{
    // A plane that rises to the east by 0.5: it faces west.
    std::vector<float> heights(20 * 10);
    for (std::size_t y = 0; y < 10; ++y) {
        for (std::size_t x = 0; x < 20; ++x) heights[y * 20 + x] = static_cast<float>(5 * x);
    }
    const auto cells = make_grid_cells(heights, 20, 10, 10.0);
    EXPECT_NEAR(cells[105].slope_rad, std::atan(0.5), 1e-6);
    EXPECT_NEAR(cells[105].aspect_rad, 1.5 * 3.14159265, 1e-6);
    EXPECT_LT(cells[105].sky_view, 1.0);
    EXPECT_GT(cells[105].sky_view, 0.8);
    EXPECT_THROW(make_grid_cells(heights, 19, 10, 10.0), Error);
    heights[3] = NAN;
    EXPECT_THROW(make_grid_cells(heights, 20, 10, 10.0), Error);
}

}  // namespace
}  // namespace petrichor::weather
