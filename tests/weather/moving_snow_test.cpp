// Snow that slides from roofs and snow that the wind carries.
#include "weather/patches/moving_snow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/weather/street.h"
#include "weather/patches/patch_weather.h"

namespace petrichor::weather {
namespace {

using testing_weather::refill;
using testing_weather::steady;
using testing_weather::Street;

TEST(SlidePull, GrowsWithTheSlopeAndWithSmoothness)
{
    EXPECT_NEAR(slide_pull(30.0, 15.0), std::tan(15.0 * kPi / 180.0), 1e-12);
    EXPECT_NEAR(slide_pull(90.0, 40.0), 1.0, 1e-12);
    EXPECT_EQ(slide_pull(14.9, 15.0), 0.0);
    EXPECT_EQ(slide_pull(0.0, 15.0), 0.0);
    for (int tilt = 16; tilt < 90; ++tilt) {
        EXPECT_GT(slide_pull(tilt, 15.0), slide_pull(tilt - 1, 15.0));
        EXPECT_LT(slide_pull(tilt, 15.0), slide_pull(tilt, 14.0));
    }
}

TEST(BlowingSnow, IsThatOfPomeroyAndGray)
{
    EXPECT_NEAR(saltation_kg_m_s(0.4, 0.25, 1.3), 5.49e-3, 5e-6);
    EXPECT_EQ(saltation_kg_m_s(0.25, 0.25, 1.3), 0.0);
    EXPECT_EQ(saltation_kg_m_s(0.1, 0.25, 1.3), 0.0);
    EXPECT_NEAR(snow_friction_m_s(10.0), 0.4343, 1e-4);
    EXPECT_EQ(snow_friction_m_s(0.0), 0.0);
}

// What came to a patch from others, kg/m2: what it holds less what fell and what left it.
double came_from_elsewhere(const PatchState& s)
{
    const CellState& c = s.cell;
    return stored_mass_kg_m2(c) + c.total_evaporation + c.total_sublimation +
           c.total_infiltration + c.total_drainage - c.total_precip;
}

// A roof of columns, each from the ridge down to ground of its own.
struct Roof {
    std::size_t columns, rows;
    Street street;
    std::vector<std::uint32_t> on_roof;  // by column, from the ridge down

