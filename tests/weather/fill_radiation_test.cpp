// Sun, sky and cloud where a file has only some of them: laws first, then the one real file with
// net shortwave in six-hour rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/weather/reading.h"
#include "weather/forcing/forcing.h"
#include "weather/models/physical/physical.h"
#include "weather/physics/humidity.h"
#include "weather/physics/longwave.h"
#include "weather/physics/solar.h"
#include "weather/physics/surfaces.h"
#include "weather/readers/read_weather.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

constexpr std::int64_t kHour_us = 3600LL * 1000000;
constexpr double kFull = 300.0, kClear = 236.0;  // longwave, W/m2 at 0 C and 70 %

bool says(const ReadReport& report, const char* text)
{
    return to_text(report).find(text) != std::string::npos;
}

// Two days in May at 39 N 120 W, a row every `hours`, without shortwave or cloud.
ForcingTable without_sun(int hours)
{
    ForcingTable t;
    t.site = {.latitude_deg = 39, .longitude_deg = -120, .elevation_m = 500};
    const std::int64_t begin = 1683000000LL / 86400 * 86400 * 1000000;
    for (int h = 0; h <= 48; h += hours) {
        t.time_us.push_back(begin + h * kHour_us);
        t[Field::AirTemp].push_back(273.15 + 0.1 * h);
        t[Field::RelHumidity].push_back(70);
        t[Field::Longwave].push_back(h < 24 ? kClear : kFull);
        t[Field::Precip].push_back(h == 12 ? 1.0 / 3600 : 0);
    }
    return t;
}

double sum(const ForcingTable& t, Field f)
{
    double out = 0;
    for (std::size_t i = 0; i + 1 < t.rows(); ++i)
        out += t[f][i] * static_cast<double>(t.time_us[i + 1] - t.time_us[i]) * 1e-6;
    return out;
}

TEST(Cloud, OfLongwaveUndoesTheSky)
{
    const double t = 278.0, vapour = vapour_pressure_pa(t, 60);
    double before = 0;
    for (double cloud = 0; cloud <= 1.0; cloud += 0.05) {
        const double lw = longwave_from_sky_w_m2(t, vapour, cloud);
        EXPECT_NEAR(cloud_of_longwave(t, vapour, lw), cloud, 1e-9);
        const double noon = longwave_from_sky_w_m2(t, vapour, cloud, -0.013);
        EXPECT_NEAR(cloud_of_longwave(t, vapour, noon, -0.013), cloud, 1e-9);
        EXPECT_GE(lw, before);
        before = lw;
    }
    EXPECT_EQ(cloud_of_longwave(t, vapour, 100), 0.0);
    EXPECT_EQ(cloud_of_longwave(t, vapour, 600), 1.0);
}

// A share of the clear sky's sun, and how much of that is diffuse.
void fill_sun(ForcingTable& t, double of_clear, double diffuse)
{
    for (const std::int64_t us : t.time_us) {
        const SunDirection sun = sun_direction(us, t.site.latitude_deg, t.site.longitude_deg);
        const double w = of_clear * clear_sky_w_m2(sun.up);
        t[Field::Shortwave].push_back(w);
        t[Field::Diffuse].push_back(diffuse * w);
    }
}

TEST(FillRadiation, TheSkysOwnWarmthSaysHowCloudyItIs)
{
    ForcingTable t = without_sun(1);
    ReadReport report;
    fill_forcing(t, report);
    EXPECT_LT(t[Field::Cloud][20], 0.5);
    EXPECT_GT(t[Field::Cloud][26], 0.8);
    // Noon is at 20 h UTC.
    EXPECT_GT(t[Field::Shortwave][20], 700);
    EXPECT_LT(t[Field::Shortwave][44], 0.7 * t[Field::Shortwave][20]);
    EXPECT_TRUE(says(report, "from longwave")) << to_text(report);
}

