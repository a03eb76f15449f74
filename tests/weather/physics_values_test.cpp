// Every value of the physics tables that the formulas were specified with, to the digits printed.
#include <gtest/gtest.h>

#include <cmath>

#include "weather/physics/air.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/portable_math.h"
#include "weather/physics/drainage.h"
#include "weather/physics/evaporation.h"
#include "weather/physics/exchange.h"
#include "weather/physics/ground.h"
#include "weather/physics/humidity.h"
#include "weather/physics/longwave.h"
#include "weather/physics/phase.h"
#include "weather/physics/snow.h"
#include "weather/physics/snow_simple.h"
#include "weather/physics/solar.h"
#include "weather/physics/stores.h"
#include "weather/physics/surface_energy.h"

namespace petrichor::weather {
namespace {

double kelvin(double celsius)
{
    return celsius + kZeroCelsiusK;
}

// Half a unit of the last digit printed.
constexpr double kDigits3 = 5e-4 + 1e-12, kDigits4 = 5e-5 + 1e-12, kDigits5 = 5e-6 + 1e-12,
                 kDigits6 = 5e-7 + 1e-12;

TEST(Humidity, SaturationPressures)
{
    const double water[][2] = {
        {-20, 125.6491}, {0, 611.213}, {10, 1226.5927}, {20, 2333.7488}, {30, 4234.617}};
    for (const auto& [t, pa] : water)
        EXPECT_NEAR(saturation_pressure_water_pa(kelvin(t)), pa, 5.1e-4) << t;
    const double ice[][2] = {{-20, 103.0824}, {-10, 259.6612}, {0, 611.15}};
    for (const auto& [t, pa] : ice)
        EXPECT_NEAR(saturation_pressure_ice_pa(kelvin(t)), pa, kDigits4) << t;
}

TEST(Humidity, SpecificHumidityAndDensity)
{
    const double e = vapour_pressure_pa(kelvin(10), 80);
    const double q = specific_humidity(e, 101325);
    EXPECT_NEAR(q, 6.045843e-3, 5e-10);
    EXPECT_NEAR(air_density_kg_m3(kelvin(10), q, 101325), 1.242078, kDigits6);
    const double q2 = specific_humidity(vapour_pressure_pa(kelvin(-5), 90), 87000);
    EXPECT_NEAR(air_density_kg_m3(kelvin(-5), q2, 87000), 1.128408, kDigits6);
    EXPECT_NEAR(vapour_pressure_of_specific_humidity_pa(q, 101325), e, 1e-9);
}

TEST(Humidity, DewPointIsTheInverseOfSaturation)
{
    for (double t = 230; t < 315; t += 3.7) {
        EXPECT_NEAR(dew_point_k(saturation_pressure_water_pa(t)), t, 1e-10);
        EXPECT_NEAR(rel_humidity_of_dew_point_pct(t, t), 100.0, 1e-12);
    }
}

TEST(Humidity, WetBulb)
{
    const double cases[][4] = {{20, 50, 101325, 13.8535},
                               {2, 60, 101325, -0.4770},
                               {2, 60, 85000, -0.7482},
                               {1, 90, 87000, 0.3694}};
    for (const auto& [t, rh, p, tw] : cases) {
        EXPECT_NEAR(wet_bulb_k(kelvin(t), vapour_pressure_pa(kelvin(t), rh), p) - kZeroCelsiusK, tw,
                    kDigits4);
    }
}

TEST(Humidity, HeightTransfer)
{
    EXPECT_NEAR(snow_line_m(kelvin(5), 200, kelvin(1)), 815.4, 0.05);
    EXPECT_NEAR(temperature_of_snow_line_k(815.3846153846154, 200, kelvin(1)), kelvin(5), 1e-9);
    EXPECT_NEAR(lapse_temperature_k(280, 100, 1100), 273.5, 1e-12);
    EXPECT_NEAR(lapse_wind_m_s(2.0, 10, 10, 0.01), 2.0, 1e-12);
    EXPECT_NEAR(standard_pressure_pa(0), 101325, 1e-9);
}

TEST(Phase, FourLaws)
{
    const double humidity[][3] = {{-2, 90, 0.99151}, {0, 100, 0.73885}, {1, 90, 0.62948},
                                  {2, 60, 0.86057},  {2, 95, 0.20916},  {4, 50, 0.47502}};
    for (const auto& [t, rh, fs] : humidity)
        EXPECT_NEAR(snow_fraction_humidity(kelvin(t), rh), fs, kDigits5);
    const double wet[][3] = {{-2, 90, 0.99878}, {0, 100, 0.83596}, {1, 90, 0.70387},
                             {2, 60, 0.95008},  {2, 95, 0.15082},  {4, 50, 0.72401}};
    const PhaseParams by_wet_bulb{.law = PhaseLaw::WetBulb};
    for (const auto& [t, rh, fs] : wet) {
        EXPECT_NEAR(snow_fraction(by_wet_bulb, kelvin(t), rh, 90000), fs, kDigits5);
    }
    EXPECT_NEAR(half_snow_temperature_k(100), kelvin(0.738), kDigits3);
    EXPECT_NEAR(half_snow_temperature_k(75), kelvin(2.333), kDigits3);
    EXPECT_NEAR(half_snow_temperature_k(50), kelvin(3.929), kDigits3);
    EXPECT_DOUBLE_EQ(snow_fraction({}, kelvin(1), 90, 9e4), 0.5);
    const PhaseParams threshold{.law = PhaseLaw::Threshold};
    EXPECT_EQ(snow_fraction(threshold, kelvin(0.99), 90, 9e4), 1.0);
    EXPECT_EQ(snow_fraction(threshold, kelvin(1.01), 90, 9e4), 0.0);
}

TEST(Phase, EveryLawFallsWithTemperature)
{
    for (const PhaseLaw law :
         {PhaseLaw::Linear, PhaseLaw::Humidity, PhaseLaw::WetBulb, PhaseLaw::Threshold}) {
        double last = 1.0;
        for (double t = -20; t < 20; t += 0.25) {
            const double fs = snow_fraction({.law = law}, kelvin(t), 85, 95000);
            EXPECT_LE(fs, last + 1e-15);
            EXPECT_GE(fs, 0.0);
            last = fs;
        }
    }
}

TEST(Exchange, Coefficients)
{
    EXPECT_NEAR(neutral_exchange(10, 2, 0.01), 3.047319e-3, 5e-10);
    EXPECT_NEAR(neutral_exchange(10, 2, 0.001), 1.754107e-3, 5e-10);
    const double ch = neutral_exchange(10, 2, 0.01);
    const double rows[][2] = {
        {-0.5, 2.227394}, {-0.1, 1.456553}, {0.05, 0.543914}, {0.2, 0.190744}};
    for (const auto& [ri, fh] : rows) EXPECT_NEAR(stability_factor(ri, ch, 10, 0.01), fh, 1e-6);
    EXPECT_NEAR(bulk_richardson(10, 275.15, 273.15, 3), 0.0792295, 5e-8);
    EXPECT_DOUBLE_EQ(stability_factor(0.0, ch, 10, 0.01), 1.0);
}

TEST(Snow, Laws)
{
    EXPECT_NEAR(new_snow_density_pahaut(kelvin(-5), 4), 131.0, 1e-9);
    EXPECT_NEAR(new_snow_density_pahaut(kelvin(0), 2), 145.770, kDigits3);
    EXPECT_NEAR(new_snow_density_hedstrom_pomeroy(kelvin(-5)), 75.355, kDigits3);
    EXPECT_NEAR(new_snow_density_hedstrom_pomeroy(kelvin(0)), 119.17, kDigits3);
    EXPECT_NEAR(settled_density(100, 300, 86400), 122.616, kDigits3);
    EXPECT_NEAR(settled_density(100, 500, 86400), 145.232, kDigits3);
    SnowParams p;
    p.irreducible_water = 0.03;
    EXPECT_NEAR(aged_albedo(p, 0.85, 86400, false), 0.841700, kDigits6);
    EXPECT_NEAR(aged_albedo(p, 0.85, 86400, true), 0.775320, kDigits6);
    EXPECT_NEAR(refreshed_albedo(p, 0.6, 5), 0.698367, kDigits6);
    EXPECT_NEAR(snow_conductivity(100), 0.034443, kDigits6);
    EXPECT_NEAR(snow_conductivity(300), 0.271698, kDigits6);
    EXPECT_NEAR(melt_kg_m2(100, 3600), 1.077844, kDigits6);
    EXPECT_NEAR(cold_content_j_m2(50, kelvin(-5)), 525000, 1e-6);
    EXPECT_NEAR(cold_content_j_m2(50, kelvin(-5)) / kLatentFusion, 1.571856, kDigits6);
    EXPECT_NEAR(liquid_capacity_kg_m2(p, 0.5, 150), 10.09269, kDigits5);
    // Heavier and warmer snow settles faster, and water makes it soft.
    const double settling = compaction_rate(p, 250, 100, kelvin(-5), 0.0);
    EXPECT_GT(compaction_rate(p, 250, 200, kelvin(-5), 0.0), settling);
    EXPECT_GT(compaction_rate(p, 250, 100, kelvin(-1), 0.0), settling);
    EXPECT_NEAR(compaction_rate(p, 400, 100, kelvin(0), 0.02) /
                    compaction_rate(p, 400, 100, kelvin(0), 0.0),
                1.0 + 0.02 * p.viscosity_wetness, 0.01);
}

TEST(Snow, SimpleModels)
{
    EXPECT_NEAR(degree_day_melt_kg_m2(kelvin(-2), kelvin(4), 6 * 3600.0, 4), 1.333333, kDigits6);
    EXPECT_NEAR(degree_day_melt_kg_m2(kelvin(4), kelvin(-2), 6 * 3600.0, 4), 1.333333, kDigits6);
    EXPECT_EQ(degree_day_melt_kg_m2(kelvin(-4), kelvin(-2), 3600, 4), 0.0);
    EXPECT_NEAR(radiation_melt_kg_m2_h(kelvin(3), 0.7, 400), 1.278, 1e-9);
    EXPECT_NEAR(drift_threshold_m_s(kelvin(-10), false), 7.96, 1e-9);
    EXPECT_EQ(drift_threshold_m_s(kelvin(-1), true), 9.9);
    EXPECT_NEAR(canopy_interception_kg_m2(0, 5, 3.96), 4.3466, kDigits4);
}

TEST(SurfaceEnergy, MeltFluxAtZero)
{
    const SurfaceForcing f{.shortwave_w_m2 = 500,
                           .longwave_w_m2 = 280,
                           .air_temp_k = kelvin(5),
                           .rel_humidity_pct = 70,
                           .wind_m_s = 3,
                           .pressure_pa = 87000};
    const SurfaceSkin skin{.albedo = 0.6, .emissivity = 0.98, .roughness_m = 0.01, .icy = true};
    const auto at = surface_balance(f, skin, {.stability = Stability::Neutral}, kZeroCelsiusK);
    EXPECT_NEAR(at.net_radiation_w_m2, 165.055, kDigits3);
    EXPECT_NEAR(at.sensible_w_m2, -49.923, kDigits3);
    EXPECT_NEAR(at.latent_w_m2, 0.152, kDigits3);
    EXPECT_NEAR(at.balance_w_m2, 214.827, kDigits3);
    EXPECT_NEAR(melt_kg_m2(at.balance_w_m2, 3600), 2.31550, kDigits5);
}

TEST(SurfaceEnergy, NightSkinTemperature)
{
    const SurfaceForcing f{.shortwave_w_m2 = 0,
                           .longwave_w_m2 = 230,
                           .air_temp_k = kelvin(-5),
                           .rel_humidity_pct = 80,
                           .wind_m_s = 3,
                           .pressure_pa = 87000};
    const SurfaceSkin skin{.emissivity = 0.98,
                           .roughness_m = 0.01,
                           .icy = true,
                           .conductance_w_m2_k = 2.0,
                           .below_temp_k = 270.0};
    const auto at = solve_surface(f, skin, {.stability = Stability::Neutral}, kelvin(-5));
    EXPECT_NEAR(at.surface_temp_k, 265.0322, kDigits4);
    EXPECT_NEAR(at.balance_w_m2, 0.0, 1e-6);
}

// Rain is as warm as the air; the key takes a share of the heat that it brings.
TEST(SurfaceEnergy, RainBringsTheHeatThatItsKeySays)
{
    constexpr double kRate_kg_m2_s = 1.0 / 3600.0;
    const SurfaceForcing f{.air_temp_k = kelvin(10.0), .rel_humidity_pct = 60.0, .rain_kg_m2_s = kRate_kg_m2_s};
    const double all_w_m2 = 3.0 * kRate_kg_m2_s * kWaterHeatCapacity;
    EXPECT_NEAR(surface_balance(f, {}, {}, kelvin(7.0)).rain_heat_w_m2, all_w_m2, 1e-9);
    EXPECT_NEAR(surface_balance(f, {}, {.rain_heat = 0.25}, kelvin(7.0)).rain_heat_w_m2, 0.25 * all_w_m2, 1e-9);
    EXPECT_EQ(surface_balance(f, {}, {.rain_heat = 0.0}, kelvin(7.0)).rain_heat_w_m2, 0.0);
}

TEST(Evaporation, PenmanMonteith)
{
    const double ch = neutral_exchange(10, 2, 0.01);
    const auto day = penman_monteith({400, 50, kelvin(20), 50, 101325, 2, ch});
    EXPECT_NEAR(day.aerodynamic_resistance_s_m, 164.079, kDigits3);
    EXPECT_NEAR(day.latent_w_m2, 281.647, kDigits3);
    EXPECT_NEAR(day.rate_kg_m2_s * 3600, 0.40541, kDigits5);
    EXPECT_NEAR(0.5 / day.rate_kg_m2_s / 60, 74.0, 0.05);
    const auto night = penman_monteith({0, -20, kelvin(10), 80, 101325, 3, ch});
    EXPECT_NEAR(night.latent_w_m2, 30.104, kDigits3);
    EXPECT_NEAR(night.rate_kg_m2_s * 3600, 0.04333, kDigits5);
}

TEST(Drainage, Reservoir)
{
    EXPECT_NEAR(drain_film(1, 0, 0.003, 0.2, 60).water_kg_m2, 0.868216, kDigits6);
    EXPECT_NEAR(drain_film(1, 0, 0.003, 0.2, 600).water_kg_m2, 0.332239, kDigits6);
    EXPECT_NEAR(drain_film(0, 10.0 / 3600, 0.003, 0.2, 1e5).water_kg_m2, 1.125926, kDigits6);
    EXPECT_NEAR(rrl_film_mm(5, 10, 50), 0.711274, kDigits6);
    EXPECT_NEAR(rrl_film_mm(5, 50, 50), 1.590457, kDigits6);
    EXPECT_NEAR(manning_film_mm(5, 10, 0.012, 0.02), 0.277204, kDigits6);
    EXPECT_NEAR(horton_depth_mm({50, 5, 4, 0}, 1), 16.04395, kDigits5);
}

// One exact step equals many small ones, whatever crossings happen inside, and mass closes.
TEST(Drainage, ReservoirStepsCompose)
{
    for (const double start : {0.0, 0.05, 0.2, 0.9, 3.0}) {
        for (const double net : {-2e-3, -1e-4, -1e-6, 0.0, 1e-6, 1e-4, 3e-3}) {
            const auto whole = drain_film(start, net, 0.003, 0.2, 900);
            double w = start, drained = 0, shortfall = 0;
            for (int i = 0; i < 90; ++i) {
                const auto part = drain_film(w, net, 0.003, 0.2, 10);
                w = part.water_kg_m2;
                drained += part.drained_kg_m2;
                shortfall += part.shortfall_kg_m2;
            }
            EXPECT_NEAR(whole.water_kg_m2, w, 1e-12) << start << " " << net;
            EXPECT_NEAR(whole.drained_kg_m2, drained, 1e-11);
            EXPECT_NEAR(whole.shortfall_kg_m2, shortfall, 1e-12);
            EXPECT_NEAR(whole.water_kg_m2 + whole.drained_kg_m2 - whole.shortfall_kg_m2,
                        start + 900 * net, 1e-14);
        }
    }
}

TEST(Stores, UniformLevels)
{
    const Hypsometry h = uniform_hypsometry(10);
    EXPECT_DOUBLE_EQ(h.capacity_kg_m2(), 5.0);
    for (const auto& [share, level] : {std::pair{0.04, 0.2}, {0.25, 0.5}, {0.64, 0.8}}) {
        EXPECT_NEAR(water_level_mm(h, share * 5.0) / 10.0, level, 1e-12);
    }
}

TEST(Radiation, ClearSkyAndClouds)
{
    const auto sine = [](double deg) { return detail::sine_cosine(deg * kPi / 180).sin; };
    EXPECT_NEAR(clear_sky_w_m2(sine(10)), 137.314, kDigits3);
    EXPECT_NEAR(clear_sky_w_m2(sine(30)), 489.850, kDigits3);
    EXPECT_NEAR(clear_sky_w_m2(sine(60)), 890.325, kDigits3);
    EXPECT_NEAR(cloudy_sky_w_m2(sine(30), 0.5), 455.046, kDigits3);
    EXPECT_NEAR(cloudy_sky_w_m2(sine(30), 1), 122.462, kDigits3);
    EXPECT_NEAR(rainy_sky_w_m2(sine(30), 1), 0.16 * 489.850, kDigits3);
    EXPECT_NEAR(rainy_sky_w_m2(sine(30), 0), 489.850, kDigits3);
    for (double n = 0.05; n < 1; n += 0.05) {
        EXPECT_NEAR(cloud_fraction_of(cloudy_sky_w_m2(0.5, n), 0.5), n, 1e-9);
        EXPECT_NEAR(cloud_fraction_of_diffuse(0.3 + 0.7 * n * n), n, 1e-9);
    }
    const double e1 = vapour_pressure_pa(kelvin(0), 80), e2 = vapour_pressure_pa(kelvin(15), 60);
    EXPECT_NEAR(clear_sky_emissivity(kelvin(0), e1), 0.72548, kDigits5);
    EXPECT_NEAR(clear_sky_emissivity(kelvin(15), e2), 0.75407, kDigits5);
    EXPECT_NEAR(longwave_from_sky_w_m2(kelvin(0), e1, 0), 229.004, kDigits3);
    EXPECT_NEAR(longwave_from_sky_w_m2(kelvin(15), e2, 0), 294.779, kDigits3);
    // Martin & Berdahl 1984: 0.013 more at midnight, as much less at noon, by the sun of the place.
    const std::int64_t hour_us = 3600LL * 1000000;
    EXPECT_NEAR(emissivity_of_hour(0, 0.0), 0.013, 1e-12);
    EXPECT_NEAR(emissivity_of_hour(12 * hour_us, 0.0), -0.013, 1e-12);
    EXPECT_NEAR(emissivity_of_hour(6 * hour_us, 0.0), 0.0, 1e-12);
    EXPECT_NEAR(emissivity_of_hour(18 * hour_us, -90.0), -0.013, 1e-12);
    EXPECT_NEAR(emissivity_of_hour(-36 * hour_us, 0.0), -0.013, 1e-12) << "before 1970";
    EXPECT_NEAR(longwave_from_sky_w_m2(kelvin(15), e2, 0, -0.013) -
                    longwave_from_sky_w_m2(kelvin(15), e2, 0),
                -0.013 * 5.670374419e-8 * std::pow(kelvin(15), 4.0), 1e-9);
    EXPECT_EQ(longwave_from_sky_w_m2(kelvin(15), e2, 1, -0.013),
              longwave_from_sky_w_m2(kelvin(15), e2, 1));
    EXPECT_LE(longwave_from_sky_w_m2(kelvin(25), vapour_pressure_pa(kelvin(25), 100), 1),
              kStefanBoltzmann * std::pow(kelvin(25), 4) + 1e-9);
}

TEST(Solar, Elevation)
{
    const auto elevation = [](double n, double hour) {
        const double dec = 23.44 * std::sin(2 * kPi * (284 + n) / 365) * kPi / 180;
        return std::asin(sine_of_elevation(45.3 * kPi / 180, dec, hour)) * 180 / kPi;
    };
    EXPECT_NEAR(elevation(355, 12), 21.260, kDigits3);
    EXPECT_NEAR(elevation(172, 15), 47.653, kDigits3);
}

// Solstices and equinox against the almanac: the declination shows in the noon elevation.
TEST(Solar, AlmanacDirections)
{
    // 2005-12-21 12:00 UTC at Greenwich; noon is 1.8 minutes earlier, which changes nothing in
    // elevation.
    const auto winter = sun_direction(1135166400LL * 1000000, 51.48, 0.0);
    EXPECT_NEAR(std::asin(winter.up) * 180 / kPi, 90 - 51.48 - 23.44, 0.1);
    const auto summer = sun_direction(1119355200LL * 1000000, 51.48, 0.0);  // 2005-06-21 12:00
    EXPECT_NEAR(std::asin(summer.up) * 180 / kPi, 90 - 51.48 + 23.44, 0.1);
    EXPECT_LT(summer.north, 0.0);
    const auto morning = sun_direction((1119355200LL - 6 * 3600) * 1000000, 51.48, 0.0);
    EXPECT_GT(morning.east, 0.8);
    EXPECT_NEAR(
        morning.east * morning.east + morning.north * morning.north + morning.up * morning.up, 1,
        1e-12);
    // November: the sun is 16.4 minutes early, so at 11:43:36 UTC it stands in the south.
    const auto early =
        sun_direction((1130932800LL + 11 * 3600 + 43 * 60 + 36) * 1000000LL, 51.48, 0.0);
    EXPECT_NEAR(early.east, 0.0, 2e-3);
}

// Within an hour of its moment it is where the almanac has it.
TEST(Solar, NearAMomentIsTheAlmanacs)
{
    for (int day = 0; day < 366; day += 13) {
        for (int hour = 0; hour < 24; hour += 5) {
            const std::int64_t at = (1104537600LL + day * 86400 + hour * 3600) * 1000000;
            const SunNear track(at, Observer(57.7, 11.96));
            for (const int minutes : {-60, -13, 0, 30, 60}) {
                const std::int64_t us = at + minutes * 60000000LL;
                const SunDirection a = track.at(us), b = sun_direction(us, 57.7, 11.96);
                const double apart = std::hypot(a.east - b.east, a.north - b.north, a.up - b.up);
                EXPECT_LT(apart, minutes == 0 ? 1e-12 : 0.05 * kPi / 180) << day << " " << hour;
                EXPECT_NEAR(a.extraterrestrial_w_m2, b.extraterrestrial_w_m2, 0.05);
            }
        }
    }
}

TEST(Air, VisibilityAndDrops)
{
    EXPECT_DOUBLE_EQ(extinction_1_m(1000, VisibilityKind::Contrast2Percent), 3.912e-3);
    EXPECT_DOUBLE_EQ(extinction_1_m(1000, VisibilityKind::Optical5Percent), 2.996e-3);
    EXPECT_DOUBLE_EQ(visibility_m(extinction_1_m(730, VisibilityKind::Optical5Percent),
                                  VisibilityKind::Optical5Percent),
                     730);
    const auto drops = rain_drops(10);
    EXPECT_NEAR(drops.slope_1_mm, 2.528, kDigits3);
    EXPECT_NEAR(drops.per_m3, 3165, 0.5);
    EXPECT_NEAR(drop_fall_speed_m_s(2), 9.65 - 10.3 * std::exp(-1.2), 1e-12);
}

TEST(Ground, HalfSpace)
{
    const double diffusivity = 0.75 / 1.94e6;
    EXPECT_NEAR(half_space_warming_k(10, 0.05, diffusivity, 3600), 3.433, kDigits3);
    EXPECT_NEAR(half_space_flux_w_m2(10, 0.75, diffusivity, 3600), 113.42, 5e-3);
    EXPECT_NEAR(damping_depth_m(diffusivity, 86400), 0.1031, kDigits4);
    // The layered ground does the same within a few percent.
    const GroundStack stack = make_ground_stack(0.75, 1.94e6, 60);
    GroundStep step;
    step.temp_k.fill(280);
    for (int i = 0; i < 60; ++i) step = step_ground(stack, step.temp_k, 290, 280);
    EXPECT_NEAR(step.temp_k[2] - 280, 3.433, 0.25);  // node at 0.05 m
    EXPECT_NEAR(step.flux_w_m2, 113.42, 6);
}

// Heat in through the top minus heat out at the bottom is the heat gained, for any step.
TEST(Ground, EnergyCloses)
{
    for (const double dt : {60.0, 600.0, 3600.0, 86400.0}) {
        const GroundStack stack = make_ground_stack(1.0, 2.0e6, dt);
        std::array<double, kGroundLayers> before{};
        for (std::size_t i = 0; i < kGroundLayers; ++i)
            before[i] = 275.0 + static_cast<double>(i * i % 7);
        const auto step = step_ground(stack, before, 290, 281);
        double gained = 0;
        for (std::size_t i = 0; i < kGroundLayers; ++i) {
            gained += 2.0e6 * kGroundThickness_m[i] * (step.temp_k[i] - before[i]);
            EXPECT_GE(step.temp_k[i], 275.0 - 1e-9);
            EXPECT_LE(step.temp_k[i], 290.0 + 1e-9);
        }
        const double out = (step.temp_k.back() - 281) * 1.0 / (0.5 * kGroundThickness_m.back());
        EXPECT_NEAR(gained, (step.flux_w_m2 - out) * dt, 1e-6 * (1 + std::abs(gained)));
    }
}

TEST(PortableMath, AgreesWithTheLibrary)
{
    for (double x = -700; x < 700; x += 0.0371) {
        ASSERT_NEAR(detail::exponential(x) / std::exp(x), 1.0, 8e-16) << x;
    }
    for (double x = 1e-300; x < 1e300; x *= 1.37) {
        ASSERT_NEAR(detail::logarithm(x), std::log(x), 4e-16 * std::max(1.0, std::abs(std::log(x))))
            << x;
    }
    for (double x = -400; x < 400; x += 0.0173) {
        const auto sc = detail::sine_cosine(x);
        ASSERT_NEAR(sc.sin, std::sin(x), 3e-14) << x;
        ASSERT_NEAR(sc.cos, std::cos(x), 3e-14) << x;
    }
}

}  // namespace
}  // namespace petrichor::weather
