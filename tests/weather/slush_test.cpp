// Water under and in snow: how it drains and what it is called.
#include "weather/physics/detail/slush_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "weather/models/physical/physical.h"
#include "weather/physics/constants.h"
#include "weather/physics/detail/reservoir.h"
#include "weather/physics/drainage.h"

namespace petrichor::weather {
namespace {

constexpr std::int64_t kHourUs = 3600000000LL;

// A frosty night without wind, sun or precipitation.
ForcingTable frosty_night()
{
    ForcingTable t;
    t.site.elevation_m = 100;
    for (int hour = 0; hour <= 6; ++hour) {
        t.time_us.push_back(hour * kHourUs);
        t[Field::AirTemp].push_back(263.15);
        t[Field::RelHumidity].push_back(80);
        t[Field::Wind].push_back(1);
        t[Field::Pressure].push_back(1e5);
        t[Field::Shortwave].push_back(0);
        t[Field::Longwave].push_back(260);
        t[Field::Cloud].push_back(1);
        t[Field::Precip].push_back(0);
    }
    return t;
}

PhysicalParams road()
{
    PhysicalParams params;
    params.surface = surface_preset("asphalt");
    params.surface.slush_rate_1_s = 0.0003;
    params.surface.film_capacity_kg_m2 = 1.0;
    params.deep_temp_k = 268.15;
    // Ground without heat: water below the snow drains and does not freeze.
    params.surface.conductivity_w_m_k = 1e-12;
    return params;
}

// Frozen ground below snow of 200 kg/m3, over a film of 2 kg/m2.
CellState on_film(double snow_kg_m2)
{
    CellState c = PhysicalTimeline(frosty_night(), road()).state_at(0);
    for (double& t : c.ground_temp_c) t = -5.0;
    c.snow_ice[0] = snow_kg_m2;
    c.snow_thickness[0] = snow_kg_m2 / 200.0;
    c.snow_temp_c[0] = -8.0;
    c.surface_temp_c = -9.0;
    c.film = 2.0;
    return c;
}
double film_after(const CellState& start, const PhysicalParams& params, std::int64_t us)
{
    return PhysicalTimeline(frosty_night(), params, start, 0).state_at(us).film;
}

TEST(Slush, DrainsTenTimesSlower)
{
    const PhysicalParams params = road();
    EXPECT_NEAR(film_after(on_film(20), params, kHourUs), 1.339595526, 1e-9);
    EXPECT_NEAR(film_after(on_film(20), params, kHourUs / 2), 1.582748252, 1e-9);
    EXPECT_NEAR(film_after(on_film(20), params, 3 * kHourUs), 1.039163895, 1e-9);
    PhysicalParams faster = params;
    faster.surface.slush_rate_1_s = 0.003;
    EXPECT_NEAR(film_after(on_film(20), faster, kHourUs), 1.000020400, 1e-9);
}

TEST(Slush, WaterThatDrainsIsNotLost)
{
    const PhysicalTimeline run(frosty_night(), road(), on_film(20), 0);
    const CellState start = run.state_at(0), end = run.state_at(kHourUs);
    EXPECT_NEAR(mass_balance_kg_m2(end, start), 0.0, 1e-12);
    EXPECT_NEAR(end.crack + end.puddle - start.crack - start.puddle, 0.660404474, 1e-9);
}

// The linear reservoir with the rate of slush, split at the threshold and at 0.
TEST(Slush, ReservoirIsExact)
{
    EXPECT_NEAR(drain_film(2, 0, 0.0003, 1, 3600).water_kg_m2, 1.339595526, 1e-9);
    EXPECT_NEAR(drain_film(1, 10.0 / 3600, 0.0003, 0.2, 1e6).water_kg_m2, 9.459259259, 1e-9);
    const auto falls = drain_film(1.2, -1e-4, 0.0003, 1, 3600);
    EXPECT_NEAR(falls.water_kg_m2, 0.796667876, 1e-9);
    EXPECT_NEAR(falls.drained_kg_m2, 0.043332124, 1e-9);
    const auto dries = drain_film(1.2, -1e-4, 0.0003, 1, 20000);
    EXPECT_EQ(dries.water_kg_m2, 0.0);
    EXPECT_NEAR(dries.shortfall_kg_m2, 0.843332124, 1e-9);
}

// Water that is slush up to a limit: it falls through it, rises through it, or stays there.
TEST(Slush, DrainsTheWaterAboveItsLimitAsWater)
{
    const auto end = [](double w, double net, double limit, double dt) {
        const auto step =
            detail::drain_slush(w, net, limit, detail::reservoir_constants(0.0003, 1, dt),
                                detail::reservoir_constants(0.003, 1, dt));
        EXPECT_NEAR(step.water + step.drained - step.shortfall, w + net * dt, 1e-12);
        return step.water;
    };
    EXPECT_NEAR(end(2, 0, 1.5, 3600), 1.181984736, 1e-9);  // 2 -> 1.5 in ln 2 / 0.003 s
    EXPECT_NEAR(end(2, 0, 0.5, 3600), 1.000020400, 1e-9);  // water all the time
    EXPECT_NEAR(end(2, 0, 3.0, 3600), 1.339595526, 1e-9);  // slush all the time
    EXPECT_EQ(end(2, 0.0009, 1.5, 3600), 1.5);             // between both steady states
    EXPECT_EQ(end(0.5, 0.0009, 1.5, 3600), 1.5);
    EXPECT_NEAR(end(0.5, 0.003, 1.5, 3600), 1.999971913, 1e-9);  // above both
    // Many short steps arrive where one long one does.
    for (const double net : {-4e-4, 0.0, 1e-4, 9e-4, 2e-3}) {
        double w = 1.8;
        for (int i = 0; i < 3600; ++i) w = end(w, net, 1.4, 1);
        EXPECT_NEAR(end(1.8, net, 1.4, 3600), w, 1e-9) << net;
    }
}

TEST(Slush, IsSnowOnWaterUpToHalfItsIce)
{
    const double capacity = 1.0;
    CellState c{};
    EXPECT_EQ(cover_of(c, capacity), Cover::Bare);
    c.film = 3.0;
    EXPECT_EQ(cover_of(c, capacity), Cover::Bare);
    c.snow_ice[0] = 5.0;
    EXPECT_EQ(cover_of(c, capacity), Cover::Water);
    c.snow_ice[0] = 6.0;
    EXPECT_EQ(cover_of(c, capacity), Cover::Slush);
    c.snow_liquid[0] = 0.1;
    EXPECT_EQ(cover_of(c, capacity), Cover::Water);
    c.snow_ice[1] = 60.0;
    EXPECT_EQ(cover_of(c, capacity), Cover::Slush);
    c.film = capacity;
    EXPECT_EQ(cover_of(c, capacity), Cover::Snow);
}

}  // namespace
}  // namespace petrichor::weather
