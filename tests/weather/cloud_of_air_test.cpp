// Clouds that nobody saw, from a day's humidity.
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

TEST(CloudOfAir, RisesFromHalfACoverToAFullOne)
{
    EXPECT_EQ(cloud_of_humidity(0.0), 0.5);
    EXPECT_EQ(cloud_of_humidity(45.0), 0.5);
    EXPECT_NEAR(cloud_of_humidity(71.0), 0.625, 1e-12);
    EXPECT_EQ(cloud_of_humidity(97.0), 1.0);
    EXPECT_EQ(cloud_of_humidity(105.0), 1.0);
    double before = 0.5;
    for (double rh = 46.0; rh < 97.0; rh += 1.0) {
        EXPECT_GT(cloud_of_humidity(rh), before) << rh;
        before = cloud_of_humidity(rh);
    }
}

// A clear night that is damp and its dry noon have one cloud: that of their mean.
TEST(CloudOfAir, IsThatOfTheDayAround)
{
    std::vector<std::int64_t> time_us;
    std::vector<double> humidity;
    for (int hour = 0; hour <= 72; ++hour) {
        time_us.push_back(hour * kHour_us);
        humidity.push_back(hour == 36 ? kNan : hour < 36 ? 60.0 : 90.0);
    }
    const std::vector<double> cloud = cloud_of_air(time_us, humidity);
    ASSERT_EQ(cloud.size(), time_us.size());
    EXPECT_NEAR(cloud[12], cloud_of_humidity(60.0), 1e-12);
    EXPECT_NEAR(cloud[60], cloud_of_humidity(90.0), 1e-12);
    EXPECT_NEAR(cloud[36], cloud_of_humidity(75.0), 1e-12);  // twelve hours of each, one unknown
    EXPECT_NEAR(cloud[30], cloud_of_humidity((18 * 60.0 + 6 * 90.0) / 24.0), 1e-12);
    // An end of the series has half a day beside it.
    EXPECT_NEAR(cloud[0], cloud_of_humidity(60.0), 1e-12);
}

TEST(CloudOfAir, SaysNothingWithoutHumidityNearby)
{
    const std::vector<std::int64_t> time_us{0, 13 * kHour_us, 26 * kHour_us};
    const std::vector<double> cloud = cloud_of_air(time_us, std::vector<double>{90.0, kNan, 50.0});
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
        EXPECT_NE(to_text(report).find("from the humidity of a day"), std::string::npos)
            << to_text(report);
        return t;
    };
    const ForcingTable dry = filled(40.0), damp = filled(99.0);
    EXPECT_NEAR(dry[Field::Cloud][12], 0.5, 1e-12);
    EXPECT_NEAR(damp[Field::Cloud][12], 1.0, 1e-12);
    EXPECT_LT(damp[Field::Shortwave][12], 0.3 * dry[Field::Shortwave][12]);
    EXPECT_GT(damp[Field::Longwave][0], dry[Field::Longwave][0] + 30.0);
}

}  // namespace
}  // namespace petrichor::weather
