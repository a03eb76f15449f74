#include "film/jobs/weather_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "film/weather/packed.h"
#include "film/weather/weather_input.h"
#include "tests/support/program.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;
using testing_program::Workplace;
using testing_program::write_file;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Twenty January days: a mild dry week, a day of rain, then frost and a day of snow.
std::string weather_csv()
{
    std::string text = "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm,cloud_fraction\n";
    for (int hour = 0; hour < 20 * 24; ++hour) {
        const int day = hour / 24;
        const double air = (day < 10 ? 6.0 : -5.0) + 2.0 * std::sin(hour * 0.26);
        const double falls = day == 8 || day == 15 ? 1.5 : 0.0;
        char row[128];
        std::snprintf(row, sizeof row, "2020-01-%02dT%02d:00,%.2f,%.1f,2.0,%.2f,%.2f\n", day + 1,
                      hour % 24, air, falls > 0.0 ? 95.0 : 75.0, falls, falls > 0.0 ? 1.0 : 0.2);
        text += row;
    }
    return text;
}

class WeatherOfAFile : public testing::Test {
protected:
    WeatherOfAFile()
        : place_(std::string("weather_source") +
                 testing::UnitTest::GetInstance()->current_test_info()->name())
    {
        write_file(place_ / "january.csv", weather_csv());
        options_.file = "january.csv";
        options_.site.latitude_deg = 50.0;
        options_.site.longitude_deg = 0.0;
        options_.site.elevation_m = 100.0;
    }
    WeatherSource source(double end_s = 0.0) const
    {
        return weather_source(options_, place_.path(), "s.toml", end_s);
    }
    Workplace place_;
    ScenarioWeather options_;
};

TEST_F(WeatherOfAFile, RunsUnderThePhysicalModelWithItsOwnSunAndSi)
{
    options_.start = "01-08";
    options_.end = "01-18";
    const WeatherSource january = source();
    EXPECT_DOUBLE_EQ(january.duration_s, 240.0) << "an hour is a second";
    // The evening after the rain, and the evening after the snow.
    const weather::Moment wet = january.at(24.0 + 20.0), white = january.at(8.0 * 24.0 + 20.0);
    EXPECT_GT(wet.values.film_mm, 0.3f);
    EXPECT_GT(wet.values.rain_kg_m2_s, 0.0f);
    EXPECT_EQ(wet.values.snow_depth_m, 0.0f);
    EXPECT_GT(wet.values.flood_puddles, 0.3f);
    EXPECT_GT(white.values.snow_depth_m, 0.05f);
    EXPECT_GT(white.values.snow_amount, 0.6f);
    EXPECT_FLOAT_EQ(white.values.snow_fraction, 1.0f);
    EXPECT_GT(white.values.snow_albedo, 0.6f);
    EXPECT_FLOAT_EQ(white.values.cloud_fraction, 1.0f);
    EXPECT_GT(wet.values.longwave_down_w_m2, 200.0f);
    EXPECT_NEAR(wet.values.pressure_pa, 100129.0f, 50.0f);
    for (const float radiation :
         {wet.values.direct_normal_w_m2, wet.values.diffuse_horizontal_w_m2})
        EXPECT_EQ(radiation, 0.0f) << "after sunset, and known";
    // Noon and midnight of 8 January: declination -22.3 degrees.
    ASSERT_TRUE(january.at(12.0).sun.has_value());
    EXPECT_NEAR(january.at(12.0).sun->elevation_rad / kDegree, 17.7, 0.3);
    EXPECT_NEAR(january.at(0.0).sun->elevation_rad / kDegree, -62.3, 0.3);
    EXPECT_NEAR(january.at(12.0).sun->azimuth_rad / kDegree, 180.0, 3.0);
    EXPECT_EQ(*january.at(0.0).utc_us, 1578441600000000);
    EXPECT_THAT(january.notes, testing::Contains(HasSubstr("spin-up 7 days")));
    EXPECT_THAT(january.notes, testing::Contains(HasSubstr("no wind direction")));
}

// As `simulate` has it: times without a zone are those of the clock at the place.
TEST_F(WeatherOfAFile, DatesAreByTheClockOfItsPlace)
{
    options_.start = "01-08";
    const std::int64_t utc = *source().at(0.0).utc_us;
    write_file(place_ / "january.csv", "# utc_offset_h: -7\n" + weather_csv());
    const WeatherSource west = source();
    const std::int64_t west_us = *west.at(0.0).utc_us;
    EXPECT_EQ(west_us - utc, std::int64_t{7} * 3600 * 1000000) << "midnight there";
    EXPECT_THAT(west.notes, testing::Contains(HasSubstr("0 s is 2020-01-08T00:00:00-07:00")));
    options_.start = "2020-01-08T07:00Z";
    EXPECT_EQ(*source().at(0.0).utc_us, west_us) << "a zone of one's own wins";
}

