#include "film/scenario/weather_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace petrichor::film {
namespace {

using testing::HasSubstr;

WeatherScript script_of(const std::string& keys, const std::string& interpolation = "smooth")
{
    return read_weather_script(
        "[weather]\ninterpolation = \"" + interpolation + "\"\nkeys = [" + keys + "]\n", "w.toml");
}

std::string message_of(const std::string& keys, const std::string& interpolation = "smooth")
{
    try {
        script_of(keys, interpolation);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(WeatherScriptKeys, MayBringTheirTangents)
{
    const WeatherScript script = script_of(
        "{ time_s = 0, temperature_c = [10, 4], rainfall = 0 }, "
        "{ time_s = 2, temperature_c = [10, -4, 0], rainfall = 1 }");
    EXPECT_NEAR(weather::value_at(script.timeline.temperature_c, 1e6), 12.0, 1e-12);
    EXPECT_NEAR(weather::value_at(script.timeline.rainfall, 1e6), 0.5, 1e-12);
    // Without tangents the same keys are flat.
    const WeatherScript flat = script_of(
        "{ time_s = 0, temperature_c = 10, rainfall = 0 }, "
        "{ time_s = 2, temperature_c = 10, rainfall = 1 }");
    EXPECT_NEAR(weather::value_at(flat.timeline.temperature_c, 1e6), 10.0, 1e-12);
}

TEST(WeatherScriptKeys, TangentsThatLeaveTheRangeAreRefused)
{
    const std::string steep =
        "{ time_s = 0, temperature_c = 1, rainfall = [0.5, 4] }, { time_s = 2, rainfall = 0.5 }";
    EXPECT_THAT(message_of(steep), HasSubstr("rainfall reaches"));
    EXPECT_THAT(message_of(steep, "linear"), HasSubstr("smooth"));
    EXPECT_THAT(message_of("{ time_s = 0, temperature_c = [1, 2, 3, 4], rainfall = 0 }"),
                HasSubstr("[value, slope_in, slope_out]"));
    EXPECT_THAT(message_of("{ time_s = 0, temperature_c = 1, rain_mm_h = [1, 2] }"),
                HasSubstr("takes no slopes"));
}

}  // namespace
}  // namespace petrichor::film
