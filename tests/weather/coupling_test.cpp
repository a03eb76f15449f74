// A measured road corrects the radiation of the hours after it.
#include "weather/models/physical/coupling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/error.h"
#include "weather/forcing/cut_forcing.h"
#include "weather/models/physical/observed_water.h"
#include "weather/physics/constants.h"
#include "weather/readers/text.h"

namespace petrichor::weather {
namespace {

constexpr std::int64_t kHourUs = 3600000000LL;

// A day at 46 N from midnight UTC, 0 E, every ten minutes.
ForcingTable day_of(double cloud, double air_c = 2.0)
{
    ForcingTable t;
    t.site = {.latitude_deg = 46.0, .longitude_deg = 0.0, .elevation_m = 100.0};
    const std::int64_t begin = days_from_civil(2006, 3, 10) * 24 * kHourUs;
    for (int i = 0; i <= 144; ++i) {
        t.time_us.push_back(begin + i * kHourUs / 6);
        t[Field::AirTemp].push_back(air_c + kZeroCelsiusK + 3.0 * std::sin(0.0436 * (i - 54)));
        t[Field::RelHumidity].push_back(75.0);
        t[Field::Wind].push_back(2.0);
        t[Field::Cloud].push_back(cloud);
        t[Field::Precip].push_back(0.0);
    }
    ReadReport report;
    fill_forcing(t, report);
    return t;
}

PhysicalParams road()
{
    PhysicalParams p;
    p.surface = surface_preset("road");
    p.step_s = p.substep_s = 600.0;
    p.deep_temp_k = 278.15;
    return p;
}

// The ground below is known from the first measurement on: made-up roads begin with it.
constexpr CouplingParams kAtOnce{.settling_h = 0.0};

// A road under `truth`, measured from `begin_h` to `end_h` every ten minutes.
struct Measured {
    std::vector<std::int64_t> time_us;
    std::vector<double> surface_c, below_c;
    RoadTemperatures all() const { return {time_us, surface_c, below_c, 0.4}; }
};
Measured measured_on(const ForcingTable& truth, double begin_h, double end_h)
{
    const std::int64_t begin = truth.time_us.front() + static_cast<std::int64_t>(begin_h * 3600e6);
    const double start_c = 3.0;
    const CellState start =
        observed_start(truth, road(), {{&begin, 1}, {&start_c, 1}, {&start_c, 1}, 0.4});
    const PhysicalTimeline run(cut_forcing(truth, begin, truth.time_us.back()), road(), start,
                               begin);
    Measured m;
    for (std::int64_t us = begin;
         us <= truth.time_us.front() + static_cast<std::int64_t>(end_h * 3600e6);
         us += kHourUs / 6) {
        m.time_us.push_back(us);
        m.surface_c.push_back(run.state_at(us).surface_temp_c);
        m.below_c.push_back(3.0);
    }
    return m;
}

ForcingTable scaled(ForcingTable t, Field field, double factor)
{
    for (double& v : t[field]) v *= factor;
    return t;
}

bool same_bits(const ForcingTable& a, const ForcingTable& b)
{
    for (std::size_t f = 0; f < kFieldCount; ++f) {
        if (a.columns[f].size() != b.columns[f].size()) return false;
        if (std::memcmp(a.columns[f].data(), b.columns[f].data(),
                        a.columns[f].size() * sizeof(double)) != 0)
            return false;
    }
    return a.time_us == b.time_us;
}

// The road stood in the shade of 0.6 of the sun that the forecast has, or under a sky that sent 1.1
// of its longwave: the factor is found back, and with it the road of later hours.
TEST(Coupling, FindsTheShadeOfADayAndTheSkyOfANight)
{
    const ForcingTable forecast = day_of(0.3);
    struct Case {
        Field field;
        double factor, begin_h, end_h;
        RadiationCorrection::Flux flux;
    };
    for (const Case& c : {Case{Field::Shortwave, 0.6, 9, 12, RadiationCorrection::Flux::Shortwave},
                          Case{Field::Shortwave, 1.4, 9, 12, RadiationCorrection::Flux::Shortwave},
                          Case{Field::Longwave, 1.1, 1, 4, RadiationCorrection::Flux::Longwave},
                          Case{Field::Longwave, 0.9, 1, 4, RadiationCorrection::Flux::Longwave}}) {
        const ForcingTable truth = scaled(forecast, c.field, c.factor);
        const Measured m = measured_on(truth, c.begin_h, c.end_h);
        const auto found = couple_radiation(forecast, road(), m.all(), kAtOnce);
        EXPECT_EQ(found.flux, c.flux);
        EXPECT_NEAR(found.factor, c.factor, 0.005);
        EXPECT_LT(std::abs(found.left_k), 1e-6);
        EXPECT_EQ(found.missed_k<0.0, c.factor> 1.0);
        EXPECT_FALSE(found.at_bound);
        // An hour later: nearer than without it.
        const std::int64_t at = m.time_us.back(), then = at + kHourUs;
        const double seen = measured_on(truth, c.begin_h, c.end_h + 1.0).surface_c.back();
        const ForcingTable rest = cut_forcing(forecast, at, forecast.time_us.back());
        ForcingTable corrected = rest;
        correct_radiation(corrected, found);
        const CellState start = observed_start(rest, road(), m.all());
        const auto missed = [&](const ForcingTable& t) {
            return std::abs(PhysicalTimeline(t, road(), start, at).state_at(then).surface_temp_c -
                            seen);
        };
        EXPECT_LT(missed(corrected), 0.5 * missed(rest)) << c.factor;
    }
}

TEST(Coupling, ARoadThatIsAsForecastCorrectsNothing)
{
    const ForcingTable forecast = day_of(0.5);
    const auto found =
        couple_radiation(forecast, road(), measured_on(forecast, 9, 12).all(), kAtOnce);
    EXPECT_NEAR(found.factor, 1.0, 1e-6);
    EXPECT_NEAR(found.missed_k, 0.0, 1e-6);
}

// The warmer the measured road, the more radiation; within the bounds, which are said to be met.
TEST(Coupling, RisesWithTheMeasuredRoadWithinItsBounds)
{
    const ForcingTable forecast = day_of(0.3);
    for (const double begin_h : {1.0, 9.0}) {
        Measured m = measured_on(forecast, begin_h, begin_h + 3.0);
        const double seen = m.surface_c.back();
        double before = -1.0;
        for (const double k : {-60.0, -2.0, -1.0, 0.0, 1.0, 2.0, 60.0}) {
            m.surface_c.back() = seen + k;
            const auto found = couple_radiation(forecast, road(), m.all(), kAtOnce);
            EXPECT_GT(found.factor, before) << k;
            before = found.factor;
            EXPECT_EQ(found.at_bound, std::abs(k) > 50.0) << k;
            if (!found.at_bound) {
                EXPECT_LT(std::abs(found.left_k), 1e-6);
            }
            const bool day = begin_h > 5.0;
            EXPECT_GE(found.factor, day ? kLeastShortwaveFactor : kLeastLongwaveFactor);
            EXPECT_LE(found.factor, day ? kMostShortwaveFactor : kMostLongwaveFactor);
            const auto again = couple_radiation(forecast, road(), m.all(), kAtOnce);
            EXPECT_EQ(again.factor, found.factor);
        }
    }
}

TEST(Coupling, FadesAfterTheWindow)
{
    RadiationCorrection c;
    c.flux = RadiationCorrection::Flux::Shortwave;
    c.factor = 0.5;
    c.end_us = 7 * kHourUs;
    EXPECT_EQ(correction_at(c, 0), 0.5);
    EXPECT_EQ(correction_at(c, 7 * kHourUs), 0.5);
    EXPECT_NEAR(correction_at(c, 11 * kHourUs), 1.0 - 0.5 * std::exp(-1.0), 1e-12);
    EXPECT_NEAR(correction_at(c, 2000 * kHourUs), 1.0, 1e-12);
}

// Nothing measured, or too little, changes no bit.
TEST(Coupling, TooFewMeasurementsChangeNoBit)
{
    const ForcingTable forecast = day_of(0.5);
    const Measured m = measured_on(scaled(forecast, Field::Shortwave, 0.5), 9, 12);
    for (const std::size_t count : {1u, 4u}) {
        const auto found = couple_radiation(
            forecast, road(),
            {std::span(m.time_us).first(count), std::span(m.surface_c).first(count),
             std::span(m.below_c).first(count), 0.4},
            kAtOnce);
        EXPECT_EQ(found.flux, RadiationCorrection::Flux::None);
        EXPECT_EQ(correction_at(found, m.time_us.back()), 1.0);
        ForcingTable corrected = forecast;
        correct_radiation(corrected, found);
        EXPECT_TRUE(same_bits(corrected, forecast));
    }
    const auto off = couple_radiation(forecast, road(), m.all(), {.window_h = 0.0});
    EXPECT_EQ(off.flux, RadiationCorrection::Flux::None);
    // Three hours of settling leave nothing of three hours.
    EXPECT_EQ(couple_radiation(forecast, road(), m.all()).flux, RadiationCorrection::Flux::None);
    ForcingTable corrected = forecast;
    correct_radiation(corrected, couple_radiation(forecast, road(), m.all(), kAtOnce));
    EXPECT_FALSE(same_bits(corrected, forecast));
}

TEST(Coupling, RefusesWhatItCannotUse)
{
    const ForcingTable forecast = day_of(0.5);
    const Measured m = measured_on(forecast, 9, 12);
    EXPECT_THROW(couple_radiation(forecast, road(), m.all(), {.window_h = -1.0}), Error);
    EXPECT_THROW(couple_radiation(forecast, road(), m.all(), {.settling_h = 49.0}), Error);
    EXPECT_THROW(couple_radiation(forecast, road(), m.all(), {.relaxation_h = 0.0}), Error);
    EXPECT_THROW(couple_radiation(forecast, road(), m.all(), {.window_h = kMissing}), Error);
}

TEST(Coupling, GapsInTheMeasurementsAreNotMeasurements)
{
    const ForcingTable forecast = day_of(0.3);
    const ForcingTable truth = scaled(forecast, Field::Shortwave, 0.7);
    Measured m = measured_on(truth, 8, 14);
    for (const std::size_t i : {3u, 4u, 18u, 30u, 36u}) m.surface_c[i] = kMissing;  // 36: the last
    const auto found = couple_radiation(forecast, road(), m.all());
    EXPECT_EQ(found.begin_us, m.time_us[19]);
    EXPECT_EQ(found.end_us, m.time_us[35]);
    EXPECT_NEAR(found.factor, 0.7, 0.02);
}

// Rain of the measured hours lies on the road when a forecast begins, and dries there.
TEST(ObservedWater, IsWhatTheMeasuredHoursHaveLeft)
{
    const ForcingTable dry = day_of(0.9, 8.0);
    ForcingTable wet = dry;
    for (int i = 30; i < 36; ++i) wet[Field::Precip][static_cast<std::size_t>(i)] = 2.0 / 3600.0;
    const Measured m = measured_on(dry, 3.0, 7.0);
    EXPECT_EQ(observed_water(dry, road(), m.all()).sum(), 0.0);
    const RoadWater after = observed_water(wet, road(), m.all());
    EXPECT_GT(after.film, 0.1);
    EXPECT_GT(after.puddle, 0.0);
    const Measured until_noon = measured_on(dry, 3.0, 12.0);
    EXPECT_LT(observed_water(wet, road(), until_noon.all()).film, 0.5 * after.film);
    // Measurements that end before it rains, and one alone, know of none.
    EXPECT_EQ(observed_water(wet, road(), measured_on(dry, 3.0, 4.5).all()).sum(), 0.0);
    EXPECT_EQ(observed_water(wet, road(), measured_on(dry, 3.0, 3.0).all()).sum(), 0.0);
    // Where it rains at the first measurement, it has rained before.
    ForcingTable raining = dry;
    raining[Field::Rain].assign(raining.rows(), 1.0 / 3600.0);
    EXPECT_EQ(observed_water(raining, road(), measured_on(dry, 3.0, 3.0).all()).sum(),
              road().surface.film_capacity_kg_m2);

    const CellState start = with_water(observed_start(wet, road(), m.all()), after);
    EXPECT_EQ(start.film, after.film);
    EXPECT_EQ(start.crack, after.crack);
    EXPECT_EQ(start.puddle, after.puddle);
    EXPECT_EQ(start.surface_temp_c, m.surface_c.back());
}

}  // namespace
}  // namespace petrichor::weather