TEST_F(WeatherOfAFile, AnyMomentIsTheSameInAnyOrder)
{
    const WeatherSource one = source(), other = source();
    for (const double time_s : {200.5, 13.25, 470.0, 13.25}) other.at(time_s);
    for (const double time_s : {13.25, 200.5, 340.75}) {
        const auto a = one.at(time_s).values, b = other.at(time_s).values;
        EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << time_s;
    }
}

TEST_F(WeatherOfAFile, TheArtistModelStandsAtTheSameClock)
{
    options_.model = WeatherModel::Artist;
    options_.start = "01-09";
    options_.hours_per_second = 2.0;
    const WeatherSource artist = source();
    EXPECT_EQ(*artist.at(6.0).utc_us, 1578571200000000) << "noon, 2020-01-09";
    EXPECT_GT(artist.at(6.0).values.rain, 0.2f);
    EXPECT_GT(artist.at(6.0).values.longwave_down_w_m2, 200.0f);
    EXPECT_LT(artist.at(6.0).values.surface_temperature_k, 0.0f) << "nobody knows";
}

TEST_F(WeatherOfAFile, ItsGroundRemembersTheSpinUp)
{
    options_.start = "01-17";
    const float with_snow = source().at(0.0).values.snow_depth_m;
    options_.spin_up_days = 0.0;
    EXPECT_GT(with_snow, 0.05f);
    EXPECT_EQ(source().at(0.0).values.snow_depth_m, 0.0f) << "begun after the snowfall";
}

TEST_F(WeatherOfAFile, OneRowIsAnHour)
{
    write_file(place_ / "january.csv", "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm,cloud_fraction\n"
                                       "2020-01-09T12:00,5.00,95.0,2.0,3.00,1.00\n");
    const WeatherSource hour = source();
    EXPECT_DOUBLE_EQ(hour.duration_s, 1.0);
    for (const double at : {0.0, 0.5, 1.0}) {
        const weather::Moment moment = hour.at(at);
        EXPECT_NEAR(moment.values.air_temperature_k, 278.15f, 0.01f) << at;
        EXPECT_TRUE(std::isfinite(moment.values.surface_temperature_k));
    }
}

TEST_F(WeatherOfAFile, WhatCannotBeIsRefused)
{
    options_.start = "02-01";
    EXPECT_THROW(source(), Error);
    options_.start = "01-05";
    options_.end = "01-04";
    EXPECT_THROW(source(), Error);
    options_.end.clear();
    options_.site.surface = "asfalt";
    EXPECT_THROW(source(), Error);
    ScenarioWeather keys;
    keys.preset = "storm";
    keys.model = WeatherModel::Physical;
    EXPECT_THROW(weather_source(keys, {}, "s.toml", 0.0), Error);
}

ScenarioWeather keyed(const std::string& text)
{
    return parse_scenario("[weather]\n" + text, "s.toml").weather;
}

TEST(WeatherOfKeys, LoopsBeginAgainAndTheStateGoesOn)
{
    const std::string keys =
        "keys = [{ time_s = 0, temperature_c = 10, rainfall = 1 }, { time_s = 4, rainfall = 0 },"
        "{ time_s = 10, temperature_c = 20 }]\ninterpolation = \"hold\"\n";
    const WeatherSource once = weather_source(keyed(keys), {}, "s.toml", 30.0);
    const WeatherSource loop = weather_source(keyed(keys + "loop = true\n"), {}, "s.toml", 30.0);
    EXPECT_EQ(loop.at(5.0).values.rain, once.at(5.0).values.rain);
    EXPECT_EQ(once.at(22.0).values.rain, 0.0f);
    EXPECT_GT(loop.at(22.0).values.rain, 0.9f);
    EXPECT_GT(loop.at(22.0).values.flood_cracks, loop.at(2.0).values.flood_cracks) << "goes on";
    EXPECT_NEAR(loop.at(15.0).values.air_temperature_k, 283.15f, 1e-3f);
}

