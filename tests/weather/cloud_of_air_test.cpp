// Clouds that nobody saw, from a day of air.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/weather/reading.h"
#include "weather/forcing/forcing.h"
#include "weather/physics/cloud_of_air.h"

namespace petrichor::weather {
namespace {

constexpr std::int64_t kHour_us = 3600LL * 1000000;
const double kNan = std::numeric_limits<double>::quiet_NaN();

// The cloud of a day of this humidity and nothing else.
double cloud_of_humidity(double pct) { return cloud_of_day({.mean_rel_humidity_pct = pct}); }

TEST(CloudOfAir, RisesWithHumidity)
{
    EXPECT_NEAR(cloud_of_humidity(0.0), 0.60, 1e-12);
    EXPECT_EQ(cloud_of_humidity(45.0), cloud_of_humidity(0.0));
    EXPECT_NEAR(cloud_of_humidity(71.0), 0.70 + 0.22 * 0.25 - 0.025 * (12.0 - 0.18 * 11.0 - 8.0),
                1e-12);
    EXPECT_NEAR(cloud_of_humidity(97.0), 0.92 - 0.025 * (12.0 - 0.18 * 37.0 - 8.0), 1e-12);
    double before = cloud_of_humidity(45.0);
    for (double rh = 46.0; rh < 100.0; rh += 1.0) {
        EXPECT_GT(cloud_of_humidity(rh), before) << rh;
        before = cloud_of_humidity(rh);
    }
}

// A day that hardly warmed was overcast; one that is damp while the sun is up has less of it.
TEST(CloudOfAir, FallsWithTheRangeOfTheDay)
{
    const auto cloud = [](double range_k, double damper_pct) {
        return cloud_of_day(
            {.mean_rel_humidity_pct = 71.0, .range_k = range_k, .damper_pct = damper_pct});
    };
    EXPECT_NEAR(cloud(8.0, 0.0), 0.755, 1e-12);
    EXPECT_NEAR(cloud(12.0, 0.0), 0.655, 1e-12);
    EXPECT_NEAR(cloud(8.0, 10.0), 0.801, 1e-12);
    EXPECT_EQ(cloud(0.0, 30.0), 1.0);
    EXPECT_EQ(cloud(60.0, 0.0), 0.0);
    EXPECT_NEAR(cloud(kNan, 0.0), cloud(ordinary_range_k(71.0), 0.0), 1e-12);
    EXPECT_EQ(ordinary_range_k(40.0), 12.0);
    EXPECT_NEAR(ordinary_range_k(100.0), 4.8, 1e-12);
}

// A clear night that is damp and its dry noon have one cloud, that of their mean, where nobody knows
// when the sun is up; where it is known the noon has less.
TEST(CloudOfAir, IsThatOfTheDayAround)
{
    std::vector<std::int64_t> time_us;
    std::vector<double> humidity, air_k, sine;
    for (int hour = 0; hour <= 72; ++hour) {
        time_us.push_back(hour * kHour_us);
        humidity.push_back(hour == 36 ? kNan : hour < 36 ? 60.0 : 90.0);
        air_k.push_back(hour % 24 == 15 ? 284.0 : hour % 24 == 5 ? 275.0 : 280.0);
        sine.push_back(hour % 24 > 6 && hour % 24 < 18 ? 0.5 : -0.5);
    }
    const auto day = [](double pct) {
        return cloud_of_day({.mean_rel_humidity_pct = pct, .range_k = 9.0});
    };
    const std::vector<double> cloud = cloud_of_air({time_us, humidity, air_k, {}});
    ASSERT_EQ(cloud.size(), time_us.size());
    EXPECT_NEAR(cloud[12], day(60.0), 1e-12);
    EXPECT_NEAR(cloud[60], day(90.0), 1e-12);
    EXPECT_NEAR(cloud[36], day(75.0), 1e-12);  // twelve hours of each, one unknown
    EXPECT_NEAR(cloud[30], day((18 * 60.0 + 6 * 90.0) / 24.0), 1e-12);
    // An end of the series has half a day beside it, of which no range is believed; six hours on,
    // half of it is.
    EXPECT_NEAR(cloud[0], cloud_of_humidity(60.0), 1e-12);
    EXPECT_NEAR(cloud[6], 0.5 * (cloud_of_humidity(60.0) + day(60.0)), 1e-12);
    // With the sun: the hours around 39 are 90 %, of its day 13 of 24 hours are.
    const std::vector<double> sunny = cloud_of_air({time_us, humidity, air_k, sine});
    const double mean = (9 * 60.0 + 15 * 90.0) / 24.0;
    EXPECT_NEAR(sunny[39], day(mean) + 0.0046 * (90.0 - mean), 1e-12);
    EXPECT_EQ(sunny[30], cloud[30]);
}

// Temperatures that are too far apart, as those of days, have no range, whatever they are.
TEST(CloudOfAir, KnowsNoRangeFromRowsFarApart)
{
    for (const int step_h : {1, 3, 4, 12, 24}) {
        std::vector<std::int64_t> time_us;
        std::vector<double> humidity, air_k;
        for (int hour = 0; hour <= 96; hour += step_h) {
            time_us.push_back(hour * kHour_us);
            humidity.push_back(60.0);
            air_k.push_back(hour % 24 == 12 ? 290.0 : 280.0);
        }
        const auto cloud = cloud_of_air({time_us, humidity, air_k, {}});
        const DayOfAir unknown{.mean_rel_humidity_pct = 60.0};
        const DayOfAir known{.mean_rel_humidity_pct = 60.0, .range_k = 10.0};
        EXPECT_NEAR(cloud[cloud.size() / 2], cloud_of_day(step_h <= 3 ? known : unknown), 1e-12)
            << step_h;
    }
}

TEST(CloudOfAir, SaysNothingWithoutHumidityNearby)
{
    const std::vector<std::int64_t> time_us{0, 13 * kHour_us, 26 * kHour_us};
    const std::vector<double> humidity{90.0, kNan, 50.0}, air_k{280.0, kNan, kNan};
    const std::vector<double> cloud = cloud_of_air({time_us, humidity, air_k, {}});
    EXPECT_NEAR(cloud[0], cloud_of_humidity(90.0), 1e-12);
    EXPECT_TRUE(std::isnan(cloud[1]));
    EXPECT_NEAR(cloud[2], cloud_of_humidity(50.0), 1e-12);
}

// Files without clouds, sun and sky: damp days are filled with less sun and a warmer sky than dry
// ones of the same temperature.
TEST(CloudOfAir, FillsWhatAFileDoesNotHave)
{
    const auto filled = [](double humidity) {
        ForcingTable t;
        t.site = {.latitude_deg = 46, .longitude_deg = 11, .elevation_m = 200};
        for (int hour = 0; hour < 48; ++hour) {
            t.time_us.push_back(1400000000LL / 86400 * 86400 * 1000000 + hour * kHour_us);
            t[Field::AirTemp].push_back(283.15);
            t[Field::RelHumidity].push_back(humidity);
        }
        ReadReport report;
        fill_forcing(t, report);
        EXPECT_NE(to_text(report).find("from the air of a day"), std::string::npos)
            << to_text(report);
        return t;
    };
    const ForcingTable dry = filled(40.0), damp = filled(99.0);
    EXPECT_NEAR(dry[Field::Cloud][24], 0.9, 1e-12);  // as warm by night as by day
    EXPECT_NEAR(dry[Field::Cloud][0], 0.6, 0.03);    // where no range is known
    EXPECT_NEAR(damp[Field::Cloud][24], 1.0, 1e-12);
    EXPECT_LT(damp[Field::Shortwave][12], 0.6 * dry[Field::Shortwave][12]);
    EXPECT_GT(damp[Field::Longwave][0], dry[Field::Longwave][0] + 30.0);
}

}  // namespace
}  // namespace petrichor::weather
