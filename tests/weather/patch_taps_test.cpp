// Water that is let in on patches: where it goes, and its books.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "tests/weather/street.h"
#include "weather/patches/patch_weather.h"

namespace petrichor::weather {
namespace {

using testing_weather::kHourUs;
using testing_weather::steady;
using testing_weather::Street;

// Three patches of asphalt on a way, one beside it, all draining to a pond of 4 m2 that holds all.
PatchSet road()
{
    Street street;
    street.set.ponds = 1;
    for (int i = 0; i < 4; ++i) {
        auto& p = street.add();
        p.area_m2 = 2.0;
        p.runs_to = kToPond | 0;
    }
    return street.set;
}
Ponds one_pond()
{
    Ponds p;
    p.volume_m3 = {0.0};
    p.step = [](std::span<double> v, std::span<const double> in, std::span<const double> loss) {
        v[0] += in[0];
        const double lost = std::min(v[0], loss[0] * 4.0);
        v[0] -= lost;
        return PondStep{0.0, lost};
    };
    p.stored_m3 = [](std::span<const double> v) { return v[0]; };
    return p;
}

PatchTap tap_at(const ForcingTable& table, double kg_s)
{
    PatchTap tap;
    tap.stretches = {{{0, 1, 2}, kToPond | 0}};
    tap.flow_kg_s = kg_s;
    tap.from_us = table.time_us[2] + 20 * 60 * 1000000LL;
    tap.to_us = table.time_us[4] + 30 * 60 * 1000000LL;  // 130 minutes
    return tap;
}

PatchWeather run(const ForcingTable& table, const PatchTap& tap, const PatchSet& set = road())
{
    PatchParams params;
    params.taps = {tap};
    return PatchWeather(table, set, params, table.time_us.front(), one_pond());
}

TEST(PatchTaps, FillAHollowInADryDayAndTheBooksClose)
{
    const ForcingTable dry = steady(12, 12.0, 0.0, 1.0, 240);
    PatchWeather patches = run(dry, tap_at(dry, 0.5));
    const double all_kg = 0.5 * 130 * 60;
    for (const double hours : {0.0, 2.2, 2.5, 3.0, 4.25, 4.5, 5.0, 10.0}) {
        patches.go_to(dry.time_us.front() +
                      static_cast<std::int64_t>(hours * static_cast<double>(kHourUs)));
        const PatchLedger books = patches.ledger();
        const double open_min = std::clamp(hours * 60.0 - 140.0, 0.0, 130.0);
        EXPECT_NEAR(books.let_in, 0.5 * 60.0 * open_min, 1e-6) << hours;
        EXPECT_EQ(books.fallen, 0.0);
        EXPECT_LE(std::abs(books.residual()), 1e-9 * (books.let_in + books.initially)) << hours;
    }
    const PatchLedger books = patches.ledger();
    EXPECT_NEAR(books.let_in, all_kg, 1e-6);
    EXPECT_GT(books.in_ponds, 0.9 * all_kg);
    EXPECT_GT(books.lost_from_ponds, 0.0);
}

TEST(PatchTaps, WetWhatLiesOnTheirWayAndNothingBeside)
{
    const ForcingTable dry = steady(12, 12.0, 0.0, 1.0, 240);
    PatchWeather patches = run(dry, tap_at(dry, 0.5));
    patches.go_to(dry.time_us[4]);
    const double full = surface_preset("asphalt").film_capacity_kg_m2;
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(patches.state(i).cell.film, full, 1e-9) << i;
        EXPECT_GT(patches.state(i).run_on_kg_m2_s, 0.0) << i;
    }
    EXPECT_EQ(patches.state(3).cell.film, 0.0);
    EXPECT_EQ(patches.state(3).run_on_kg_m2_s, 0.0);
    // A trickle ends where the first stone drinks it.
    PatchWeather trickle = run(dry, tap_at(dry, 1e-5));
    trickle.go_to(dry.time_us[4]);
    EXPECT_GT(trickle.state(0).cell.film, 0.0);
    EXPECT_EQ(trickle.state(1).cell.film, 0.0);
    EXPECT_EQ(trickle.ledger().in_ponds, 0.0);
}

// As one_pond, 4 m2 wide.
Ponds shaped_pond()
{
    Ponds p = one_pond();
    p.shape = [](std::span<const double> v) { return std::vector<PondShape>{{v[0] / 4.0, 4.0}}; };
    return p;
}

PatchWeather run_warm(const ForcingTable& table, double temp_k, double kg_s = 0.5)
{
    PatchParams params;
    params.taps = {tap_at(table, kg_s)};
    params.taps[0].temp_k = temp_k;
    return PatchWeather(table, road(), params, table.time_us.front(), shaped_pond());
}

TEST(PatchTaps, WarmTheGroundOnTheirWayInFrostAndCoolItInSummer)
{
    const ForcingTable frost = steady(12, -8.0, 0.0, 1.0, 240);
    PatchWeather warm = run_warm(frost, 283.15), colder = run_warm(frost, 274.15);
    warm.go_to(frost.time_us[4]);
    colder.go_to(frost.time_us[4]);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GT(warm.state(i).cell.ground_temp_c[0], warm.state(3).cell.ground_temp_c[0] + 3.0) << i;
        EXPECT_GT(warm.state(i).cell.ground_temp_c[0], colder.state(i).cell.ground_temp_c[0] + 1.0) << i;
        EXPECT_LT(warm.state(i).cell.ground_temp_c[0], 10.0) << i;
    }
    // Water that keeps coming keeps its way open; long after it has stopped what is left is ice.
    EXPECT_GT(warm.state(0).cell.film, 0.9 * surface_preset("asphalt").film_capacity_kg_m2);
    warm.go_to(frost.time_us[11]);
    EXPECT_GT(warm.state(0).cell.film_ice + warm.state(0).cell.puddle_ice, 0.2);
    EXPECT_LT(warm.state(0).cell.film, 0.01);