// Hazy air takes a fifth of the sun, and is no cloud: where the file knows the diffuse light, its share
// says so.
TEST(FillRadiation, DiffuseLightTellsHazeFromClouds)
{
    ForcingTable t = without_sun(1);
    fill_sun(t, 0.8, 0.15);
    t[Field::Longwave].clear();
    ForcingTable blind = t;
    blind[Field::Diffuse].clear();
    ReadReport report, other;
    fill_forcing(t, report);
    fill_forcing(blind, other);
    EXPECT_EQ(t[Field::Cloud][20], 0.0);
    EXPECT_GT(blind[Field::Cloud][20], 0.5);
    EXPECT_LT(t[Field::Longwave][20], blind[Field::Longwave][20] - 15.0);
    t = without_sun(1);
    fill_sun(t, 0.3, 1.0);
    fill_forcing(t, report);
    EXPECT_EQ(t[Field::Cloud][20], 1.0);
}

// Three days: clear, clear but for a last hour in haze, overcast. Nights lie between the days beside
// them, and a low sun does not make one cloudy by itself.
TEST(FillRadiation, NightsLieBetweenTheDaysBesideThem)
{
    ForcingTable t;
    t.site = {.latitude_deg = 39, .longitude_deg = 0, .elevation_m = 500};
    const std::int64_t begin = 1683000000LL / 86400 * 86400 * 1000000;
    for (int h = 0; h <= 72; ++h) {
        t.time_us.push_back(begin + h * kHour_us);
        t[Field::AirTemp].push_back(280);
        t[Field::RelHumidity].push_back(60);
        t[Field::Precip].push_back(0);
        const double sine = sun_direction(t.time_us.back(), 39, 0).up;
        const double of_clear = h >= 48 ? 0.25 : h == 41 ? 0.6 : 1.0;
        t[Field::Shortwave].push_back(of_clear * clear_sky_w_m2(sine));
    }
    ReadReport report;
    fill_forcing(t, report);
    const auto& cloud = t[Field::Cloud];
    for (int h = 20; h <= 27; ++h) EXPECT_NEAR(cloud[static_cast<std::size_t>(h)], 0.0, 1e-6) << h;
    // The haze alone says 0.83.
    EXPECT_GT(cloud[41], 0.8);
    EXPECT_LT(cloud[42], 0.65);
    for (std::size_t h = 43; h <= 52; ++h) EXPECT_GT(cloud[h], cloud[h - 1]) << h;
    EXPECT_NEAR(cloud[60], 1.0, 1e-6);
    EXPECT_NEAR(cloud[71], 1.0, 1e-6);
    EXPECT_TRUE(says(report, "between that of the evening")) << to_text(report);
}

TEST(FillRadiation, WhatTheAirTellsIsCalledThat)
{
    ForcingTable t = without_sun(1);
    t[Field::Longwave].clear();
    ReadReport report;
    fill_forcing(t, report);
    EXPECT_TRUE(says(report, "full: something falls, or fog (1 row")) << to_text(report);
    EXPECT_TRUE(says(report, "from the air of a day")) << to_text(report);
    EXPECT_FALSE(says(report, "from shortwave")) << to_text(report);
}

TEST(FillRadiation, LongRowsAreDividedForTheSun)
{
    for (const int hours : {1, 3, 6, 24}) {
        ForcingTable t = without_sun(hours);
        const double water = sum(t, Field::Precip);
        ReadReport report;
        fill_forcing(t, report);
        // The last row lasts as long as the one before it.
        EXPECT_EQ(t.rows(), 49u + static_cast<unsigned>(hours) - 1u) << hours;
        EXPECT_NEAR(sum(t, Field::Precip), water, 1e-12) << hours;
        EXPECT_NEAR(t[Field::AirTemp][31], 273.15 + 3.1, 1e-9) << hours;
        const auto day = t[Field::Shortwave].begin();
        EXPECT_GT(*std::max_element(day, day + 24), 480) << hours;
        EXPECT_EQ(*std::min_element(day, day + 24), 0) << hours;
    }
    ForcingTable measured = without_sun(6);
    measured[Field::Shortwave].assign(measured.rows(), 100);
    ReadReport report;
    fill_forcing(measured, report);
    EXPECT_EQ(measured.rows(), 9u);
}

