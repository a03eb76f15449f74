// From SI to 0..1 and back, and the volumes of hollows.
#include "weather/models/physical/mapping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "weather/models/physical/physical.h"
#include "weather/physics/stores.h"

namespace petrichor::weather {
namespace {

TEST(Mapping, ValuesOfTheTable)
{
    const MappingParams m;
    const double rain[][2] = {
        {0.5, 0.10312}, {2.5, 0.31862}, {7.6, 0.54727}, {10, 0.60987}, {50, 1}};
    for (const auto& [p, r] : rain) EXPECT_NEAR(rainfall_of_rate(m, p), r, 5e-6);
    const double film[][2] = {
        {0.05, 0.18127}, {0.1, 0.32968}, {0.25, 0.63212}, {0.5, 0.86466}, {1, 0.98168}};
    for (const auto& [w, v] : film) EXPECT_NEAR(wetness_of_film(m, w), v, 5e-6);
    const double snow[][2] = {{0.01, 0.18127}, {0.05, 0.63212}, {0.1, 0.86466}, {0.2, 0.98168}};
    for (const auto& [d, s] : snow) EXPECT_NEAR(snow_of_depth(m, d), s, 5e-6);
}

TEST(Mapping, MonotoneWithInverses)
{
    const MappingParams m;
    const Hypsometry uniform = uniform_hypsometry(8);
    std::vector<float> bumps(1000);
    for (std::size_t i = 0; i < bumps.size(); ++i)
        bumps[i] = static_cast<float>(std::pow(static_cast<double>(i) / 999, 3));
    const Hypsometry table = make_hypsometry(bumps, 12, 24);
    double last[5] = {-1, -1, -1, -1, -1};
    for (double v = 0; v <= 0.99; v += 0.01) {
        EXPECT_NEAR(rainfall_of_rate(m, rate_of_rainfall_mm_h(m, v)), v, 1e-12);
        EXPECT_NEAR(wetness_of_film(m, film_of_wetness_kg_m2(m, v)), v, 1e-12);
        EXPECT_NEAR(snow_of_depth(m, depth_of_snow_m(m, v)), v, 1e-12);
        EXPECT_NEAR(level_of_store(uniform, store_of_level_kg_m2(uniform, v)), v, 1e-12);
        EXPECT_NEAR(level_of_store(table, store_of_level_kg_m2(table, v)), v, 1e-7);
        const double now[5] = {rate_of_rainfall_mm_h(m, v), film_of_wetness_kg_m2(m, v),
                               depth_of_snow_m(m, v), store_of_level_kg_m2(uniform, v),
                               store_of_level_kg_m2(table, v)};
        for (int i = 0; i < 5; ++i) {
            EXPECT_GT(now[i], last[i]);
            last[i] = now[i];
        }
    }
    EXPECT_EQ(snow_of_depth(m, depth_of_snow_m(m, 1.0)), 1.0);
    EXPECT_EQ(wetness_of_film(m, -1), 0.0);
}

TEST(Mapping, MasksMakeStatesThatShowThem)
{
    const Surface s = surface_preset("cobblestone");
    WeatherMasks wanted;
    wanted.wetness = 0.4;
    wanted.cracks = 0.7;
    wanted.puddles = 0.2;
    wanted.snow = 0.6;
    wanted.water_to_snow = 0.8;
    const auto back = weather_masks({}, s, state_of_masks({}, s, wanted, {}), 3600);
    EXPECT_NEAR(back.wetness, 0.4, 1e-12);
    EXPECT_NEAR(back.cracks, 0.7, 1e-12);
    EXPECT_NEAR(back.puddles, 0.2, 1e-12);
    EXPECT_NEAR(back.snow, 0.6, 1e-12);
    EXPECT_NEAR(back.water_to_snow, 0.8, 1e-12);
}

// Hypsometry of a table: the volume is the integral of the area, so a loss lowers the level by
// itself.
TEST(Stores, AreaIsTheSlopeOfVolume)
{
    std::vector<float> heights(500);
    for (std::size_t i = 0; i < heights.size(); ++i)
        heights[i] = static_cast<float>(0.5 - 0.5 * std::cos(0.0063 * static_cast<double>(i)));
    const Hypsometry h = make_hypsometry(heights, 20, 32);
    for (double z = 0.1; z < 19.9; z += 0.1) {
        const double slope = (stored_kg_m2(h, z + 1e-5) - stored_kg_m2(h, z - 1e-5)) / 2e-5;
        EXPECT_NEAR(slope, wet_area(h, z), 1e-4);
        EXPECT_NEAR(water_level_mm(h, stored_kg_m2(h, z)), z, 1e-9);
    }
    EXPECT_NEAR(wet_area(h, 20), 1.0, 1e-12);
    EXPECT_THROW(make_hypsometry({}, 5), Error);
    EXPECT_THROW(make_hypsometry(heights, -5), Error);
}

}  // namespace
}  // namespace petrichor::weather
