// Walls against balances that are solved by hand: how warm they get, how fast, and when hoar on
// them goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "weather/patches/patch_weather.h"
#include "weather/physics/air.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"
#include "weather/physics/surface_energy.h"

namespace petrichor::weather {
namespace {

constexpr double kPressure_pa = 101325.0;
constexpr std::int64_t kBegin_us = 1610236800LL * 1000000;  // 10 January 2021
constexpr double kColdAir_c = -9.0, kWarmAir_c = 6.0;
constexpr double kWind_m_s = 2.0;

// Nights without end: cold and damp for some hours, then as warm as asked, with the longwave of a
// clear sky.
ForcingTable thaw(std::size_t cold_hours, std::size_t hours, double humidity_pct,
                  double cold_humidity_pct = 85.0)
{
    ForcingTable t;
    t.site = {48.0, 8.0, 0.0};
    for (std::size_t i = 0; i < hours; ++i) {
        const bool cold = i < cold_hours;
        t.time_us.push_back(kBegin_us + static_cast<std::int64_t>(i) * 3600 * kMicrosPerSecond);
        t[Field::AirTemp].push_back(kZeroCelsiusK + (cold ? kColdAir_c : kWarmAir_c));
        t[Field::RelHumidity].push_back(cold ? cold_humidity_pct : humidity_pct);
        t[Field::Wind].push_back(kWind_m_s);
        t[Field::WindFrom].push_back(180.0);
        t[Field::Pressure].push_back(kPressure_pa);
        t[Field::Precip].push_back(0.0);
        t[Field::Shortwave].push_back(0.0);
        t[Field::Longwave].push_back(cold ? 194.0 : 253.0);
        t[Field::Cloud].push_back(0.0);
    }
    ReadReport report;
    fill_forcing(t, report);
    return t;
}

// A wall that looks north, away from the wind; a room or air behind it.
//   sky  share that it sees, the rest ground; the ground warms slowly, the sky is what it is
PatchSet wall(const GroundLayer& layer, bool room, double sky)
{
    PatchSet set;
    PatchKind kind;
    kind.surface = surface_preset("brick");
    kind.surface.layers = {layer};
    kind.room_behind = room;
    kind.surface.open_below = !room;
    set.kinds = {kind};
    WeatherPatch p;
    p.normal = {0, 0, -1};
    p.visible = open_sky(p.normal);
    p.sky_share = sky;
    set.patches = {p};
    set.link_begin = {0, 0};
    return set;
}
constexpr GroundLayer kBrick{0.3, 0.8, 1.7e6};

struct Outside {
    double air_c, humidity_pct, longwave_w_m2, wind_m_s;
};
Outside outside_of(const PatchState& s, double air_c, double humidity_pct)
{
    return {air_c, humidity_pct, s.longwave_w_m2, kWind_m_s * s.wind_factor};
}

// What reaches a wall at a temperature, W/m2: longwave, air, vapour, and heat from behind.
double heat_to(double wall_c, const Outside& o, const Surface& surface, double behind_c,
               double conductance)
{
    const double air_k = o.air_c + kZeroCelsiusK, wall_k = wall_c + kZeroCelsiusK;
    const double q_air = specific_humidity(vapour_pressure_pa(air_k, o.humidity_pct), kPressure_pa);
    // 0.16 / (ln(10 m / z0) ln(2 m / z0h)), and 1.31 dT^(1/3) beside it
    const double forced =
        air_density_kg_m3(air_k, q_air, kPressure_pa) * 0.16 /
        (std::log(10.0 / surface.roughness_m) * std::log(2.0 / (0.1 * surface.roughness_m))) *
        o.wind_m_s;
    const double exchange =
        forced + 1.31 * std::cbrt(std::abs(o.air_c - wall_c)) / kAirHeatCapacity;
    const double pa =
        wall_c < 0.0 ? saturation_pressure_ice_pa(wall_k) : saturation_pressure_water_pa(wall_k);
    const double settling = std::max(0.0, exchange * (q_air - specific_humidity(pa, kPressure_pa)));
    const double latent = wall_c < 0.0 ? kLatentSublimation : kLatentVaporisation;
    return surface.emissivity * (o.longwave_w_m2 - kStefanBoltzmann * std::pow(wall_k, 4)) +
           exchange * kAirHeatCapacity * (o.air_c - wall_c) + latent * settling +
           conductance * (behind_c - wall_c);
}
double balanced_c(const Outside& o, const Surface& surface, double behind_c, double conductance)
{
    double low = -40.0, high = 60.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (heat_to(middle, o, surface, behind_c, conductance) > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

TEST(WallHeat, ConvectionIsThatOfTarpAndStillAirDampsNoWall)
{
    EXPECT_NEAR(wall_convection_w_m2_k(8.0), 2.62, 1e-6);
    EXPECT_NEAR(wall_convection_w_m2_k(-8.0), 2.62, 1e-6);
    EXPECT_NEAR(wall_convection_w_m2_k(1.0), 1.31, 1e-6);
    SurfaceForcing f;
    f.air_temp_k = 279.15;
    f.rel_humidity_pct = 0.0;
    f.wind_m_s = 0.5;
    SurfaceSkin skin;
    skin.roughness_m = 0.005;
    skin.wet_fraction = 0.0;
    const auto per_kelvin = [&](double gravity, double surface_k) {
        skin.gravity_across = gravity;
        return surface_balance(f, skin, {}, surface_k).sensible_w_m2 / (surface_k - f.air_temp_k);
    };
    const double neutral = air_density_kg_m3(279.15, 0.0, 101325.0) * kAirHeatCapacity * 0.5 *
                           neutral_exchange(10.0, 2.0, 0.005);
    EXPECT_NEAR(per_kelvin(0.0, 271.15), neutral + 2.62, 1e-6);  // colder than the air
    EXPECT_NEAR(per_kelvin(0.0, 287.15), neutral + 2.62, 1e-6);  // warmer
    // Level ground below it is damped when it is cold and boiling when it is warm; a ceiling the
    // other way round.
    EXPECT_LT(per_kelvin(1.0, 271.15), 0.5 * neutral);
    EXPECT_GT(per_kelvin(1.0, 287.15), 2.0 * neutral);
    EXPECT_EQ(per_kelvin(-1.0, 271.15), per_kelvin(1.0, 287.15));
    // Halfway between.
    EXPECT_GT(per_kelvin(0.5, 271.15), per_kelvin(1.0, 271.15));
    EXPECT_LT(per_kelvin(0.5, 271.15), per_kelvin(0.0, 271.15));
}

TEST(WallHeat, AWallOfAHouseIsAsWarmAsItsBalance)
{
    const PatchSet set = wall(kBrick, true, 0.5);
    const Surface& surface = set.kinds[0].surface;
    const double conductance = 1.0 / (1.0 / 1.5 - 0.04);  // from 1.5 W m-2 K-1 through all of it
    for (const double air_c : {kColdAir_c, kWarmAir_c}) {
        const ForcingTable table = thaw(air_c < 0.0 ? 400 : 0, 400, 50.0);
        PatchWeather patches(table, set, {}, table.time_us.front());
        patches.go_to(table.time_us[390]);
        const PatchState s = patches.state(0);
        const double humidity = air_c < 0.0 ? 85.0 : 50.0;
        const double expected_c =
            balanced_c(outside_of(s, air_c, humidity), surface, 20.0, conductance);
        EXPECT_NEAR(s.cell.surface_temp_c, expected_c, 0.02) << air_c;
        EXPECT_EQ(s.hoar_kg_m2, 0.0) << "a heated wall stays above the frost point";
    }
    // In summer weather of no wind a room as warm as the air takes no heat: the wall is only as
    // cold as its sky makes it.
    PatchParams cold_room;
    cold_room.room_temp_k = kZeroCelsiusK + kWarmAir_c;
    const ForcingTable table = thaw(0, 400, 50.0);
    PatchWeather patches(table, set, cold_room, table.time_us.front());
    patches.go_to(table.time_us[390]);
    const PatchState s = patches.state(0);
    EXPECT_NEAR(s.cell.surface_temp_c,
                balanced_c(outside_of(s, kWarmAir_c, 50.0), surface, kWarmAir_c, conductance),
                0.02);
}

TEST(WallHeat, AThinWallWarmsWithItsTimeConstant)
{
    const GroundLayer slab{0.1, 5.0, 2.0e6};
    const PatchSet set = wall(slab, false, 1.0);
    const Surface& surface = set.kinds[0].surface;
    const ForcingTable table = thaw(96, 240, 30.0, 30.0);  // too dry for dew
    PatchParams params;
    params.model.step_s = 300.0;
    params.model.substep_s = 300.0;
    PatchWeather patches(table, set, params, table.time_us.front());
    patches.go_to(table.time_us[230]);
    const double end_c = patches.state(0).cell.surface_temp_c;
    EXPECT_NEAR(end_c,
                balanced_c(outside_of(patches.state(0), kWarmAir_c, 30.0), surface, kWarmAir_c,
                           1.0 / (0.1 + slab.thickness_m / slab.conductivity_w_m_k)),
                0.05);
    // From both sides: what a kelvin of the wall changes in its balance, and 10 W m-2 K-1 behind.
    const Outside o = outside_of(patches.state(0), kWarmAir_c, 30.0);
    patches.go_to(table.time_us[100]);
    const double from_c = patches.state(0).cell.surface_temp_c;
    const double front =
        heat_to(from_c, o, surface, 0.0, 0.0) - heat_to(end_c, o, surface, 0.0, 0.0);
    const double tau_s =
        slab.thickness_m * slab.heat_capacity_j_m3_k / (front / (end_c - from_c) + 10.0);
    const double later_s = 3.0 * 3600.0;
    patches.go_to(table.time_us[103]);
    const double left = (end_c - patches.state(0).cell.surface_temp_c) / (end_c - from_c);
    EXPECT_NEAR(-later_s / std::log(left), tau_s, 0.06 * tau_s);
    EXPECT_GT(tau_s, 3600.0);
}

TEST(WallHeat, HoarGrowsAtTheRateOfTheExchangeAndIsGoneWhenTheBalanceHasMeltedIt)
{
    const GroundLayer slab{0.1, 50.0, 1.0e6};  // of one temperature
    const PatchSet set = wall(slab, false, 1.0);
    const Surface& surface = set.kinds[0].surface;
    constexpr std::size_t kCold = 96;
    const ForcingTable table = thaw(kCold, 240, 70.0);
    PatchParams params;
    params.model.step_s = params.model.substep_s = 300.0;
    PatchWeather patches(table, set, params, table.time_us.front());
    patches.go_to(table.time_us[90]);
    const PatchState before = patches.state(0);
    ASSERT_LT(before.cell.surface_temp_c, kColdAir_c - 1.2) << "below the frost point";
    patches.go_to(table.time_us[91]);
    const PatchState frosty = patches.state(0);
    // kg m-2 an hour: the exchange times the difference of humidity
    const double air_k = kZeroCelsiusK + kColdAir_c;
    const double q_air = specific_humidity(vapour_pressure_pa(air_k, 85.0), kPressure_pa);
    const double q_wall = specific_humidity(
        saturation_pressure_ice_pa(frosty.cell.surface_temp_c + kZeroCelsiusK), kPressure_pa);
    const double exchange =
        air_density_kg_m3(air_k, q_air, kPressure_pa) *
            neutral_exchange(10.0, 2.0, surface.roughness_m) * kWind_m_s * frosty.wind_factor +
        wall_convection_w_m2_k(kColdAir_c - frosty.cell.surface_temp_c) / kAirHeatCapacity;
    EXPECT_NEAR(frosty.hoar_kg_m2 - before.hoar_kg_m2, exchange * (q_air - q_wall) * 3600.0,
                0.02 * (frosty.hoar_kg_m2 - before.hoar_kg_m2));

    // Thaw, from an hour after the change of air. One lump of heat: while it is below 0 C frost
    // settles on it, at 0 C what reaches it melts what lies there.
    patches.go_to(table.time_us[kCold + 1]);
    const PatchState cold = patches.state(0);
    ASSERT_GT(cold.hoar_kg_m2, 0.05);
    ASSERT_LT(cold.cell.surface_temp_c, -2.0);
    const Outside o = outside_of(cold, kWarmAir_c, 70.0);
    const double behind = 1.0 / (0.1 + 0.5 * slab.thickness_m / slab.conductivity_w_m_k);
    const double warm_q =
        specific_humidity(vapour_pressure_pa(kZeroCelsiusK + kWarmAir_c, 70.0), kPressure_pa);
    double wall_c = cold.cell.surface_temp_c, ice = cold.hoar_kg_m2, hours = 1.0;
    for (const double dt_h = 0.001; ice > 0.0 && hours < 48.0; hours += dt_h) {
        const double melting = std::min(wall_c, -1e-9);
        const double heat_j_m2 = heat_to(melting, o, surface, kWarmAir_c, behind) * dt_h * 3600.0;
        const double q =
            specific_humidity(saturation_pressure_ice_pa(melting + kZeroCelsiusK), kPressure_pa);
        const double rate = air_density_kg_m3(kZeroCelsiusK + kWarmAir_c, warm_q, kPressure_pa) *
                                neutral_exchange(10.0, 2.0, surface.roughness_m) * o.wind_m_s +
                            wall_convection_w_m2_k(kWarmAir_c - melting) / kAirHeatCapacity;
        ice += rate * (warm_q - q) * dt_h * 3600.0;
        if (wall_c < 0.0)
            wall_c += heat_j_m2 / (slab.thickness_m * slab.heat_capacity_j_m3_k);
        else
            ice -= heat_j_m2 / kLatentFusion;
    }
    double gone = 0.0;
    const auto go_on = [&](double h) {
        patches.go_to(table.time_us[kCold] + static_cast<std::int64_t>(h * 3600e6));
        return patches.state(0);
    };
    for (double h = 1.25; h < 48.0 && gone == 0.0; h += 0.25)
        if (go_on(h).hoar_kg_m2 < 1e-4) gone = h;
    EXPECT_NEAR(gone, hours, 0.03 * hours + 0.25);
    for (double h = gone; h < 140.0; h += 7.0)
        EXPECT_LT(go_on(h).hoar_kg_m2, 1e-4) << h << " h after";
    RecordProperty("hours_by_hand", std::to_string(hours));
    RecordProperty("hours_of_model", std::to_string(gone));
}

// A leaf gives its heat to the air on both sides: what reaches it equals what leaves it, and so it stays near the air.
TEST(LeafHeat, BothSidesOfALeafGiveItsHeatToTheAir)
{
    const GroundLayer thin{0.02, 0.5, 2.0e6};
    const double warm_w_m2 = 900.0;  // of the longwave, in place of a sun
    ForcingTable table = thaw(0, 30, 50.0);
    for (double& longwave : table[Field::Longwave]) longwave = warm_w_m2;
    double over_air_k[2] = {};
    for (const double width_m : {0.0, 0.05}) {
        PatchSet set = wall(thin, false, 1.0);
        set.kinds[0].surface.leaf_width_m = width_m;
        set.patches[0].normal = {0, 1, 0};
        set.patches[0].visible = open_sky(set.patches[0].normal);
        PatchParams params;
        params.model.exchange.stability = Stability::Neutral;
        PatchWeather patches(table, set, params, table.time_us.front());
        patches.go_to(table.time_us[28]);
        const PatchState s = patches.state(0);
        const double leaf_k = s.cell.surface_temp_c + kZeroCelsiusK, air_k = kWarmAir_c + kZeroCelsiusK;
        const double q_air = specific_humidity(vapour_pressure_pa(air_k, 50.0), kPressure_pa);
        const Surface& surface = set.kinds[0].surface;
        const double level = air_density_kg_m3(air_k, q_air, kPressure_pa) *
                             neutral_exchange(10.0, 2.0, surface.roughness_m) * kWind_m_s;
        const double given = surface.emissivity * (s.longwave_w_m2 - kStefanBoltzmann * std::pow(leaf_k, 4.0));
        const double behind = 1.0 / (0.1 + thin.thickness_m / thin.conductivity_w_m_k);
        const double left = (leaf_k - air_k) * ((level + leaf_exchange(width_m, kWind_m_s)) * kAirHeatCapacity + behind);
        EXPECT_NEAR(left, given, 0.01 * given) << width_m;
        over_air_k[width_m > 0.0 ? 1 : 0] = leaf_k - air_k;
    }
    EXPECT_LT(over_air_k[1], 0.6 * over_air_k[0]);
    EXPECT_LT(over_air_k[1], 12.0);
    EXPECT_GT(over_air_k[1], 2.0);
}

TEST(LeafHeat, IsThatOfAPlateInAThirdOfTheWind)
{
    // 0.135 mol m-2 s-1 sqrt(u / d), 1.4 of it outdoors, two sides: u 1 m/s, d 5 cm.
    EXPECT_NEAR(leaf_exchange(0.05, 3.0), 2.0 * 0.189 * 0.02897 * std::sqrt(20.0), 1e-9);
    EXPECT_EQ(leaf_exchange(0.0, 3.0), 0.0);
    EXPECT_GT(leaf_exchange(0.01, 3.0), leaf_exchange(0.05, 3.0)) << "small leaves are cooler";
}

}  // namespace
}  // namespace petrichor::weather
