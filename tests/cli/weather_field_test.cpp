// A grid of weather on a landscape: each part of the terrain under the weather of its middle.
#include <gtest/gtest.h>

#include <netcdf.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>

#include "base/error.h"
#include "cli/simulate/grid.h"
#include "weather/physics/constants.h"

namespace petrichor::cli {
namespace {

namespace fs = std::filesystem;

// ERA5 in little: warm and wet in the west, cold in the east; its ground rises to the east.
class Era5 {
public:
    Era5(bool with_height, double east_k = -12.0)
        : path_(fs::temp_directory_path() /
                ("petrichor-field-" + std::to_string(::getpid()) + ".nc"))
    {
        int id = -1, time = -1, lat = -1, lon = -1;
        nc_create(path_.c_str(), NC_CLOBBER, &id);
        nc_def_dim(id, "valid_time", kHours, &time);
        nc_def_dim(id, "latitude", 2, &lat);
        nc_def_dim(id, "longitude", 3, &lon);
        const auto put = [&](const char* name, const char* unit, const std::vector<int>& dims,
                             const std::vector<double>& values) {
            int v = -1;
            nc_redef(id);
            nc_def_var(id, name, NC_DOUBLE, static_cast<int>(dims.size()), dims.data(), &v);
            nc_put_att_text(id, v, "units", std::strlen(unit), unit);
            nc_enddef(id);
            nc_put_var_double(id, v, values.data());
        };
        nc_enddef(id);
        std::vector<double> times;
        for (std::size_t i = 0; i < kHours; ++i)
            times.push_back(1706745600.0 + 3600.0 * static_cast<double>(i));
        put("valid_time", "seconds since 1970-01-01", {time}, times);
        put("latitude", "degrees_north", {lat}, {46.5, 45.5});
        put("longitude", "degrees_east", {lon}, {7.0, 8.0, 9.0});
        const auto field = [&](const char* name, const char* unit,
                               const std::function<double(std::size_t, double)>& f) {
            std::vector<double> values;
            for (std::size_t t = 0; t < kHours; ++t)
                for (int y = 0; y < 2; ++y)
                    for (int x = 0; x < 3; ++x) values.push_back(f(t, x - 1.0));
            put(name, unit, {time, lat, lon}, values);
        };
        field("t2m", "K", [&](std::size_t, double x) { return 273.0 + east_k * x; });
        field("d2m", "K", [&](std::size_t, double x) { return 270.0 + east_k * x; });
        field("u10", "m s**-1", [](std::size_t, double) { return 3.0; });
        field("v10", "m s**-1", [](std::size_t, double) { return 0.0; });
        field("ssrd", "J m**-2", [](std::size_t, double) { return 3.6e5; });
        field("strd", "J m**-2", [](std::size_t, double) { return 3600.0 * 270; });
        field("tp", "m", [&](std::size_t t, double x) {
            return t < 40 ? 0.001 * (1.0 - 0.5 * x * (east_k < 0.0 ? 1.0 : 0.0)) : 0.0;
        });
        if (with_height)
            field("z", "m**2 s**-2",
                  [](std::size_t, double x) { return 9.80665 * (1000 + 400 * x); });
        nc_close(id);
    }
    ~Era5() { fs::remove(path_); }
    std::vector<std::string> words() const { return {path_.string()}; }

private:
    static constexpr std::size_t kHours = 72;
    fs::path path_;
};

// Flat ground, 100 km from west to east.
Terrain plain()
{
    Terrain t;
    t.width = t.height = 12;
    t.spacing_m = 100000.0 / 12;
    t.heights_m.assign(144, 1000.0f);
    t.inside.assign(144, true);
    t.surface.assign(144, 0);
    t.surfaces = {"grass"};
    return t;
}

SiteOptions middle()
{
    SiteOptions site;
    site.latitude_deg = 46.0;
    site.longitude_deg = 8.0;
    return site;
}

TEST(WeatherField, EachPartHasTheWeatherOfItsMiddle)
{
    const Era5 era5(true);
    const auto field = read_weather_field(era5.words(), middle(), plain(), 3, false);
    ASSERT_EQ(field.tables.size(), 9u);
    // A third of 100 km at 46 N is 0.4315 degrees.
    const double step_deg = 100000.0 / 3 / (111195.0 * std::cos(46.0 * weather::kPi / 180.0));
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& t = field.tables[row * 3 + i];
            EXPECT_NEAR(t[weather::Field::AirTemp][0],
                        273.0 + 12 * step_deg * (1.0 - static_cast<double>(i)), 0.01);
            EXPECT_NEAR(t.site.elevation_m, 1000 + 400 * step_deg * (static_cast<double>(i) - 1.0),
                        1);
        }
        EXPECT_NEAR(field.tables[3 * row].site.latitude_deg,
                    46.0 + 0.29976 * (1.0 - static_cast<double>(row)), 1e-3);
    }
}

TEST(WeatherField, TheLandscapeRunsUnderIt)
{
    const Era5 era5(true);
    GridRun run;
    run.model.site = middle();
    run.model.site.surface = "grass";
    run.model.every_s = 86400.0;
    run.model.threads = 2;
    const Terrain terrain = plain();
    run.field = read_weather_field(era5.words(), middle(), terrain, 4, false);
    GridMap last;
    weather::ReadResult read;
    read.table = run.field.tables[5];
    run.map_times_us = {read.table.time_us.back()};
    run.on_map = [&](const GridMap& map) { last = map; };
    const auto table = run_grid(read, "era5", terrain, run);
    ASSERT_EQ(last.states.size(), 144u);
    const auto swe = [&](std::size_t i) { return weather::diagnostics(last.states[i]).swe_kg_m2; };
    // The west has rain, the east snow, both carried to 1000 m.
    EXPECT_LT(swe(0), 1.0);
    EXPECT_GT(swe(11), 15.0);
    EXPECT_GT(last.states[0].total_precip, last.states[11].total_precip);
    EXPECT_EQ(weather::state_hash(last.states[0]), weather::state_hash(last.states[12]));
    run.model.threads = 1;
    EXPECT_EQ(run_grid(read, "era5", terrain, run).state_hash, table.state_hash);
    run.on_checkpoint = [](const std::string&) {};
    EXPECT_THROW(run_grid(read, "era5", terrain, run), Error);
}

TEST(WeatherField, WhatCannotBeAFieldIsRefused)
{
    EXPECT_THROW(read_weather_field(Era5(false).words(), middle(), plain(), 2, false), Error);
    EXPECT_THROW(read_weather_field(Era5(true, 0.0).words(), middle(), plain(), 2, false), Error);
    EXPECT_THROW(read_weather_field(Era5(true).words(), {}, plain(), 2, false), Error);
    EXPECT_THROW(read_weather_field(Era5(true).words(), middle(), plain(), 33, false), Error);
    SiteOptions away = middle();
    away.latitude_deg = 10.0;
    EXPECT_THROW(read_weather_field(Era5(true).words(), away, plain(), 2, false), Error);
}

}  // namespace
}  // namespace petrichor::cli
