// De-icing salt: brine by the tables, books of salt and heat, events of a road.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "weather/models/physical/physical.h"
#include "weather/physics/brine.h"
#include "weather/physics/detail/brine_kernel.h"
#include "weather/physics/detail/single.h"
#include "weather/readers/road_events_text.h"

namespace petrichor::weather {
namespace {

constexpr std::int64_t kHourUs = 3600000000LL;

ForcingTable steady(double air_k, double sw, double lw, double rain, double snow, int hours)
{
    ForcingTable t;
    for (int i = 0; i <= hours; ++i) {
        t.time_us.push_back(i * kHourUs);
        t[Field::AirTemp].push_back(air_k);
        t[Field::RelHumidity].push_back(85);
        t[Field::Wind].push_back(2);
        t[Field::Shortwave].push_back(sw);
        t[Field::Longwave].push_back(lw);
        t[Field::Rain].push_back(i < 2 ? rain / 3600 : 0.0);
        t[Field::Snow].push_back(snow / 3600);
    }
    ReadReport report;
    fill_forcing(t, report);
    return t;
}

PhysicalParams road()
{
    PhysicalParams p;
    p.surface = surface_preset("road");
    p.deep_temp_k = 274.15;
    p.step_s = p.substep_s = 600;
    return p;
}

// Freezing points of NaCl brine, CRC Handbook: 5 % -3.05, 10 % -6.56, 15 % -10.89, 20 % -16.46 C.
TEST(Brine, FreezesWhereTheTablesSay)
{
    EXPECT_NEAR(freezing_point_c(0.05), -3.05, 0.06);
    EXPECT_NEAR(freezing_point_c(0.10), -6.56, 0.06);
    EXPECT_NEAR(freezing_point_c(0.15), -10.89, 0.3);
    EXPECT_NEAR(freezing_point_c(0.20), -16.46, 0.3);
    EXPECT_EQ(freezing_point_c(0.0), 0.0);
    EXPECT_NEAR(freezing_point_c(0.9), -kEutecticDepression_k, 1e-9);
    for (const double c : {-0.5, -2.0, -8.0, -15.0, -20.0})
        EXPECT_NEAR(freezing_point_c(brine_strength(c)), c, 1e-9);
}

// The heat that melting takes, against the root found by halving: all states of salt, ice and water, all
// melted, all frozen, at the eutectic and between.
TEST(Brine, TheHeatOfMeltingIsThatOfTheOnlyRoot)
{
    std::uint64_t seed = 7;
    const auto random = [&seed] {
        seed = seed * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(seed >> 11) * 0x1p-53;
    };
    int between = 0, at_eutectic = 0;
    for (int i = 0; i < 20000; ++i) {
        detail::BrineStores<double> s;
        s.salt = std::exp(-16.0 + 20.0 * random());
        s.water = random() < 0.1 ? 0.0 : std::exp(-8.0 + 14.0 * random());
        s.liquid = s.water * (random() < 0.2 ? 1.0 : random() < 0.3 ? 0.0 : random());
        const double free_c = -40.0 + 50.0 * random(), slope = 2.0 + 60.0 * random();
        const double dt_s = 450.0 + 3150.0 * random(), latent = kLatentFusion / dt_s;
        double low = free_c - (s.water - s.liquid) / slope * latent;
        double high = free_c + s.liquid / slope * latent;
        for (int k = 0; k < 100; ++k) {
            const double c = 0.5 * (low + high);
            const double rest = slope * (free_c - c) +
                                (s.liquid - brine_water_kg_m2(s.salt, s.water, c)) * latent;
            (rest > 0.0 ? low : high) = c;
        }
        const double root_c = 0.5 * (low + high);
        const double flux = detail::brine_flux(s, free_c, slope, dt_s);
        ASSERT_NEAR(free_c - flux / slope, root_c, 1e-9)
            << s.salt << " " << s.liquid << " of " << s.water << ", " << free_c << " C";
        const bool eutectic = std::abs(root_c + kEutecticDepression_k) < 1e-9;
        at_eutectic += eutectic;
        between += !eutectic && root_c < -1e-6 && root_c > -21.0 && flux * flux > 0.0;
    }
    EXPECT_GT(at_eutectic, 50);
    EXPECT_GT(between, 1000);
}

TEST(Brine, HoldsLessWaterTheColderItIs)
{
    double before = 10.0;
    for (const double c : {0.0, -0.1, -1.0, -5.0, -10.0, -20.0}) {
        const double held = brine_water_kg_m2(0.02, 2.0, c);
        EXPECT_LE(held, before) << c;
        before = held;
    }
    EXPECT_EQ(brine_water_kg_m2(0.02, 2.0, 0.5), 2.0);
    EXPECT_EQ(brine_water_kg_m2(0.02, 2.0, -21.3), 0.0);
    // 20 g/m2 at -5 C: 7.86 %, 234 g of water.
    EXPECT_NEAR(brine_water_kg_m2(0.02, 2.0, -5.0), 0.234, 0.002);
}

CellState after(const ForcingTable& t, const PhysicalParams& p, int hours)
{
    return PhysicalTimeline(t, p).state_at(hours * kHourUs);
}

// A wet road in a clear night: without salt it is a sheet of ice, with 60 g/m2 of salt it is wet as
// long as the equilibrium says, whatever the steps.
TEST(Salt, KeepsAWetRoadLiquid)
{
    const ForcingTable t = steady(271.15, 0, 240, 0.15, 0, 10);
    PhysicalParams plain = road(), salted = road();
    plain.surface.traffic_heat_w_m2 = salted.surface.traffic_heat_w_m2 = 0;
    salted.events = {{kHourUs, RoadEvent::Kind::Salt, 60.0}};
    const CellState ice = after(t, plain, 10), brine = after(t, salted, 10);
    ASSERT_LT(ice.surface_temp_c, -2.0);
    EXPECT_EQ(ice.film, 0.0);
    EXPECT_GT(ice.film_ice, 0.02);
    EXPECT_GT(brine.salt, 0.02);
    const double liquid = brine.film + brine.crack + brine.puddle;
    const double frozen = brine.film_ice + brine.crack_ice + brine.puddle_ice;
    EXPECT_NEAR(liquid, brine_water_kg_m2(brine.salt, liquid + frozen, brine.surface_temp_c),
                0.1 * (liquid + frozen));
    EXPECT_NEAR(brine.film_ice, 0.0, 1e-9);
}

TEST(Salt, TooColdOrTooLittleItFreezesInPart)
{
    const ForcingTable t = steady(263.15, 0, 190, 0.5, 0, 14);
    PhysicalParams p = road();
    p.surface.traffic_heat_w_m2 = 0;
    p.events = {{kHourUs, RoadEvent::Kind::Salt, 5.0}};
    const CellState c = after(t, p, 14);
    ASSERT_LT(c.surface_temp_c, -8.0);
    const double liquid = c.film + c.crack + c.puddle;
    const double frozen = c.film_ice + c.crack_ice + c.puddle_ice;
    EXPECT_GT(frozen, 0.05);
    EXPECT_GT(liquid, 0.005);
    EXPECT_NEAR(liquid, brine_water_kg_m2(c.salt, liquid + frozen, c.surface_temp_c),
                0.15 * liquid);
}

TEST(Salt, BooksOfSaltWaterAndHeatClose)
{
    for (const double air_k : {262.15, 268.15, 272.15, 275.15}) {
        const ForcingTable t = steady(air_k, 40, 250, 2.0, 0.3, 30);
        PhysicalParams p = road();
        p.surface.salt_loss_1_h = 0.1;
        p.surface.traffic_loss_1_h = 0.2;
        p.events = {{2 * kHourUs, RoadEvent::Kind::Brine, 30.0},
                    {5 * kHourUs + 17, RoadEvent::Kind::Salt, 15.0},
                    {9 * kHourUs, RoadEvent::Kind::Plough, 0.8},
                    {20 * kHourUs, RoadEvent::Kind::Salt, 10.0}};
        const PhysicalTimeline run(t, p);
        const CellState first = run.state_at(0), last = run.state_at(30 * kHourUs);
        EXPECT_NEAR(last.salt + last.total_salt_lost, 1e-3 * (0.23 * 30 + 15 + 10), 1e-12);
        EXPECT_GT(last.total_salt_lost, 1e-3);
        EXPECT_NEAR(mass_balance_kg_m2(last, first), 0.0, 1e-9) << air_k;
        EXPECT_LT(std::abs(last.mass_residual_most), 1e-9);
        EXPECT_LT(energy_residual_rms_w_m2(last), 0.5) << air_k;
    }
}

TEST(Salt, RainDilutesItAndWashesItAway)
{
    const ForcingTable t = steady(275.15, 0, 320, 8.0, 0, 6);
    PhysicalParams p = road();
    p.events = {{0, RoadEvent::Kind::Salt, 20.0}};
    EXPECT_EQ(PhysicalTimeline(t, p).state_at(0).salt, 0.02);
    const CellState c = after(t, p, 6);
    EXPECT_LT(c.salt, 0.004);
}

TEST(Salt, EatsSnowFromBelow)
{
    const ForcingTable t = steady(270.15, 0, 290, 0, 0.5, 8);
    PhysicalParams plain = road(), salted = road();
    plain.surface.snow_clearing_1_h = salted.surface.snow_clearing_1_h = 0;
    salted.events = {{2 * kHourUs, RoadEvent::Kind::Salt, 40.0}};
    const CellState a = after(t, plain, 8), b = after(t, salted, 8);
    ASSERT_GT(diagnostics(a).swe_kg_m2, 2.0);
    EXPECT_LT(diagnostics(b).swe_kg_m2, diagnostics(a).swe_kg_m2 - 0.2);
    EXPECT_LT(std::abs(b.mass_residual_most), 1e-9);
}

// Brine below snow keeps to its strength as it does without.
TEST(Salt, FreezesInPartUnderSnowToo)
{
    const ForcingTable t = steady(264.15, 0, 210, 0, 0.2, 12);
    PhysicalParams p = road();
    p.surface.snow_clearing_1_h = p.surface.traffic_heat_w_m2 = 0;
    p.deep_temp_k = 264.15;
    CellState c = after(t, p, 3);
    c.salt = 0.005;
    c.film = 0.4;
    for (double& ground_c : c.ground_temp_c) ground_c = -9.0;
    const CellState end = PhysicalTimeline(t, p, c, 3 * kHourUs).state_at(12 * kHourUs);
    ASSERT_GT(diagnostics(end).swe_kg_m2, 1.0);
    EXPECT_GT(end.film_ice, 0.2);
    EXPECT_NEAR(end.film, brine_water_kg_m2(end.salt, 10.0, end.ground_temp_c[0]), 0.2 * end.film);
    EXPECT_LT(std::abs(end.mass_residual_most), 1e-9);
}

TEST(RoadEvents, HappenAtTheEndOfTheirStepInAnyOrderOfAsking)
{
    const ForcingTable t = steady(268.15, 0, 260, 0, 1.0, 60);
    PhysicalParams p = road();
    p.surface.snow_clearing_1_h = 0;
    p.events = {{30 * kHourUs + 5, RoadEvent::Kind::Plough, 0.9},
                {40 * kHourUs, RoadEvent::Kind::Salt, 20}};
    const PhysicalTimeline run(t, p);
    const auto swe = [&](std::int64_t us) { return diagnostics(run.state_at(us)).swe_kg_m2; };
    EXPECT_GT(swe(30 * kHourUs), 25.0);
    EXPECT_LT(swe(30 * kHourUs + 600000000), 5.0);
    EXPECT_GT(swe(30 * kHourUs + 4), 25.0);
    EXPECT_LT(swe(30 * kHourUs + 5), 5.0);
    EXPECT_EQ(run.state_at(40 * kHourUs).salt, 0.02);
    EXPECT_EQ(run.state_at(40 * kHourUs - 1).salt, 0.0);
    const auto all = run.series(0, 60 * kHourUs, kHourUs / 2);
    for (const int i : {120, 61, 60, 80, 0, 79, 81})
        EXPECT_EQ(state_hash(run.state_at(i * kHourUs / 2)),
                  state_hash(all[static_cast<std::size_t>(i)]))
            << i;
    const PhysicalTimeline rest(t, p, run.state_at(40 * kHourUs), 40 * kHourUs);
    EXPECT_EQ(state_hash(rest.state_at(60 * kHourUs)), state_hash(run.state_at(60 * kHourUs)));
}

TEST(RoadEvents, TextIsReadAndWhatIsWrongIsNamed)
{
    const auto events = read_road_events(
        "time,event,amount\n# night\n2004-01-30T22:00,plough,0.95\r\n2004-01-30T14:00Z,salt,20\n"
        "2004-01-30 15:00,Brine,15\n",
        "e.csv", 3600.0);
    ASSERT_EQ(events.size(), 3u);
    EXPECT_EQ(events[0].kind, RoadEvent::Kind::Salt);
    EXPECT_EQ(events[0].time_us, events[1].time_us);  // 15:00 an hour ahead of UTC
    EXPECT_EQ(events[2].kind, RoadEvent::Kind::Plough);
    for (const char* bad : {"2004-01-30T22:00,salt", "x,salt,2", "2004-01-30T22:00,sand,2",
                            "2004-01-30T22:00,plough,1.5", "2004-01-30T22:00,salt,-3",
                            "2004-01-30T22:00,salt,nan", "2004-01-30T22:00,salt,2000"}) {
        try {
            read_road_events(bad, "e.csv", 0.0);
            FAIL() << bad;
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find("e.csv line 1"), std::string::npos) << e.what();
        }
    }
}

}  // namespace
}  // namespace petrichor::weather