    Roof(double tilt_deg, double rest_deg, std::size_t columns_, std::size_t rows_)
        : columns(columns_), rows(rows_)
    {
        const double tilt = tilt_deg * kPi / 180.0;
        street.set.kinds[2].slides_above_deg = rest_deg;
        const auto number = [&](std::size_t c, std::size_t r) {
            return static_cast<std::uint32_t>(c * (rows + 1) + r);
        };
        std::vector<std::uint32_t>& begin = street.set.beside_begin;
        begin = {0};
        for (std::size_t c = 0; c < columns; ++c) {
            for (std::size_t r = 0; r < rows; ++r) {
                WeatherPatch& p = street.add({std::sin(tilt), std::cos(tilt), 0}, 2);
                p.height_m = 10.0 - 0.5 * static_cast<double>(r);
                p.runs_to = number(c, r + 1);
                on_roof.push_back(number(c, r));
                const auto beside = [&](std::size_t to_c, std::size_t to_r) {
                    street.set.beside.push_back(number(to_c, to_r));
                    street.set.beside_m.push_back(1.0f);
                };
                if (r > 0) beside(c, r - 1);
                if (r + 1 < rows) beside(c, r + 1);
                if (c > 0) beside(c - 1, r);
                if (c + 1 < columns) beside(c + 1, r);
                begin.push_back(static_cast<std::uint32_t>(street.set.beside.size()));
            }
            street.add().area_m2 = 4.0;
            begin.push_back(static_cast<std::uint32_t>(street.set.beside.size()));
        }
    }
};

// 20 hours of snow in frost, then a thaw from hour 30 on.
ForcingTable winter_and_thaw(double thaw_c = 5.0)
{
    ForcingTable table = steady(60, -2.0, 0.0, 1.0, 240, 1.0);
    for (std::size_t i = 0; i < 20; ++i) table[Field::Precip][i] = 2.0 / 3600.0;
    for (std::size_t i = 30; i < table.rows(); ++i)
        table[Field::AirTemp][i] = kZeroCelsiusK + thaw_c;
    refill(table);
    return table;
}

double snow_on(const PatchWeather& patches, std::size_t i)
{
    return diagnostics(patches.state(i).cell).swe_kg_m2;
}

// The hour at which a patch was first seen without most of its snow; 60: never.
std::vector<double> hours_of_sliding(const Roof& roof, const ForcingTable& table)
{
    PatchWeather patches(table, roof.street.set, {}, table.time_us.front());
    patches.go_to(table.time_us[29]);
    std::vector<double> full, hours(roof.on_roof.size(), 60.0);
    for (const std::uint32_t i : roof.on_roof) full.push_back(snow_on(patches, i));
    for (std::size_t hour = 30; hour < 60; ++hour) {
        patches.go_to(table.time_us[hour]);
        const PatchLedger books = patches.ledger();
        EXPECT_LE(std::abs(books.residual()), 1e-9 * books.fallen);
        for (std::size_t k = 0; k < hours.size(); ++k)
            if (hours[k] == 60.0 && snow_on(patches, roof.on_roof[k]) < 0.02 * full[k])
                hours[k] = static_cast<double>(hour);
    }
    return hours;
}
double mean_of(const std::vector<double>& values)
{
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

TEST(SlidingSnow, LeavesARoofPartByPartOverHours)
{
    const Roof roof(25.0, 15.0, 30, 6);
    const ForcingTable table = winter_and_thaw();
    const std::vector<double> hours = hours_of_sliding(roof, table);
    const auto [first, last] = std::minmax_element(hours.begin(), hours.end());
    EXPECT_GE(*first, 31.0);  // the base has to be wet
    EXPECT_GE(*last - *first, 4.0);
    for (double hour = 30.0; hour < 60.0; hour += 1.0) {
        const auto at_once = std::count(hours.begin(), hours.end(), hour);
        EXPECT_LT(static_cast<double>(at_once), 0.6 * static_cast<double>(hours.size())) << hour;
    }
    // A slab takes along what lies below it: whoever is bare has nobody with snow below.
    for (std::size_t c = 0; c < roof.columns; ++c)
        for (std::size_t r = 1; r < roof.rows; ++r)
            EXPECT_LE(hours[c * roof.rows + r], hours[c * roof.rows + r - 1]) << c << " " << r;
    // It goes in pieces, not patch by patch: neighbours along the eaves often go in the same hour.
    int together = 0;
    for (std::size_t c = 1; c < roof.columns; ++c)
        together += hours[c * roof.rows + 5] == hours[(c - 1) * roof.rows + 5] ? 1 : 0;
    EXPECT_GE(together, 8);
    EXPECT_LT(together, 25);
}

TEST(SlidingSnow, LiesBelowTheEavesAfterwards)
{
    const Roof roof(35.0, 15.0, 6, 4);
    const ForcingTable table = winter_and_thaw();
    PatchWeather patches(table, roof.street.set, {}, table.time_us.front());
    PatchSet rough = roof.street.set;
    for (PatchKind& kind : rough.kinds) kind.slides_above_deg = 90.0;
    PatchWeather stays(table, rough, {}, table.time_us.front());
    patches.go_to(table.time_us[45]);
    stays.go_to(table.time_us[45]);
    double gone = 0.0, more = 0.0;
    for (std::size_t i = 0; i < patches.patches(); ++i) {
        const double area = roof.street.set.patches[i].area_m2;
        const double came = came_from_elsewhere(patches.state(i)) * area;
        (came < 0.0 ? gone : more) += came;
        // What a roof sheds as water comes too; without slides no ground has more than that.
        if (i % 5 == 4) {
            EXPECT_GT(snow_on(patches, i), snow_on(stays, i) + 1.0) << i;
        }
    }
    EXPECT_LT(gone, -100.0);
    const PatchLedger books = patches.ledger();
    EXPECT_LE(std::abs(books.residual()), 1e-9 * books.fallen);
}

// Below one strip of a roof, on ground of 5 x 5 patches as small as those of a picture, too flat a heap to slide on by itself. A kerb at
// its side gets some, a wall behind that none.
TEST(SlidingSnow, BreaksIntoAHeapWithSoftSides)
{
    constexpr int kSide = 5, kMiddle = 2;
    constexpr double kStep_m = 0.35, kArea_m2 = kStep_m * kStep_m;
    const double tilt = 35.0 * kPi / 180.0;
    Street street;
    street.set.kinds[2].slides_above_deg = 15.0;
    const auto number = [](int x, int z) { return static_cast<std::uint32_t>(1 + z * kSide + x); };
    WeatherPatch& roof = street.add({std::sin(tilt), std::cos(tilt), 0}, 2);
    roof.height_m = 5.0;
    roof.area_m2 = kArea_m2;
    roof.runs_to = number(kMiddle, kMiddle);
    std::vector<std::uint32_t>& begin = street.set.beside_begin;
    begin = {0, 0};
    for (int z = 0; z < kSide; ++z) {
        for (int x = 0; x < kSide; ++x) {
            WeatherPatch& p = x < 4 ? street.add() : street.add({-1, 0, 0});
            p.area_m2 = kArea_m2;
            p.height_m = x == 3 ? 0.12 : 0.0;
            for (const auto& [to_x, to_z] : {std::pair(x + 1, z), std::pair(x - 1, z), std::pair(x, z + 1), std::pair(x, z - 1)}) {
                if (to_x < 0 || to_z < 0 || to_x >= kSide || to_z >= kSide) continue;
                street.set.beside.push_back(number(to_x, to_z));
                street.set.beside_m.push_back(static_cast<float>(kStep_m));
            }
            begin.push_back(static_cast<std::uint32_t>(street.set.beside.size()));
        }
    }
    const ForcingTable table = winter_and_thaw();
    PatchSet rough = street.set;
    for (PatchKind& kind : rough.kinds) kind.slides_above_deg = 90.0;
    PatchWeather slides(table, street.set, {}, table.time_us.front()), stays(table, rough, {}, table.time_us.front());
    slides.go_to(table.time_us[29]);
    const double fell = snow_on(slides, 0);
    std::size_t hour = 30;
    do {
        slides.go_to(table.time_us[hour]);
        stays.go_to(table.time_us[hour]);
    } while (snow_on(slides, 0) > 0.02 * fell && ++hour < 59);
    ASSERT_LT(hour, 59u) << "it has slid";
    const auto more = [&](int x, int z) { return snow_on(slides, number(x, z)) - snow_on(stays, number(x, z)); };
    EXPECT_GT(more(2, 2), 0.25 * fell);
    EXPECT_LT(more(2, 2), 0.55 * fell);
    for (const auto& [x, z] : {std::pair(1, 2), std::pair(2, 1), std::pair(2, 3), std::pair(3, 2)}) EXPECT_GT(more(x, z), 0.06 * fell) << x << " " << z;
    EXPECT_NEAR(more(1, 1), more(1, 3), 1e-9);
    EXPECT_GT(more(1, 1), 0.005 * fell);
    EXPECT_LT(more(1, 1), more(1, 2));
    EXPECT_NEAR(more(4, 2), 0.0, 0.002 * fell) << "a wall";
    EXPECT_NEAR(more(0, 0), 0.0, 0.002 * fell);
    EXPECT_LE(std::abs(slides.ledger().residual()), 1e-9 * slides.ledger().fallen);
}

TEST(SlidingSnow, SteeperAndSmootherRoofsGoFirstAndFlatterThanTheirRestNever)
{
    const ForcingTable table = winter_and_thaw();
    const auto mean_hour = [&](double tilt_deg, double rest_deg) {
        // One row: none is taken along by another.
        return mean_of(hours_of_sliding(Roof(tilt_deg, rest_deg, 64, 1), table));
    };
    const double flat = mean_hour(20.0, 15.0), middle = mean_hour(27.0, 15.0),
                 steep = mean_hour(40.0, 15.0), rough = mean_hour(40.0, 30.0);
    EXPECT_LT(steep, middle - 0.5);
    EXPECT_LT(middle, flat - 0.5);
    EXPECT_LT(steep, rough - 0.5);
    // At their angle of rest and below they keep what a roof that sheds nothing keeps.
    for (const double tilt : {10.0, 15.0}) {
        const Roof roof(tilt, 15.0, 4, 2), holds(tilt, 90.0, 4, 2);
        PatchWeather patches(table, roof.street.set, {}, table.time_us.front());
        PatchWeather same(table, holds.street.set, {}, table.time_us.front());
        patches.go_to(table.time_us[50]);
        same.go_to(table.time_us[50]);
        for (const std::uint32_t i : roof.on_roof)
            EXPECT_EQ(snow_on(patches, i), snow_on(same, i)) << tilt;
    }
}

TEST(SlidingSnow, HoldsWhileItsBaseIsFrozen)
{
    ForcingTable table = steady(60, -6.0, 0.0, 1.0, 240, 1.0);
    for (std::size_t i = 0; i < 20; ++i) table[Field::Precip][i] = 2.0 / 3600.0;
    refill(table);
    std::fill(table[Field::Shortwave].begin(), table[Field::Shortwave].end(), 0.0);
    const Roof roof(45.0, 15.0, 6, 4);
    PatchWeather patches(table, roof.street.set, {}, table.time_us.front());
    patches.go_to(table.time_us[59]);
    for (const std::uint32_t i : roof.on_roof) EXPECT_GT(snow_on(patches, i), 5.0) << i;
}

// A square of open ground, four patches behind a wall in the west.
PatchSet square(bool wall)
{
    Street street;
    for (int i = 0; i < 24; ++i) {
        WeatherPatch& p = street.add();
        p.area_m2 = 10.0;
        if (!wall || i < 20) continue;
        for (int k = 0; k < kVisibleBits; ++k) {
            const Direction d = visible_direction(k);
            if (d.x < 0.0 && d.y < 0.5)
                p.visible[static_cast<std::size_t>(k >> 5)] &= ~(1u << (k & 31));
        }
    }
    return street.set;
}
// Snow in a calm, then wind.
ForcingTable blizzard(double wind_m_s, double from_deg, double air_c = -8.0)
{
    ForcingTable table = steady(40, air_c, 0.0, 1.0, from_deg, 1.0);
    for (std::size_t i = 0; i < 20; ++i) table[Field::Precip][i] = 1.0 / 3600.0;
    for (std::size_t i = 22; i < table.rows(); ++i) table[Field::Wind][i] = wind_m_s;
    refill(table);
    std::fill(table[Field::Shortwave].begin(), table[Field::Shortwave].end(), 0.0);
    return table;
}

TEST(DriftingSnow, GoesFromTheOpenIntoTheLeeAndNoneIsLost)
{
    const ForcingTable table = blizzard(14.0, 270.0);
    PatchWeather patches(table, square(true), {}, table.time_us.front());
    patches.go_to(table.time_us[38]);
    double came = 0.0, moved = 0.0;
    for (std::size_t i = 0; i < patches.patches(); ++i) {
        const double here = came_from_elsewhere(patches.state(i));
        came += here * 10.0;
        moved += std::abs(here) * 5.0;
        if (i < 20) {
            EXPECT_LT(here, -0.5) << i;
        } else {
            EXPECT_GT(here, 2.0) << i;
        }
    }
    EXPECT_GT(moved, 50.0);
    EXPECT_NEAR(came, 0.0, 1e-9 * moved);
    const PatchLedger books = patches.ledger();
    EXPECT_LE(std::abs(books.residual()), 1e-9 * books.fallen);
    EXPECT_GT(diagnostics(patches.state(22).cell).snow_depth_m,
              1.5 * diagnostics(patches.state(3).cell).snow_depth_m);
    // The wall is no lee when the wind comes from the other side.
    const ForcingTable east = blizzard(14.0, 90.0);
    PatchWeather other(east, square(true), {}, east.time_us.front());
    other.go_to(east.time_us[38]);
    for (std::size_t i = 0; i < other.patches(); ++i)
        EXPECT_NEAR(came_from_elsewhere(other.state(i)), 0.0, 1e-9) << i;
}

TEST(DriftingSnow, LiesStillInCalmAndWhereThereIsNoLeeAndWhenItIsWet)
{
    const auto nothing_moves = [](const ForcingTable& table, bool wall) {
        PatchWeather patches(table, square(wall), {}, table.time_us.front());
        patches.go_to(table.time_us[38]);
        for (std::size_t i = 0; i < patches.patches(); ++i)
            EXPECT_NEAR(came_from_elsewhere(patches.state(i)), 0.0, 1e-9) << i;
    };
    nothing_moves(blizzard(0.0, 270.0), true);
    nothing_moves(blizzard(7.0, 270.0), true);  // Li & Pomeroy: 8.2 m/s at -8 C
    nothing_moves(blizzard(14.0, 270.0), false);
    ForcingTable thaw = blizzard(9.6, 270.0, -0.5);
    for (std::size_t i = 20; i < thaw.rows(); ++i) {
        thaw[Field::AirTemp][i] = kZeroCelsiusK + 3.0;
        if (i < 34) thaw[Field::Wind][i] = 1.0;
    }
    refill(thaw);
    nothing_moves(thaw, true);
}

TEST(LeeShare, AddsUpToOneAndLiesWithinTwelveHeights)
{
    for (const double height_m : {0.3, 2.0}) {
        double sum = 0.0, within = 0.0, most = 0.0, at_m = 0.0;
        const double step_m = 0.001 * height_m;
        for (double x = 0.5 * step_m; x < 60.0 * height_m; x += step_m) {
            const double here = lee_share_1_m(x, height_m);
            sum += here * step_m;
            if (x < 12.0 * height_m) within += here * step_m;
            if (here > most) {
                most = here;
                at_m = x;
            }
        }
        EXPECT_NEAR(sum, 1.0, 1e-5);
        EXPECT_NEAR(within, 1.0 - 7.0 * std::exp(-6.0), 1e-5);
        EXPECT_NEAR(at_m, 2.0 * height_m, 0.01 * height_m);
    }
    EXPECT_EQ(lee_share_1_m(0.0, 2.0), 0.0);
    EXPECT_EQ(lee_share_1_m(std::numeric_limits<double>::infinity(), 2.0), 0.0);
    EXPECT_EQ(lee_share_1_m(3.0, 0.0), 0.0);
}

// A long row of ground, 0.5 m a patch, behind a wall in the west: the first 40 m before it, the rest in its
// lee, as slow in the wind everywhere there.
PatchSet behind_a_wall(double height_m, std::size_t lee)
{
    Street street;
    for (std::size_t i = 0; i < 80 + lee; ++i) {
        WeatherPatch& p = street.add();
        p.area_m2 = 0.5;
        std::array<Upwind, kWindClasses> around{};
        if (i >= 80) {
            const auto behind_m = static_cast<float>(0.5 * (static_cast<double>(i - 80) + 0.5));
            around[12] = {behind_m, static_cast<float>(height_m)};
            for (int k = 0; k < kVisibleBits; ++k) {
                const Direction d = visible_direction(k);
                if (d.x < 0.0 && d.y < 0.5)
                    p.visible[static_cast<std::size_t>(k >> 5)] &= ~(1u << (k & 31));
            }
        }
        street.set.upwind.push_back(around);
    }
    return street.set;
}

TEST(DriftingSnow, LiesWithinSomeHeightsOfWhatStandsUpwind)
{
    const ForcingTable table = blizzard(14.0, 270.0);
    for (const double height_m : {1.0, 2.0}) {
        PatchWeather patches(table, behind_a_wall(height_m, 100), {}, table.time_us.front());
        patches.go_to(table.time_us[38]);
        double all = 0.0, within = 0.0, before = 0.0, most = 0.0;
        std::size_t deepest = 0;
        for (std::size_t i = 0; i < patches.patches(); ++i) {
            const double here = came_from_elsewhere(patches.state(i)) * 0.5;
            if (i < 80) {
                before += here;
                continue;
            }
            EXPECT_GT(here, -1e-9) << i;
            all += here;
            if (0.5 * static_cast<double>(i - 80) < 12.0 * height_m) within += here;
            if (here > most) {
                most = here;
                deepest = i - 80;
            }
        }
        EXPECT_GT(all, 10.0);
        EXPECT_NEAR(all, -before, 1e-9 * all);
        EXPECT_GT(within, 0.97 * all);
        // Heaped most one to three heights behind it, and less at its foot.
        const double deepest_m = 0.5 * (static_cast<double>(deepest) + 0.5);
        EXPECT_GE(deepest_m, height_m);
        EXPECT_LE(deepest_m, 3.0 * height_m);
        EXPECT_LT(came_from_elsewhere(patches.state(80)) * 0.5, 0.6 * most);
        const PatchLedger books = patches.ledger();
        EXPECT_LE(std::abs(books.residual()), 1e-9 * books.fallen);
    }
}

TEST(DriftingSnow, IsNoDeeperThanWhatItLiesBehindIsHigh)
{
    const ForcingTable table = blizzard(16.0, 270.0);
    PatchWeather patches(table, behind_a_wall(0.3, 6), {}, table.time_us.front());
    patches.go_to(table.time_us[21]);
    std::vector<double> fallen_m;
    for (std::size_t i = 0; i < patches.patches(); ++i)
        fallen_m.push_back(diagnostics(patches.state(i).cell).snow_depth_m);
    patches.go_to(table.time_us[38]);
    double most = 0.0;
    for (std::size_t i = 80; i < patches.patches(); ++i) {
        const double depth_m = diagnostics(patches.state(i).cell).snow_depth_m;
        EXPECT_LT(depth_m, std::max(0.31, fallen_m[i])) << i;
        most = std::max(most, came_from_elsewhere(patches.state(i)));
    }
    EXPECT_GT(most, 5.0);
}

TEST(DriftingSnow, IsDefinedInAHurricane)
{
    for (const double wind : {0.0, 30.0, 60.0, -60.0}) {
        // Below 0: behind a wall of which the heights are known.
        const ForcingTable table = blizzard(std::abs(wind), 270.0, -15.0);
        PatchWeather patches(table, wind < 0.0 ? behind_a_wall(2.0, 60) : square(true), {}, table.time_us.front());
        patches.go_to(table.time_us[39] + 17 * 60 * 1000000LL);
        for (std::size_t i = 0; i < patches.patches(); ++i) {
            const CellState c = patches.state(i).cell;
            EXPECT_TRUE(std::isfinite(c.surface_temp_c));
            for (std::size_t k = 0; k < kSnowLayers; ++k) {
                EXPECT_GE(c.snow_ice[k], 0.0);
                EXPECT_GE(c.snow_thickness[k], 0.0);
                EXPECT_TRUE(std::isfinite(c.snow_temp_c[k]));
            }
        }
        const PatchLedger books = patches.ledger();
        EXPECT_LE(std::abs(books.residual()), 1e-9 * books.fallen);
    }
}

}  // namespace
}  // namespace petrichor::weather
