// The physical model on patches: books, laws, and the same bits whatever the way there.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/error.h"
#include "tests/weather/made_up.h"
#include "tests/weather/street.h"
#include "weather/patches/driving_rain.h"
#include "weather/patches/patch_weather.h"
#include "weather/patches/pond_ice.h"
#include "weather/patches/sky_light.h"
#include "weather/physics/constants.h"
#include "weather/physics/solar.h"

namespace petrichor::weather {
namespace {

using testing_weather::kHourUs;
using testing_weather::refill;
using testing_weather::rough_year;
using testing_weather::steady;
using testing_weather::Street;

// Blocks everything on one side (x < 0) below an elevation.
VisibleBits beside_wall(double elevation_deg)
{
    VisibleBits bits = open_sky({});
    for (int i = 0; i < kVisibleBits; ++i) {
        const Direction d = visible_direction(i);
        if (d.x < 0.0 && d.y < std::sin(elevation_deg * kPi / 180.0))
            bits[static_cast<std::size_t>(i >> 5)] &= ~(1u << (i & 31));
    }
    return bits;
}

const Direction kWest{-1, 0, 0}, kEast{1, 0, 0};

TEST(PatchWeather, OpenFlatGroundIsTheStation)
{
    const ForcingTable table = rough_year(24 * 40);
    Street street;
    street.add();
    PatchParams params;
    params.spin_up_days = 3660;
    PatchWeather patches(table, street.set, params, table.time_us.front());
    PhysicalParams model;
    const PhysicalTimeline alone(table, model);
    for (const std::size_t hour : {1u, 24u, 300u, 900u}) {
        const std::int64_t at = table.time_us[hour];
        patches.go_to(at);
        const CellState here = patches.state(0).cell, there = alone.state_at(at);
        // Sunlight is the same but for the rounding of two shares.
        EXPECT_NEAR(here.surface_temp_c, there.surface_temp_c, 0.35) << hour;
        EXPECT_NEAR(here.total_precip, there.total_precip, 1e-6) << hour;
        EXPECT_NEAR(diagnostics(here).swe_kg_m2, diagnostics(there).swe_kg_m2, 0.3) << hour;
    }
}

PatchSet busy_street()
{
    Street s;
    s.set.ponds = 2;
    s.set.pond_soaks_mm_h = {0.0, 3.0};
    auto& roof = s.add({std::sin(0.6), std::cos(0.6), 0}, 2);
    roof.height_m = 6;
    roof.area_m2 = 20;
    roof.runs_to = 2;
    roof.gutter_share = 0.3;
    auto& west = s.add(kWest, 3);
    west.height_m = 0.2;
    west.foot = 2;
    west.foot_height_m = 0.2;
    west.runs_to = 3;
    auto& drip = s.add({}, 0);
    drip.height_m = 0.05;
    drip.area_m2 = 3;
    drip.runs_to = kToPond | 0;
    auto& lawn = s.add({}, 1);
    lawn.area_m2 = 40;
    lawn.runs_to = kToPond | 1;
    auto& shade = s.add({}, 0);
    shade.visible = beside_wall(60);
    shade.patch_share = 0.4;
    shade.runs_to = 2;
    for (int i = 0; i < 14; ++i) {
        auto& more = s.add({}, static_cast<std::uint32_t>(i) % 4);
        more.area_m2 = 1.0 + 0.1 * i;
        more.visible = beside_wall(5.0 * i);
    }
    s.set.link_begin.assign(s.set.patches.size() + 1, 0);
    for (std::size_t i = 4; i < s.set.patches.size(); ++i) {
        for (const std::uint32_t to : {1u, 3u, 7u}) s.set.links.push_back(to);
        s.set.patches[i].patch_share = std::max(s.set.patches[i].patch_share, 0.1);
        s.set.link_begin[i + 1] = static_cast<std::uint32_t>(s.set.links.size());
    }
    s.set.beside_begin.assign(s.set.patches.size() + 1, 0);
    for (std::size_t i = 2; i < s.set.patches.size(); ++i) {
        s.set.beside.push_back(i == 2 ? 3u : 2u);
        s.set.beside_m.push_back(1.5f);
        s.set.beside_begin[i + 1] = static_cast<std::uint32_t>(s.set.beside.size());
    }
    return s.set;
}

// Two ponds that hold 50 litres each and spill out.
Ponds tubs()
{
    Ponds p;
    p.volume_m3 = {0.0, 0.0};
    p.step = [](std::span<double> v, std::span<const double> in, std::span<const double> loss) {
        PondStep done;
        for (std::size_t i = 0; i < v.size(); ++i) {
            v[i] += in[i];
            const double over = std::max(0.0, v[i] - 0.05);
            v[i] -= over;
            const double lost = std::min(v[i], loss[i] * 2.0);
            v[i] -= lost;
            done.out_m3 += over;
            done.lost_m3 += lost;
        }
        return done;
    };
    p.stored_m3 = [](std::span<const double> v) { return v[0] + v[1]; };
    p.shape = [](std::span<const double> v) {
        return std::vector<PondShape>{{v[0] / 2.0, 2.0}, {v[1] / 2.0, 2.0}};
    };
    return p;
}

TEST(PatchWeather, TheBooksClose)
{
    const ForcingTable table = rough_year(24 * 150);
    PatchParams params;
    params.spin_up_days = 0;
    PatchWeather patches(table, busy_street(), params, table.time_us.front(), tubs());
    for (const std::size_t day : {3u, 30u, 75u, 149u}) {
        patches.go_to(table.time_us[day * 24] + 17 * 60 * 1000000LL);
        const PatchLedger books = patches.ledger();
        EXPECT_LT(std::abs(books.residual()), 1e-9 * (books.fallen + books.initially)) << day;
    }
    const PatchLedger books = patches.ledger();
    EXPECT_GT(books.out, 0.0);
    EXPECT_GT(books.soaked, 0.0);
    EXPECT_GT(books.lost_from_ponds, 0.0);
    EXPECT_GT(books.evaporated, 0.0);
}

TEST(PatchWeather, SameBitsForAnyThreadsOrderAndAfterAPause)
{
    const ForcingTable table = rough_year(24 * 60);
    PatchParams params;
    params.spin_up_days = 5;
    const std::int64_t from = table.time_us[24 * 20];
    const std::int64_t late = table.time_us[24 * 45] + 1234567890LL;
    const std::int64_t early = table.time_us[24 * 22] + 100 * 1000000LL;
    PatchWeather one(table, busy_street(), params, from, tubs());
    one.go_to(late);
    const std::uint64_t hash = one.hash();
    one.go_to(early);
    const std::uint64_t before = one.hash();
    EXPECT_NE(hash, before);
    one.go_to(late);
    EXPECT_EQ(one.hash(), hash);
    for (const int threads : {2, 8}) {
        params.threads = threads;
        PatchWeather many(table, busy_street(), params, from, tubs());
        many.go_to(early);
        EXPECT_EQ(many.hash(), before) << threads;
        many.go_to(late);
        EXPECT_EQ(many.hash(), hash) << threads;
    }
    params.threads = 1;
    one.go_to(early);
    const std::vector<std::byte> saved = one.save();
    PatchWeather other(table, busy_street(), params, from, tubs());
    other.restore(saved);
    EXPECT_EQ(other.hash(), before);
    other.go_to(late);
    EXPECT_EQ(other.hash(), hash);
    PatchSet changed = busy_street();
    changed.patches[2].area_m2 = 7;
    PatchWeather third(table, changed, params, from, tubs());
    EXPECT_THROW(third.restore(saved), Error);
    EXPECT_THROW(other.restore(std::span(saved).first(saved.size() - 8)), Error);
}

TEST(PatchWeather, MoreSkyIsNeverWarmerInAClearNight)
{
    Street street;
    std::vector<double> views{1.0, 0.8, 0.6, 0.4, 0.2, 0.0};
    for (const double view : views) {
        auto& p = street.add({}, 1);
        p.sky_share = view;
        p.patch_share = 0.0;
    }
    // Ground beyond the scene radiates like the twin; here as cold as the open patch: give walls.
    for (std::size_t i = 0; i < views.size(); ++i) {
        auto& p = street.set.patches[i];
        p.patch_share = 1.0 - p.sky_share;
    }
    auto& wall = street.add(kWest, 3);
    wall.sky_share = 0.0;
    wall.patch_share = 0.0;
    const auto wall_number = static_cast<std::uint32_t>(street.set.patches.size() - 1);
    street.set.kinds[3].like_air = true;
    for (std::size_t i = 0; i < views.size(); ++i) {
        street.set.links.push_back(wall_number);
        street.set.link_begin[i + 1] = static_cast<std::uint32_t>(street.set.links.size());
    }
    street.set.link_begin.back() = static_cast<std::uint32_t>(street.set.links.size());
    // Polar night at 78 degrees north: no sun, clear and calm.
    ForcingTable table = steady(48, 2.0, 0.0, 1.5, 240, 0.0, 1419120000LL * 1000000);
    table.site.latitude_deg = 78;
    table.site.longitude_deg = 16;
    std::fill(table[Field::Shortwave].begin(), table[Field::Shortwave].end(), 0.0);
    PatchWeather patches(table, street.set, {}, table.time_us.front());
    patches.go_to(table.time_us[40]);
    for (std::size_t i = 1; i < views.size(); ++i) {
        EXPECT_GT(patches.state(i).cell.surface_temp_c,
                  patches.state(i - 1).cell.surface_temp_c + 0.1)
            << views[i];
        EXPECT_LE(patches.state(i).hoar_kg_m2, patches.state(i - 1).hoar_kg_m2 + 1e-12);
    }
    EXPECT_GT(patches.state(0).hoar_kg_m2, 0.01);  // frost in the open
    EXPECT_EQ(patches.state(5).hoar_kg_m2, 0.0);   // none under the roof
    EXPECT_LT(patches.state(0).cell.surface_temp_c, -1.0);
}

TEST(PatchWeather, ShadeKeepsSnowLonger)
{
    // Half a day of snow, then clear spring days.
    ForcingTable table = steady(24 * 12, -1.0, 0.0, 2.0, 240, 0.1, 1425200000LL * 1000000);
    for (std::size_t i = 0; i < 12; ++i) table[Field::Precip][i] = 1.0 / 3600.0;
    for (std::size_t i = 12; i < table.rows(); ++i)
        table[Field::AirTemp][i] =
            kZeroCelsiusK + 3.0 + 4.0 * std::sin(2 * kPi * (static_cast<double>(i) - 9) / 24);
    refill(table);
    Street street;
    street.add();
    auto& shade = street.add();
    // A wall to the south: no sun below 60 degrees.
    for (int i = 0; i < kVisibleBits; ++i) {
        const Direction d = visible_direction(i);
        if (d.z > 0.0 && d.y < std::sin(60 * kPi / 180.0))
            shade.visible[static_cast<std::size_t>(i >> 5)] &= ~(1u << (i & 31));
    }
    PatchWeather patches(table, street.set, {}, table.time_us.front());
    double days_open = 0, days_shade = 0;
    for (std::size_t hour = 12; hour < table.rows(); ++hour) {
        patches.go_to(table.time_us[hour]);
        if (diagnostics(patches.state(0).cell).swe_kg_m2 > 0.05) ++days_open;
        if (diagnostics(patches.state(1).cell).swe_kg_m2 > 0.05) ++days_shade;
    }
    EXPECT_GT(days_open, 3);
    EXPECT_GT(days_shade, days_open + 12);
}

TEST(PatchWeather, TheWindwardWallIsWetAndNoRainFallsUnderARoof)
{
    Street street;
    street.add(kWest, 3);
    street.add(kEast, 3);
    street.add();
    street.add().visible = {};  // under a roof
    for (const double from : {270.0, 90.0}) {
        const ForcingTable table = steady(6, 8.0, 5.0, 5.0, from);
        PatchWeather patches(table, street.set, {}, table.time_us.front());
        patches.go_to(table.time_us[4]);
        const std::size_t windward = from > 180 ? 0 : 1;
        EXPECT_NEAR(patches.state(windward).cell.total_precip, 4 * 5 * .91505, 1e-3);
        EXPECT_EQ(patches.state(1 - windward).cell.total_precip, 0.0);
        EXPECT_NEAR(patches.state(2).cell.total_precip, 20.0, 1e-4);
        EXPECT_EQ(patches.state(3).cell.total_precip, 0.0);
        EXPECT_NEAR(patches.state(windward).rain_share, .91505, 1e-4);
        EXPECT_GT(patches.state(windward).cell.film, 0.1);
        EXPECT_EQ(patches.state(3).cell.film, 0.0);
    }
    // North is the scene's +x: what faces -x looks south.
    const ForcingTable south = steady(6, 8.0, 5.0, 5.0, 180.0);
    PatchParams params;
    params.north_deg = 90.0;
    PatchWeather turned(south, street.set, params, south.time_us.front());
    turned.go_to(south.time_us[4]);
    EXPECT_GT(turned.state(0).cell.total_precip, 15.0);
    EXPECT_EQ(turned.state(1).cell.total_precip, 0.0);
}

TEST(PatchWeather, WaterRunsDown)
{
    Street street;
    auto& roof = street.add({}, 2);
    roof.height_m = 5;
    roof.area_m2 = 30;
    roof.runs_to = 1;
    auto& drip = street.add();
    drip.visible = {};  // dry but for what drips
    drip.area_m2 = 2;
    drip.runs_to = 2;
    street.add().visible = {};
    street.add().visible = {};
    const ForcingTable table = steady(8, 8.0, 4.0, 0.0, 0.0);
    PatchWeather patches(table, street.set, {}, table.time_us.front());
    patches.go_to(table.time_us[6]);
    EXPECT_EQ(patches.state(1).cell.total_precip, 0.0);
    EXPECT_GT(patches.state(1).run_on_kg_m2_s * 3600.0, 50.0);
    const CellState wet = patches.state(1).cell;
    const Surface asphalt = surface_preset("asphalt");
    EXPECT_NEAR(wet.film, asphalt.film_capacity_kg_m2, 1e-9);
    EXPECT_GT(wet.puddle, 0.9 * asphalt.puddles.capacity_kg_m2());
    EXPECT_GT(patches.state(2).cell.film, 0.1);  // and on
    EXPECT_EQ(patches.state(3).cell.film, 0.0);
    const PatchLedger books = patches.ledger();
    EXPECT_NEAR(books.residual(), 0.0, 1e-9 * books.fallen);
}

TEST(PatchWeather, MetalRoofsShedTheirSnow)
{
    ForcingTable table = steady(60, -2.0, 0.0, 1.0, 240, 1.0);
    for (std::size_t i = 0; i < 20; ++i) table[Field::Precip][i] = 1.5 / 3600.0;
    for (std::size_t i = 30; i < table.rows(); ++i) table[Field::AirTemp][i] = kZeroCelsiusK + 6.0;
    refill(table);
    Street street;
    const double tilt = 25 * kPi / 180.0;
    auto& roof = street.add({std::sin(tilt), std::cos(tilt), 0}, 2);
    roof.height_m = 5;
    roof.area_m2 = 10;
    roof.runs_to = 1;
    street.add().area_m2 = 4;
    street.add().area_m2 = 4;
    street.set.beside_begin = {0, 0, 1, 2};
    street.set.beside = {2, 1};
    street.set.beside_m = {0.1f, 0.1f};
    PatchWeather patches(table, street.set, {}, table.time_us.front());
    patches.go_to(table.time_us[28]);
    const double on_roof = diagnostics(patches.state(0).cell).swe_kg_m2;
    const double on_ground = diagnostics(patches.state(1).cell).swe_kg_m2;
    EXPECT_NEAR(on_roof, on_ground * std::cos(tilt), 2.0);
    bool seen = false;
    for (std::size_t hour = 30; hour < 50 && !seen; ++hour) {
        patches.go_to(table.time_us[hour]);
        const auto roof_now = diagnostics(patches.state(0).cell);
        if (roof_now.swe_kg_m2 > 0.0) continue;
        seen = true;
        const auto heap = diagnostics(patches.state(1).cell);
        const auto beside = diagnostics(patches.state(2).cell);
        EXPECT_GT(heap.swe_kg_m2, on_ground + 0.3 * on_roof);
        EXPECT_GT(beside.swe_kg_m2, on_ground);  // the heap came to rest
        EXPECT_LE(heap.snow_depth_m, beside.snow_depth_m + 0.3);
    }
    EXPECT_TRUE(seen);
    const PatchLedger books = patches.ledger();
    EXPECT_NEAR(books.residual(), 0.0, 1e-9 * books.fallen);
}

TEST(PatchWeather, SplashesWetTheFootOfAWall)
{
    Street street;
    auto& low = street.add(kWest, 3);
    low.foot = 2;
    low.foot_height_m = 0.05;
    auto& high = street.add(kWest, 3);
    high.foot = 2;
    high.foot_height_m = 1.5;
    street.add().area_m2 = 2;
    const ForcingTable table = steady(6, 8.0, 5.0, 0.0, 0.0);
    PatchWeather patches(table, street.set, {}, table.time_us.front());
    patches.go_to(table.time_us[4]);
    EXPECT_NEAR(patches.state(0).cell.total_precip, 20.0 * 0.15 * std::exp(-0.5), 1e-3);
    EXPECT_EQ(patches.state(1).cell.total_precip, 0.0);
    const PatchLedger books = patches.ledger();
    EXPECT_NEAR(books.fallen, 2 * 20.0, 1e-3);  // taken from the ground
}

TEST(PatchWeather, WallsInTheSunAndSnowLightTheirNeighbours)
{
    Street street;
    auto& alley = street.add();
    alley.sky_share = 0.5;
    alley.patch_share = 0.5;
    street.add({0, 0, 1}, 3);  // a wall that faces south
    street.set.links = {1};
    street.set.link_begin = {0, 1, 1};
    const ForcingTable table = steady(24, 5.0, 0.0, 2.0, 240, 0.0, 1427000000LL * 1000000);
    PatchWeather patches(table, street.set, {}, table.time_us.front());
    double most = 0.0;
    for (std::size_t hour = 0; hour < 24; ++hour) {
        patches.go_to(table.time_us[hour] + kHourUs / 2);
        const double open = table[Field::Shortwave][hour];
        if (open > 300.0) most = std::max(most, patches.state(1).shortwave_w_m2 / open);
        EXPECT_GE(patches.state(0).shortwave_w_m2, 0.0);
    }
    EXPECT_GT(most, 0.9);
}

// A file whose clock is an hour off has light of a high sun while it rises: no wall gets more of it than
// the clearest air lets through, and what the beam cannot bring comes from the sky.
TEST(PatchWeather, AtSunriseAWallGetsNoMoreThanTheSunSends)
{
    ForcingTable table = steady(24, 5.0, 0.0, 2.0, 240, 0.0, 1427000000LL * 1000000);
    for (std::size_t i = 0; i + 1 < table.rows(); ++i)
        table[Field::Shortwave][i] = table[Field::Shortwave][i + 1];
    Street street;
    street.add();
    const Direction around[] = {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
    for (const Direction& n : around) street.add(n, 3);
    PatchWeather patches(table, street.set, {}, table.time_us.front());
    int low = 0;
    for (int quarter = 1; quarter < 95; ++quarter) {
        const std::int64_t us = table.time_us.front() + quarter * kHourUs / 4;
        // What a moment says is the mean since its hour began.
        const std::int64_t began = us - (quarter % 4) * kHourUs / 4;
        const auto up_at = [&](std::int64_t t) {
            return sun_direction(t, table.site.latitude_deg, table.site.longitude_deg).up;
        };
        const double up = std::max(up_at(us), up_at(began));
        if (quarter % 4 == 0 || std::min(up_at(us), up_at(began)) < 0.02 || up > 0.2) continue;
        const double open =
            0.5 * (value_at(table, Field::Shortwave, us) + value_at(table, Field::Shortwave, began));
        if (open < 50.0) continue;
        ++low;
        patches.go_to(us);
        const double beam = clear_beam_w_m2(1361.0, std::acos(up), table.site.elevation_m);
        for (std::size_t wall = 1; wall <= 4; ++wall)
            EXPECT_LT(patches.state(wall).shortwave_w_m2, beam + 1.2 * open) << quarter;
        EXPECT_NEAR(patches.state(0).shortwave_w_m2, open, 0.6 * open) << quarter;
        EXPECT_GT(patches.state(1).shortwave_w_m2 + patches.state(3).shortwave_w_m2, open) << quarter;
    }
    EXPECT_GE(low, 2);
}

// Blades are a skin of their own: dew falls on them while the soil below is warm.
TEST(PatchWeather, ALawnIsWetInClearNights)
{
    ForcingTable table = steady(24 * 6, 14.0, 0.0, 1.5, 240, 0.0, 1433000000LL * 1000000);
    const auto dew = [&](const char* surface) {
        PhysicalParams model;
        model.surface = surface_preset(surface);
        const PhysicalTimeline run(table, model);
        double most = 0.0;
        for (std::size_t hour = 96; hour < table.rows(); ++hour)
            most = std::max(most, run.state_at(table.time_us[hour]).film);
        return most;
    };
    EXPECT_GT(dew("lawn"), dew("grass") + 0.01);
    EXPECT_GT(dew("lawn"), 0.02);
}

// Of ice on water at 0 C, whose air takes a fixed heat from a surface at 0 C and less of a colder one:
// d + B d^2 / 2 k = q t / (rho L).
TEST(PondHeat, IceGrowsAsStefanSays)
{
    PondAir air;
    air.gain_w_m2 = air.ice_gain_w_m2 = -120.0;
    air.ice_loss_w_m2_k = 20.0;
    constexpr double kDeep_kg_m2 = 2000.0;
    double heat = 0.0;
    for (int hour = 1; hour <= 24 * 20; ++hour) {
        heat = step_pond_heat(heat, kDeep_kg_m2, air, 3600.0);
        const double right = 120.0 * hour * 3600.0 / (kIceDensity * kLatentFusion);
        const double b = 20.0 / 2.2;
        const double ice_m = (std::sqrt(1.0 + 2.0 * b * right) - 1.0) / b;
        const double found = pond_ice_share(heat) * kDeep_kg_m2 / kIceDensity;
        EXPECT_NEAR(found, ice_m, 0.005 * ice_m + 1e-4) << hour;
    }
    // Snow on it keeps the cold out.
    PondAir covered = air;
    covered.cover_m2_k_w = 0.4;
    EXPECT_GT(step_pond_heat(heat, kDeep_kg_m2, covered, 3600.0),
              step_pond_heat(heat, kDeep_kg_m2, air, 3600.0));
    EXPECT_EQ(step_pond_heat(heat, kDeep_kg_m2, air, 0.0), heat);
}

TEST(PondHeat, WaterCoolsToTheAirAndFreezesToTheGround)
{
    // Of 5 C water under air that a surface of 3 C is at rest with.
    PondAir air;
    air.loss_w_m2_k = 25.0;
    air.gain_w_m2 = 75.0;
    double heat = 5.0 * kWaterHeatCapacity, before = heat;
    for (int hour = 0; hour < 200; ++hour) {
        heat = step_pond_heat(heat, 50.0, air, 3600.0);
        EXPECT_LE(heat, before);
        before = heat;
    }
    EXPECT_NEAR(pond_water_c(heat), 3.0, 1e-6);
    EXPECT_EQ(pond_ice_share(heat), 0.0);
    air.gain_w_m2 = air.ice_gain_w_m2 = -200.0;
    for (int hour = 0; hour < 200; ++hour) heat = step_pond_heat(heat, 5.0, air, 3600.0);
    EXPECT_EQ(pond_ice_share(heat), 1.0);
    // What froze and melts again is water as it was: its latent heat, no more.
    air.ice_gain_w_m2 = 100.0;
    const double hours = kLatentFusion * 5.0 / 100.0 / 3600.0;
    for (int piece = 0; piece < 6 * static_cast<int>(hours) - 6; ++piece)
        heat = step_pond_heat(heat, 5.0, air, 600.0);
    EXPECT_GT(pond_ice_share(heat), 0.0);
    EXPECT_LT(pond_ice_share(heat), 0.5);
}

// Frost after rain: ponds freeze from above, hold what they held, and thaw.
TEST(PatchWeather, PondsFreezeAndThaw)
{
    ForcingTable table = steady(24 * 12, 3.0, 0.0, 2.0, 240);
    for (std::size_t i = 0; i < 12; ++i) table[Field::Precip][i] = 4.0 / 3600.0;
    for (std::size_t i = 24; i < 24 * 6; ++i) table[Field::AirTemp][i] = kZeroCelsiusK - 8.0;
    for (std::size_t i = 24 * 6; i < table.rows(); ++i) table[Field::AirTemp][i] = kZeroCelsiusK + 7.0;
    refill(table);
    PatchParams params;
    params.spin_up_days = 0;
    PatchWeather patches(table, busy_street(), params, table.time_us.front(), tubs());
    patches.go_to(table.time_us[23]);
    EXPECT_EQ(pond_ice_share(patches.pond_heat_j_kg()[0]), 0.0);
    EXPECT_GT(patches.pond_volumes_m3()[0], 0.01);
    double before = 0.0;
    for (std::size_t day = 1; day <= 5; ++day) {
        patches.go_to(table.time_us[24 * day + 20]);
        const double ice = pond_ice_share(patches.pond_heat_j_kg()[0]);
        EXPECT_GE(ice, before) << day;
        before = ice;
    }
    EXPECT_GT(before, 0.9);  // 25 mm in five days of frost
    const double volume = patches.pond_volumes_m3()[0];
    patches.go_to(table.time_us[24 * 5]);
    EXPECT_NEAR(patches.pond_volumes_m3()[0], volume, 1e-12) << "the air takes no water from below ice";
    patches.go_to(table.time_us.back());
    EXPECT_EQ(pond_ice_share(patches.pond_heat_j_kg()[0]), 0.0);
    const PatchLedger books = patches.ledger();
    EXPECT_LT(std::abs(books.residual()), 1e-9 * books.fallen);
}

TEST(PatchWeather, OddWeatherIsDefined)
{
    const PatchSet set = busy_street();
    for (const double wind : {0.0, 60.0}) {
        const ForcingTable table = steady(30, 4.0, 3.0, wind, 200);
        PatchWeather patches(table, set, {}, table.time_us.front(), tubs());
        patches.go_to(table.time_us[20]);
        const PatchLedger books = patches.ledger();
        EXPECT_LT(std::abs(books.residual()), 1e-9 * books.fallen);
        for (std::size_t i = 0; i < patches.patches(); ++i) {
            const PatchState s = patches.state(i);
            EXPECT_TRUE(std::isfinite(s.cell.surface_temp_c));
            EXPECT_GE(s.wind_factor, 0.25 - 1e-6);
            EXPECT_LE(s.wind_factor, 1.0);
        }
    }
    const ForcingTable row = steady(1, 4.0, 3.0, 2.0, 200);
    PatchWeather one(row, set, {}, row.time_us.front(), tubs());
    one.go_to(row.time_us.front() + kHourUs / 3);
    EXPECT_GT(one.ledger().fallen, 0.0);
    one.go_to(row.time_us.front() + 100 * kHourUs);
    EXPECT_TRUE(std::isfinite(one.state(0).cell.surface_temp_c));
    one.go_to(row.time_us.front() - 100 * kHourUs);
    EXPECT_EQ(one.ledger().fallen, 0.0);
}

TEST(PatchWeather, WhatCannotBeUsedIsRefused)
{
    const ForcingTable table = steady(4, 4.0, 0.0, 2.0, 200);
    const auto refused = [&](auto&& change) {
        PatchSet set = busy_street();
        PatchParams params;
        change(set, params);
        EXPECT_THROW(PatchWeather(table, set, params, table.time_us.front(), tubs()), Error);
    };
    refused([](PatchSet& s, PatchParams&) { s.patches[0].area_m2 = 0.0; });
    refused([](PatchSet& s, PatchParams&) {
        s.patches[0].normal.x = std::numeric_limits<double>::quiet_NaN();
    });
    refused([](PatchSet& s, PatchParams&) { s.patches[3].runs_to = 3; });
    refused([](PatchSet& s, PatchParams&) { s.patches[3].runs_to = kToPond | 9; });
    refused([](PatchSet& s, PatchParams&) { s.patches[3].kind = 99; });
    refused([](PatchSet& s, PatchParams&) { s.links[0] = 999; });
    refused([](PatchSet& s, PatchParams&) { s.patches.clear(); });
    refused([](PatchSet&, PatchParams& p) { p.threads = 0; });
    refused([](PatchSet&, PatchParams& p) { p.spin_up_days = -1; });
    // Ways in a circle are cut, not followed for ever.
    PatchSet circle = busy_street();
    circle.patches[5].runs_to = 6;
    circle.patches[6].runs_to = 7;
    circle.patches[7].runs_to = 5;
    PatchWeather patches(table, circle, {}, table.time_us.front(), tubs());
    patches.go_to(table.time_us[2]);
    EXPECT_TRUE(std::isfinite(patches.state(5).cell.film));
}

}  // namespace
}  // namespace petrichor::weather