// A grid of ERA5 as classic NetCDF: hours, a northern and a southern row, a column.
std::string grid_file(std::size_t hours)
{
    const auto number = [](std::uint64_t value, int bytes) {
        std::string out;
        for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i) & 255u);
        return out;
    };
    const auto word = [&](const std::string& text) {
        return number(text.size(), 4) + text + std::string((4 - text.size() % 4) % 4, '\0');
    };
    struct Variable {
        std::string name, units;
        std::vector<std::uint64_t> dims;
        std::vector<double> values;
    };
    std::vector<Variable> all{{"valid_time", "seconds since 1970-01-01", {0}, {}},
                              {"latitude", "degrees_north", {1}, {46.0, 45.0}},
                              {"longitude", "degrees_east", {2}, {6.0}},
                              {"t2m", "K", {0, 1, 2}, {}},
                              {"d2m", "K", {0, 1, 2}, {}},
                              {"tcc", "(0 - 1)", {0, 1, 2}, {}}};
    for (std::size_t h = 0; h < hours; ++h) {
        all[0].values.push_back(1718409600.0 + 3600.0 * static_cast<double>(h));
        for (const double north : {0.0, 1.0}) {
            all[3].values.push_back(280.0 + 8.0 * north);
            all[4].values.push_back(278.0);
            all[5].values.push_back(0.5);
        }
    }
    std::string text = "CDF\x01" + number(0, 4) + number(10, 4) + number(3, 4);
    for (const auto& [name, size] : {std::pair<std::string, std::size_t>{"valid_time", hours},
                                     {"latitude", 2},
                                     {"longitude", 1}})
        text += word(name) + number(size, 4);
    text += number(0, 8) + number(11, 4) + number(all.size(), 4);
    std::size_t head = text.size();
    for (const Variable& v : all)
        head += word(v.name).size() + 4 + 4 * v.dims.size() + 8 + word("units").size() + 4 +
                word(v.units).size() + 12;
    std::string data;
    for (const Variable& v : all) {
        text += word(v.name) + number(v.dims.size(), 4);
        for (const std::uint64_t dim : v.dims) text += number(dim, 4);
        text += number(12, 4) + number(1, 4) + word("units") + number(2, 4) + word(v.units);
        text += number(6, 4) + number(8 * v.values.size(), 4) + number(head + data.size(), 4);
        for (const double value : v.values) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, &value, 8);
            data += number(bits, 8);
        }
    }
    return text + data;
}

TEST_F(WeatherOfAFile, AGridIsReadAtThePlaceThatIsAskedFor)
{
    if (packed_kinds().find("NetCDF") == std::string::npos) GTEST_SKIP() << "built without NetCDF";
    write_file(place_ / "era5.nc", grid_file(30));
    options_.file = "era5.nc";
    options_.site.longitude_deg = 6.0;
    options_.site.latitude_deg = 45.75;
    EXPECT_NEAR(source().at(3.0).values.air_temperature_k, 282.0, 1e-3);
    options_.site.latitude_deg = 45.0;
    EXPECT_NEAR(source().at(3.0).values.air_temperature_k, 288.0, 1e-3);
    options_.site.latitude_deg = 50.0;
    EXPECT_THROW(source(), Error) << "outside of it";
}

TEST(WeatherOfKeys, MayBeInSi)
{
    const auto at = [](const std::string& key) {
        return weather_source(keyed("keys = [{ time_s = 0, temperature_c = 10, " + key + " }]\n"),
                              {}, "s.toml", 0.0)
            .at(0.0)
            .values;
    };
    const auto raining = at("rain_mm_h = 10");  // a hundredth of it frozen, as the model begins
    EXPECT_NEAR((raining.rain_kg_m2_s + raining.snowfall_kg_m2_s) * 3600.0f, 10.0f, 1e-3f);
    const auto set =
        at("rainfall = 0, script_controlled = 0, water_to_snow = 1, snow_depth_m = 0.12");
    EXPECT_NEAR(set.snow_depth_m, 0.12f, 1e-4f);
    const auto wet = at(
        "rainfall = 0, script_controlled = 0, water_to_snow = 0, film_mm = 0.4, puddle_depth_m = "
        "0.006");
    EXPECT_NEAR(wet.film_mm, 0.4f, 1e-4f);
    EXPECT_NEAR(wet.puddle_depth_m, 0.006f, 1e-5f);
    EXPECT_THROW(at("rainfall = 0.5, rain_mm_h = 3"), Error) << "said twice";
}

}  // namespace
}  // namespace petrichor::film