TEST(FillRadiation, NetShortwaveKeepsItsMeanAndTheNightStaysDark)
{
    ForcingTable t = without_sun(6);
    t[Field::NetShortwave] = {20, 0, 150, 300, 20, 0, 100, 200, 0};
    const double light = sum(t, Field::NetShortwave);
    ReadReport report;
    fill_forcing(t, report);
    EXPECT_NEAR(sum(t, Field::NetShortwave), light, 1e-9 * light);
    EXPECT_EQ(t[Field::NetShortwave][8], 0);
    EXPECT_GT(t[Field::NetShortwave][20], t[Field::NetShortwave][23]);
    for (std::size_t i = 0; i + 1 < t.rows(); ++i) {
        if (t[Field::Shortwave][i] == 0 && t[Field::Shortwave][i + 1] == 0) {
            EXPECT_EQ(t[Field::NetShortwave][i], 0) << i;
        }
    }
}

TEST(FillRadiation, TheGroundTakesUpTheNetShortwaveWhateverItsAlbedo)
{
    ForcingTable t = without_sun(6);
    t[Field::NetShortwave] = {20, 0, 150, 300, 20, 0, 100, 200, 0};
    ReadReport report;
    fill_forcing(t, report);
    for (const char* surface : {"asphalt", "concrete", "grass"}) {
        PhysicalParams p;
        p.surface = surface_preset(surface);
        double taken_up = 0;
        const PhysicalTimeline run(t, p);
        for (const CellState& c : run.series(run.begin_us(), run.end_us(), kHour_us))
            taken_up += c.flux_shortwave;
        EXPECT_NEAR(taken_up * 3600, sum(t, Field::NetShortwave), 1e-6) << surface;
    }
}

TEST(FillRadiation, MeasuredShortwaveIsBetterThanNet)
{
    ForcingTable t = without_sun(1);
    t[Field::Shortwave].assign(t.rows(), 100);
    t[Field::NetShortwave].assign(t.rows(), 60);
    ReadReport report;
    fill_forcing(t, report);
    EXPECT_FALSE(t.has(Field::NetShortwave));
    EXPECT_TRUE(says(report, "not used: the file has sw_down")) << to_text(report);
}

// Clouds that rain let less light through than others that are closed.
TEST(FillRadiation, RainHasTheLightOfNimbostratus)
{
    ForcingTable t = without_sun(1);
    t[Field::Longwave].clear();
    t[Field::Cloud].assign(t.rows(), 1.0);
    t[Field::Precip].assign(t.rows(), 0.0);
    ForcingTable wet = t;
    wet[Field::Precip].assign(t.rows(), 1.0 / 3600.0);
    ReadReport report;
    fill_forcing(t, report);
    fill_forcing(wet, report);
    ASSERT_GT(t[Field::Shortwave][20], 50.0);
    EXPECT_NEAR(wet[Field::Shortwave][20] / t[Field::Shortwave][20], 0.16 / 0.25, 1e-9);
}

// A year at Bondville: of the clear sky's light 0.18 came in half hours of rain, and what is filled
// is nearer to it than other overcast would be.
TEST(FillRadiation, RainAtBondvilleWasAsDark)
{
    READ_ASSET(text, "champaign_1998_half_hourly.dat");
    double measured = 0.0, clear = 0.0, filled = 0.0;
    Lines lines(text);
    while (const auto line = lines.next()) {
        const auto f = words(*line);
        if (f.size() < 15) continue;
        const auto day = to_number(f[0]), clock = to_number(f[1]), sun = to_number(f[7]),
                   rain = to_number(f[12]);
        if (!day || !clock || !sun || !rain || *sun < -50.0 || !(*rain > 0.0)) continue;
        // The middle of the half hour that ends then, six hours behind UTC.
        const double hour = std::floor(*clock / 100.0) + std::fmod(*clock, 100.0) / 60.0 + 5.75;
        const std::int64_t us = us_from_civil({1998, 1, 1, 0, 0, 0.0}).value() +
                                static_cast<std::int64_t>(((*day - 1.0) * 24.0 + hour) * 3600e6);
        const double sine = sun_direction(us, 40.01, -88.29).up;
        if (clear_sky_w_m2(sine) < 50.0) continue;
        measured += *sun;
        clear += clear_sky_w_m2(sine);
        filled += rainy_sky_w_m2(sine, 1.0);
    }
    ASSERT_GT(clear, 50000.0);
    std::printf("  %.3f of the clear sky's light\n", measured / clear);
    EXPECT_NEAR(measured / clear, 0.18, 0.02);
    EXPECT_LT(std::abs(filled - measured), 0.5 * std::abs(0.25 * clear - measured));
}

