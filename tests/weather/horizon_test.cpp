// Horizons: sky view, the sun behind a hill, and what both do to a road.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "weather/models/physical/physical_grid.h"
#include "weather/physics/constants.h"
#include "weather/readers/horizon_text.h"

namespace petrichor::weather {
namespace {

constexpr std::int64_t kHourUs = 3600000000LL;
constexpr double kDegree = kPi / 180.0;

TEST(Horizon, SkyViewOfAnEvenOneIsTheSquareOfItsCosine)
{
    EXPECT_EQ(horizon_sky_view({}), 1.0);
    for (const double degrees : {0.0, 10.0, 30.0, 60.0}) {
        const Horizon even(360, degrees * kDegree);
        EXPECT_NEAR(horizon_sky_view(even), std::pow(std::cos(degrees * kDegree), 2), 1e-12);
    }
}

TEST(Horizon, IsLinearBetweenItsAzimuthsAllTheWayRound)
{
    const Horizon h{0.0, 0.2, 0.4, 0.2};  // north, east, south, west
    EXPECT_NEAR(horizon_elevation(h, 45 * kDegree), 0.1, 1e-12);
    EXPECT_NEAR(horizon_elevation(h, 315 * kDegree), 0.1, 1e-12);
    EXPECT_NEAR(horizon_elevation(h, -45 * kDegree), 0.1, 1e-12);
    EXPECT_NEAR(horizon_elevation(h, 180 * kDegree), 0.4, 1e-12);
}

// 21 June at 45 N: the sun rises in the north-east. A wall in the east takes the morning.
TEST(Horizon, AWallInTheEastTakesTheMorning)
{
    Horizon east(360, 0.0);
    for (std::size_t i = 20; i < 160; ++i) east[i] = 40 * kDegree;
    const std::int64_t noon = 1719057600000000LL;  // 2024-06-22 12:00 UTC
    EXPECT_EQ(beam_share(east, noon - 6 * kHourUs, kHourUs, 45, 0), 0.0);
    EXPECT_EQ(beam_share(east, noon + kHourUs, kHourUs, 45, 0), 1.0);
    EXPECT_EQ(beam_share(east, noon - 14 * kHourUs, kHourUs, 45, 0), 1.0);  // night
    // The sun at 40 degrees comes over it within an hour: parts of the hour count.
    double least = 1, most = 0;
    for (int h = 7; h < 10; ++h) {
        const double share = beam_share(east, noon - 12 * kHourUs + h * kHourUs, kHourUs, 45, 0);
        least = std::min(least, share);
        most = std::max(most, share);
    }
    EXPECT_EQ(least, 0.0);
    EXPECT_EQ(most, 1.0);
}

ForcingTable clear_day(int hours)
{
    ForcingTable t;
    t.site.latitude_deg = 46;
    t.site.longitude_deg = 0;
    t.site.elevation_m = 200;
    for (int i = 0; i <= hours; ++i) {
        t.time_us.push_back(1709251200000000LL + i * kHourUs);  // 2024-03-01
        t[Field::AirTemp].push_back(275.15);
        t[Field::RelHumidity].push_back(60);
        t[Field::Wind].push_back(2);
        t[Field::Cloud].push_back(0);
        t[Field::Precip].push_back(0);
    }
    ReadReport report;
    fill_forcing(t, report);
    return t;
}

TEST(Horizon, ShadesARoadByDayAndSheltersItByNight)
{
    const ForcingTable t = clear_day(48);
    PhysicalParams open, shaded;
    open.surface = shaded.surface = surface_preset("road");
    shaded.horizon.assign(360, 0.0);
    for (std::size_t i = 90; i < 270; ++i) shaded.horizon[i] = 45 * kDegree;
    const PhysicalTimeline in_sun(t, open), in_shade(t, shaded);
    const std::int64_t noon = t.time_us[36], night = t.time_us[29];
    EXPECT_GT(in_sun.state_at(noon).flux_shortwave, 3 * in_shade.state_at(noon).flux_shortwave);
    EXPECT_GT(in_sun.state_at(noon).surface_temp_c, in_shade.state_at(noon).surface_temp_c + 5);
    EXPECT_GT(in_shade.state_at(night).flux_longwave, in_sun.state_at(night).flux_longwave + 10);
    // An open horizon is none, to the bit; a grid has it as a cell has.
    PhysicalParams level = open;
    level.horizon.assign(360, 0.0);
    EXPECT_NEAR(PhysicalTimeline(t, level).state_at(noon).surface_temp_c,
                in_sun.state_at(noon).surface_temp_c, 1e-9);
    const GridCell cell{.elevation_m = 200};
    PhysicalGrid grid(t, {.model = shaded, .surfaces = {shaded.surface}}, {&cell, 1});
    grid.advance(36);
    EXPECT_EQ(state_hash(grid.state(0)), state_hash(in_shade.state_at(noon)));
}

TEST(Horizon, NeedsAPlace)
{
    ForcingTable t = clear_day(4);
    t.site.longitude_deg = kMissing;
    PhysicalParams p;
    p.horizon = {0.1, 0.2};
    EXPECT_THROW(PhysicalTimeline(t, p), Error);
    p.horizon = {-0.1};
    EXPECT_THROW(check_params(p), Error);
}

TEST(Horizon, TextIsReadInAnyOrderAndBadLinesAreNamed)
{
    const Horizon h =
        read_horizon("azimuth elevation\n180, 20  # a hill\n0 0\n-90;10\n90\t10\n360 0\n", "h.txt");
    ASSERT_EQ(h.size(), 360u);
    EXPECT_NEAR(h[180] / kDegree, 20, 1e-9);
    EXPECT_NEAR(h[135] / kDegree, 15, 1e-9);
    EXPECT_NEAR(h[270] / kDegree, 10, 1e-9);
    EXPECT_NEAR(h[315] / kDegree, 5, 1e-9);
    const Horizon two = read_horizon("100 10\n200 20\n", "h.txt");
    EXPECT_NEAR(two[150] / kDegree, 15, 1e-9);
    EXPECT_NEAR(two[20] / kDegree, 20 - 10 * 180.0 / 260.0, 1e-9);
    EXPECT_NEAR(two[330] / kDegree, 15, 1e-9);
    for (const char* bad :
         {"0 0\n1 91", "0 0\n400 3", "0 0\n1 x", "0 0\n0 1", "0 0\n1", "0 0", "0 0\n1 2 3", ""})
        EXPECT_THROW(read_horizon(bad, "h.txt"), Error) << bad;
}

}  // namespace
}  // namespace petrichor::weather