    const ForcingTable summer = steady(12, 25.0, 0.0, 1.0, 240);
    PatchWeather cool = run_warm(summer, 283.15);
    cool.go_to(summer.time_us[4]);
    EXPECT_LT(cool.state(0).cell.ground_temp_c[0], cool.state(3).cell.ground_temp_c[0] - 1.0);
}

TEST(PatchTaps, MeltTheIceOnTheirWay)
{
    // A trickle leaves ice in the first hours; a flood melts it.
    const ForcingTable frost = steady(14, -6.0, 0.0, 1.0, 240);
    PatchParams params;
    params.taps = {tap_at(frost, 2e-4), tap_at(frost, 1.0)};
    params.taps[0].temp_k = 273.15;
    params.taps[1].from_us = frost.time_us[9];
    params.taps[1].to_us = frost.time_us[11];
    PatchWeather patches(frost, road(), params, frost.time_us.front(), shaped_pond());
    const auto ice = [&] {
        const CellState c = patches.state(0).cell;
        return c.film_ice + c.crack_ice + c.puddle_ice;
    };
    patches.go_to(frost.time_us[9]);
    EXPECT_GT(ice(), 0.1);
    patches.go_to(frost.time_us[11]);
    EXPECT_LT(ice(), 1e-6);
    const PatchLedger books = patches.ledger();
    EXPECT_LE(std::abs(books.residual()), 1e-9 * books.let_in);
}

TEST(PatchTaps, GiveTheirHeatToTheHollowAndItsBooksClose)
{
    const ForcingTable frost = steady(12, -8.0, 0.0, 1.0, 240);
    PatchWeather warm = run_warm(frost, 293.15), cold = run_warm(frost, 273.15);
    for (const std::size_t hour : {3u, 4u, 5u, 11u}) {
        warm.go_to(frost.time_us[hour]);
        cold.go_to(frost.time_us[hour]);
        const TapHeat heat = warm.ledger().tap_heat;
        EXPECT_NEAR(heat.let_in, warm.ledger().let_in * kWaterHeatCapacity * 20.0, 1e-6 * heat.let_in);
        EXPECT_LE(std::abs(heat.residual()), 1e-9 * heat.let_in) << hour;
        EXPECT_GT(heat.ground, 0.0);
        EXPECT_GT(heat.ponds, 0.5 * heat.let_in);
        EXPECT_GT(warm.pond_heat_j_kg()[0], cold.pond_heat_j_kg()[0]) << hour;
        EXPECT_EQ(cold.ledger().tap_heat.let_in, 0.0);
    }
    // The cold one has ice by then.
    EXPECT_LT(cold.pond_heat_j_kg()[0], 0.0);
}

TEST(HeatToGround, PassesNoFurtherThanWhereBothMeet)
{
    const double both = 3.0 * 2.0 / 5.0;
    EXPECT_NEAR(heat_to_ground_j(10.0, -5.0, 3.0, 2.0, 1e9), 15.0 * both, 1e-9);
    EXPECT_NEAR(heat_to_ground_j(10.0, -5.0, 3.0, 2.0, 1e-6), 15.0 * 1e-6, 1e-10);
    EXPECT_NEAR(heat_to_ground_j(-5.0, 10.0, 2.0, 3.0, 1e9), -15.0 * both, 1e-9);
    EXPECT_EQ(heat_to_ground_j(10.0, -5.0, 0.0, 2.0, 1.0), 0.0);
    EXPECT_EQ(heat_to_ground_j(10.0, -5.0, 3.0, 2.0, 0.0), 0.0);
}