// The record winter of the Central Sierra: 1.9 m of water fell, nearly all as snow.
TEST(FillRadiation, CentralSierra)
{
    READ_ASSET(text, "central_sierra_2022_23_snobal_inputs.csv");
    const auto read = read_weather(
        text, {.site = {.latitude_deg = 39.33, .longitude_deg = -120.37, .elevation_m = 2103}});
    PhysicalParams p;
    p.surface = surface_preset("grass");
    const PhysicalTimeline run(read.table, p);
    double peak_kg_m2 = 0;
    std::int64_t last_snow_us = 0;
    for (std::int64_t at = run.begin_us(); at <= run.end_us(); at += 24 * kHour_us) {
        const double swe = diagnostics(run.state_at(at)).swe_kg_m2;
        peak_kg_m2 = std::max(peak_kg_m2, swe);
        if (swe > 1) last_snow_us = at;
    }
    std::printf("  peak %.0f kg/m2\n", peak_kg_m2);
    EXPECT_GT(peak_kg_m2, 1300);
    EXPECT_LT(peak_kg_m2, 1925);
    // Gone in June or July.
    EXPECT_GT(last_snow_us, 1685577600LL * 1000000);
    EXPECT_LT(last_snow_us, 1690848000LL * 1000000);
}

// A fortnight without rows has its days and nights: neither the night of its first hour nor a line of
// noon is taken for it all, whether the file measures the sun or not.
TEST(Gaps, HaveTheirDaysAndNights)
{
    for (const bool measured : {true, false}) {
        std::string text = measured ? "time,air_temp_c,rel_humidity_pct,wind_m_s,sw_down_w_m2\n"
                                    : "time,air_temp_c,rel_humidity_pct,wind_m_s\n";
        for (int h = 0; h < 120; ++h) {
            char row[96];
            const int day = 1 + h / 24 + (h >= 60 ? 14 : 0);  // the gap begins at noon
            std::snprintf(row, sizeof row, "2024-06-%02dT%02d:00Z,15,60,2", day, h % 24);
            text += row;
            if (measured) text += h % 24 > 5 && h % 24 < 18 ? ",500" : ",0";
            text += "\n";
        }
        ReadOptions options;
        options.site.latitude_deg = 45.0;
        options.site.longitude_deg = 0.0;
        const auto r = read_weather(text, options);
        double most = 0.0, light = 0.0;
        int dark = 0, hours = 0;
        const std::int64_t begin = *us_from_iso("2024-06-03T13:00Z"),
                           end = *us_from_iso("2024-06-17T11:00Z");
        for (std::size_t i = 0; i < r.table.rows(); ++i) {
            if (r.table.time_us[i] < begin || r.table.time_us[i] > end) continue;
            const double sw = r.table[Field::Shortwave][i];
            most = std::max(most, sw);
            dark += sw == 0.0;
            light += sw;
            ++hours;
        }
        EXPECT_EQ(hours, 14 * 24 - 1) << measured;
        EXPECT_GE(dark, 14 * 7) << measured;
        EXPECT_GT(most, 500.0) << measured;
        EXPECT_NEAR(light / hours, 240.0, 120.0) << measured;
        EXPECT_NE(to_text(r.report).find("gaps are divided into"), std::string::npos);
    }
    // Centuries are not.
    const auto far = read_weather(
        "time,air_temp_c\n1900-01-01T00:00Z,1\n1900-01-01T01:00Z,1\n2000-01-01T00:00Z,1\n");
    EXPECT_LT(far.table.rows(), 10u);
}

}  // namespace
}  // namespace petrichor::weather
