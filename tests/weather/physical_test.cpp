// The physical cell: balances, measured winters, seeking, saved states.
#include "weather/models/physical/physical.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "base/error.h"
#include "tests/weather/made_up.h"
#include "tests/weather/winters.h"

namespace petrichor::weather {
namespace {

using namespace testing_winters;

using testing_weather::kHourUs;
using testing_weather::rough_year;

// ---- balances

TEST(Physical, MassAndEnergyCloseOverAYear)
{
    const ForcingTable table = rough_year();
    for (const char* name : {"asphalt", "grass", "paving_stones", "roof_metal"}) {
        PhysicalParams params;
        params.surface = surface_preset(name);
        const PhysicalTimeline run(table, params);
        const auto states = run.series(run.begin_us(), run.end_us(), kHourUs);
        double most = 0, wettest = 0, deepest = 0, iciest = 0;
        for (const auto& c : states) {
            most = std::max(most, std::abs(c.mass_residual));
            wettest = std::max(wettest, c.puddle);
            deepest = std::max(deepest, diagnostics(c).snow_depth_m);
            iciest = std::max(iciest, c.film_ice);
            const auto* numbers = reinterpret_cast<const double*>(&c);
            for (std::size_t i = 0; i < kCellNumbers; ++i)
                ASSERT_TRUE(std::isfinite(numbers[i])) << name << " " << i;
            for (const double v : {c.film, c.crack, c.puddle, c.film_ice, c.crack_ice, c.puddle_ice,
                                   c.snow_ice[0], c.snow_ice[1], c.snow_ice[2], c.snow_liquid[0],
                                   c.snow_liquid[1], c.snow_liquid[2]}) {
                ASSERT_GE(v, 0.0) << name;
            }
        }
        const CellState& end = states.back();
        EXPECT_LE(most, 1e-9) << name;
        EXPECT_LE(std::abs(mass_balance_kg_m2(end, states.front())), 1e-6) << name;
        EXPECT_LE(energy_residual_rms_w_m2(end), 0.5) << name;
        EXPECT_GT(end.total_precip, 300) << name;
        EXPECT_GT(end.total_evaporation, 20) << name;
        EXPECT_GT(deepest, 0.1) << name;
        EXPECT_GT(iciest, 0.03) << name;
        if (params.surface.infiltration.first_mm_h == 0)
            EXPECT_GT(wettest, 0.9 * params.surface.puddles.capacity_kg_m2()) << name;
        else
            EXPECT_GT(end.total_infiltration, 50) << name;
    }
}

// Peak of the snow pack at ever shorter steps; substeps stay a sixth of the step.
void expect_convergence(const ForcingTable& table, const char* name)
{
    double coarser = 0;
    for (const double step_s : {3600.0, 1800.0, 900.0, 450.0}) {
        PhysicalParams params = meadow();
        params.step_s = step_s;
        params.substep_s = step_s / 6.0;
        const PhysicalTimeline run(table, params);
        double most = 0;
        for (const auto& c : run.series(run.begin_us(), run.end_us(), kHourUs))
            most = std::max(most, diagnostics(c).swe_kg_m2);
        const double change_pct = coarser > 0 ? 100.0 * (most - coarser) / coarser : 0.0;
        std::printf("  %s, step %4.0f s: peak SWE %8.3f kg/m2, %+.3f %%\n", name, step_s, most,
                    change_pct);
        EXPECT_LT(std::abs(change_pct), 2.0) << name << " at " << step_s;
        coarser = most;
    }
}
TEST(Physical, HalvingTheStepKeepsThePeak)
{
    expect_convergence(rough_year(), "made-up year");
}
TEST(Winters, HalvingTheStepKeepsThePeak)
{
    if (asset("met_CdP_0506.txt").empty())
        GTEST_SKIP() << "PETRICHOR_ASSETS does not name a folder with weather/";
    expect_convergence(winter_2005().table, "Col de Porte 2005-06");
}

// ---- measured winters

TEST(Winters, ColDePorte2005)
{
    if (asset("met_CdP_0506.txt").empty())
        GTEST_SKIP() << "PETRICHOR_ASSETS does not name a folder with weather/";
    const Winter winter = winter_2005();
    const Scores s = score(winter, meadow());
    RecordProperty("depth_rmse_m", std::to_string(s.depth_m));
    std::printf("  depth %.4f m, SWE %.2f kg/m2, surface %.3f K, albedo %.4f\n", s.depth_m,
                s.swe_kg_m2, s.surface_k, s.albedo);
    EXPECT_LE(s.depth_m, 0.12);
    EXPECT_LE(s.swe_kg_m2, 40);
    EXPECT_LE(s.surface_k, 1.8);
    EXPECT_LE(s.albedo, 0.10);
}

TEST(Winters, ColDePorte2001)
{
    if (asset("col_de_porte_2001_02_met_hourly.csv").empty())
        GTEST_SKIP() << "PETRICHOR_ASSETS does not name a folder with weather/";
    const Scores s = score(winter_2001(), meadow());
    std::printf("  depth %.4f m, SWE %.2f kg/m2\n", s.depth_m, s.swe_kg_m2);
    EXPECT_LE(s.depth_m, 0.12);
    EXPECT_LE(s.swe_kg_m2, 80);
}

// ---- time

TEST(Physical, AnyTimeInAnyOrderGivesTheSameBits)
{
    const ForcingTable table = rough_year(2000);
    const PhysicalTimeline run(table, meadow());
    const auto all = run.series(run.begin_us(), run.end_us(), kHourUs / 2);
    for (std::size_t i = all.size(); i-- > 0;) {
        if (i % 97 != 0) continue;
        EXPECT_EQ(
            state_hash(run.state_at(run.begin_us() + static_cast<std::int64_t>(i) * kHourUs / 2)),
            state_hash(all[i]))
            << i;
    }
    EXPECT_EQ(state_hash(run.state_at(run.begin_us() - 5)), state_hash(all.front()));
    EXPECT_EQ(state_hash(run.state_at(run.end_us() + 5)), state_hash(all.back()));
}

TEST(Physical, SavedStatesContinueWithIdenticalBits)
{
    const ForcingTable table = rough_year(1500);
    const PhysicalTimeline run(table, meadow());
    const std::int64_t at = run.begin_us() + 701 * kHourUs;
    const CellState restored = load_state(save_state(run.state_at(at)));
    const PhysicalTimeline rest(table, meadow(), restored, at);
    EXPECT_EQ(state_hash(rest.state_at(run.end_us())), state_hash(run.state_at(run.end_us())));
    EXPECT_EQ(state_hash(rest.state_at(at + 100 * kHourUs + 17)),
              state_hash(run.state_at(at + 100 * kHourUs + 17)));
    EXPECT_THROW(PhysicalTimeline(table, meadow(), restored, at + 1), Error);
    std::string text = save_state(restored);
    text[40] = text[40] == '0' ? '1' : '0';
    EXPECT_THROW(load_state(text), Error);
    EXPECT_THROW(load_state("petrichor-cell-1 00"), Error);
}

TEST(Physical, SeekingTakesLessThanAMillisecond)
{
    const PhysicalTimeline run(rough_year(), meadow());
    double best = 1e9;
    for (int k = 0; k < 5; ++k) {
        const auto begin = std::chrono::steady_clock::now();
        double sum = 0;
        for (int i = 0; i < 20; ++i)
            sum += run.state_at(run.begin_us() + (i * 411 + k) * kHourUs + 1234).film;
        best = std::min(
            best,
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / 20);
        ASSERT_TRUE(std::isfinite(sum));
    }
#ifdef NDEBUG
    EXPECT_LT(best, 1e-3);
#endif
}

// The hash of one run, written down: every compiler and every machine must arrive at it.
TEST(Physical, OneHashEverywhere)
{
    const PhysicalTimeline run(rough_year(3000), meadow());
    EXPECT_EQ(hash_text(state_hash(run.series(run.begin_us(), run.end_us(), 24 * kHourUs))),
              "44f49355954b7373");
}

TEST(Physical, ParametersOutOfRangeAreNamed)
{
    const ForcingTable table = rough_year(30);
    PhysicalParams p;
    p.sky_view = 2;
    try {
        PhysicalTimeline run(table, p);
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("sky_view must be in 0..1, got 2"), std::string::npos);
    }
    EXPECT_THROW(surface_preset("lava"), Error);
    EXPECT_EQ(surface_preset("Paving Stones").name, "paving_stones");
    for (const Surface& s : surface_presets()) EXPECT_NO_THROW(check_surface(s));
}

}  // namespace
}  // namespace petrichor::weather