TEST(PatchTaps, SoakIntoALawn)
{
    const ForcingTable dry = steady(12, 12.0, 0.0, 1.0, 240);
    PatchSet set = road();
    for (WeatherPatch& p : set.patches) {
        p.kind = 1;  // grass
        p.area_m2 = 40.0;
    }
    PatchWeather patches = run(dry, tap_at(dry, 0.5), set);
    patches.go_to(dry.time_us[8]);
    const PatchLedger books = patches.ledger();
    EXPECT_GT(books.soaked, 0.3 * books.let_in);
    EXPECT_LE(std::abs(books.residual()), 1e-9 * books.let_in);
}

TEST(PatchTaps, RunOnOverTheBrimOfAHollowThatIsFull)
{
    const ForcingTable dry = steady(12, 12.0, 0.0, 1.0, 240);
    Ponds pond = one_pond();
    pond.level_m = [](std::span<const double> v) {
        return std::vector<float>{static_cast<float>(v[0] / 4.0)};
    };
    PatchTap tap = tap_at(dry, 0.5);
    tap.stretches = {{{0, 1}, kToPond | 0, 0.4}, {{2}, kRunsOut}};
    PatchParams params;
    params.taps = {tap};
    PatchWeather patches(dry, road(), params, dry.time_us.front(), pond);
    patches.go_to(dry.time_us[3]);  // 0.3 m
    EXPECT_EQ(patches.state(2).cell.film, 0.0);
    EXPECT_EQ(patches.ledger().out, 0.0);
    patches.go_to(dry.time_us[5]);
    EXPECT_GT(patches.state(2).cell.film, 0.1);
    const PatchLedger books = patches.ledger();
    EXPECT_GT(books.out, 500.0);
    EXPECT_LE(std::abs(books.residual()), 1e-9 * books.let_in);
}

TEST(PatchTaps, GoOnFromASavedStateAndAreNoOtherRuns)
{
    const ForcingTable dry = steady(12, 12.0, 0.0, 1.0, 240);
    PatchWeather one = run(dry, tap_at(dry, 0.5));
    one.go_to(dry.time_us[3] + kHourUs / 3);
    const std::vector<std::byte> saved = one.save();
    one.go_to(dry.time_us[9]);
    PatchWeather two = run(dry, tap_at(dry, 0.5));
    two.restore(saved);
    two.go_to(dry.time_us[9]);
    EXPECT_EQ(two.hash(), one.hash());
    EXPECT_EQ(two.ledger().let_in, one.ledger().let_in);
    PatchWeather stronger = run(dry, tap_at(dry, 0.6));
    EXPECT_THROW(stronger.restore(saved), Error);
    PatchWeather none = run(dry, tap_at(dry, 0.0));
    none.go_to(dry.time_us[9]);
    EXPECT_NE(none.hash(), one.hash());
    EXPECT_EQ(none.ledger().in_ponds, 0.0);
}

TEST(PatchTaps, WhatCannotBeUsedIsRefused)
{
    const ForcingTable dry = steady(4, 12.0, 0.0, 1.0, 240);
    const auto refused = [&](auto&& change) {
        PatchTap tap;
        tap.stretches = {{{0}, kRunsOut}};
        tap.flow_kg_s = 1.0;
        EXPECT_NO_THROW(run(dry, tap));
        change(tap);
        EXPECT_THROW(run(dry, tap), Error);
    };
    refused([](PatchTap& t) { t.flow_kg_s = -1.0; });
    refused([](PatchTap& t) { t.flow_kg_s = std::numeric_limits<double>::quiet_NaN(); });
    refused([](PatchTap& t) { t.flow_kg_s = std::numeric_limits<double>::infinity(); });
    refused([](PatchTap& t) { t.temp_k = 273.0; });
    refused([](PatchTap& t) { t.temp_k = std::numeric_limits<double>::quiet_NaN(); });
    refused([](PatchTap& t) { t.stretches[0].way = {4}; });
    refused([](PatchTap& t) { t.stretches[0].runs_to = kToPond | 1; });
    refused([](PatchTap& t) { t.stretches[0].runs_to = 2; });
    refused([](PatchTap& t) {
        t.from_us = 10;
        t.to_us = 9;
    });
}

}  // namespace
}  // namespace petrichor::weather
