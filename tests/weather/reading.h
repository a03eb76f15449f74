// For the tests of readers: real files, and what every table must be.
#ifndef PETRICHOR_TESTS_WEATHER_READING_H
#define PETRICHOR_TESTS_WEATHER_READING_H

#include <cmath>
#include <string>

#include "tests/support/assets.h"
#include "weather/readers/read_weather.h"

namespace petrichor::weather::testing_reading {

/// A file of the shared weather; "" when it is not there.
inline std::string asset(const std::string& name)
{
    return testing_assets::asset_text("weather/" + name);
}

/// What fell over the table, kg/m2.
inline double sum_mm(const ForcingTable& t, Field f)
{
    double sum = 0;
    for (std::size_t i = 0; i + 1 < t.rows(); ++i)
        sum += t[f][i] * static_cast<double>(t.time_us[i + 1] - t.time_us[i]) * 1e-6;
    return sum;
}

/// All that a model wants is there, and finite.
inline void expect_complete(const ForcingTable& t)
{
    for (const Field f : {Field::AirTemp, Field::RelHumidity, Field::Wind, Field::Pressure,
                          Field::Shortwave, Field::Longwave, Field::Cloud, Field::Precip}) {
        ASSERT_EQ(t[f].size(), t.rows()) << field_info(f).name;
        for (const double v : t[f]) ASSERT_TRUE(std::isfinite(v)) << field_info(f).name;
    }
}

}  // namespace petrichor::weather::testing_reading

/// Declares `variable`, the text of a file of the shared weather, or skips the test.
#define READ_ASSET(variable, name)                                                            \
    const std::string variable = petrichor::weather::testing_reading::asset(name);            \
    if (variable.empty())                                                                     \
    GTEST_SKIP() << "PETRICHOR_ASSETS does not name a folder with weather/" << name

#endif
