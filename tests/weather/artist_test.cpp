#include "weather/models/artist/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "weather/models/artist/detail/math.h"

namespace petrichor::weather {
namespace {

ArtistState run(ArtistState state, double temperature_c, double rainfall, double seconds,
                int steps_a_second)
{
    const int steps = static_cast<int>(std::lround(seconds * steps_a_second));
    for (int i = 0; i < steps; ++i) {
        state = step(state, {}, temperature_c, rainfall, 1.0 / steps_a_second);
    }
    return state;
}

// ---- laws ----

TEST(ArtistStep, StaysInRangeAndSplitsRainfall)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int script = 0; script < 200; ++script) {
        ArtistState state;
        for (int i = 0; i < 50; ++i) {
            const double temperature_c = 120.0 * unit(random) - 60.0;
            const double rainfall = unit(random) < 0.3 ? 0.0 : unit(random);
            state = step(state, {}, temperature_c, rainfall, 3.0 * unit(random));
            for (double value : {state.water_to_snow, state.wetness, state.cracks, state.puddles,
                                 state.snow, state.rain, state.snowfall}) {
                ASSERT_GE(value, 0.0);
                ASSERT_LE(value, 1.0);
            }
            ASSERT_NEAR(state.rain + state.snowfall, rainfall, 1e-15);
            ASSERT_EQ(state.water, std::max(state.cracks, state.puddles));
        }
    }
}

TEST(ArtistStep, IntensitiesLagOneStep)
{
    ArtistState state;
    state.water_to_snow = 0.0;
    state = step(state, {}, 10.0, 1.0, 1.0);
    EXPECT_EQ(state.wetness, 0.0);  // the first step of rain adds no water
    EXPECT_EQ(state.rain, 1.0);
    state = step(state, {}, 10.0, 0.0, 0.1);  // the first step after it still does
    EXPECT_NEAR(state.wetness, 0.035 - 0.075 * 0.25 * 0.1, 1e-15);
}

TEST(ArtistStep, AnyRainAtAllStopsDrying)
{
    ArtistState wet;
    wet.water_to_snow = 0.0;
    wet.wetness = wet.cracks = wet.puddles = 0.5;
    EXPECT_GE(step(wet, {}, 30.0, 0.001, 1.0).wetness, 0.5);
    EXPECT_LT(step(wet, {}, 30.0, 0.0, 1.0).wetness, 0.5);
}

TEST(ArtistStep, ZeroDegreesIsColdAndHoldsThePhase)
{
    ArtistState state;
    state.water_to_snow = 0.25;
    state.cracks = state.water = 0.4;
    const ArtistState next = step(state, {}, 0.0, 0.0, 0.1);
    EXPECT_EQ(next.water_to_snow, 0.25);
    EXPECT_NEAR(next.cracks, 0.4 - 0.025, 1e-15);
    EXPECT_NEAR(next.snow, 0.025 * 0.4, 1e-15);
}

TEST(ArtistStep, ColdRainWetsNothing)
{
    ArtistState state;
    state.water_to_snow = 0.0;
    state.rain = 1.0;
    const ArtistState next = step(state, {}, -1.0, 1.0, 0.01);
    EXPECT_EQ(next.wetness, 0.0);
    EXPECT_EQ(next.cracks, 0.0);
}

TEST(ArtistStep, BeyondFortyDegreesActsAsForty)
{
    ArtistState state;
    state.water_to_snow = 0.5;
    EXPECT_EQ(step(state, {}, 40.0, 0.0, 0.1), step(state, {}, 400.0, 0.0, 0.1));
    EXPECT_EQ(step(state, {}, -40.0, 0.0, 0.1), step(state, {}, -400.0, 0.0, 0.1));
}

TEST(ArtistStep, TimeScaleStretchesTime)
{
    ArtistState state;
    state.snow = 0.5;
    state.rain = 0.3;
    ArtistParams fast;
    fast.time_scale = 4.0;
    EXPECT_EQ(step(state, fast, 12.0, 0.0, 0.25), step(state, {}, 12.0, 0.0, 1.0));
}

TEST(ArtistStep, ScriptOffOnlyPassesRainfallOn)
{
    ArtistParams manual;
    manual.script_controlled = false;
    ArtistState state;
    state.water_to_snow = 0.3;
    state.snow = 0.6;
    state.cracks = 0.2;
    state.water = 0.9;
    const ArtistState next = step(state, manual, -30.0, 0.7, 5.0);
    EXPECT_EQ(next.rain, 0.7);
    EXPECT_EQ(next.snowfall, 0.7);
    EXPECT_EQ(next.snow, 0.6);
    EXPECT_EQ(next.cracks, 0.2);
    EXPECT_EQ(next.water, 0.9);
    EXPECT_EQ(next.water_to_snow, 0.3);
}

// W set by hand beyond 1 is published clamped, but the curve sees it as it is.
TEST(ArtistOutputs, CurveSeesThePhaseBeforeTheClamp)
{
    ArtistParams params;
    params.water_to_snow_curve = {{0.0, 0.0, 0.5, 0.5}, {2.0, 1.0, 0.5, 0.5}};
    ArtistState state;
    state.water_to_snow = 1.5;
    const ArtistOutputs out = outputs(state, params, 0.0, 0.0);
    EXPECT_NEAR(out.melt, 0.25, 1e-15);
    EXPECT_EQ(out.snow_melt, 0.0);
    EXPECT_NEAR(out.freeze_exp, 1.0 - std::exp2(-10.0), 1e-15);
}

// ---- values of the reference ----

struct Row {
    double temperature_c, rainfall, rain, snowfall, wetness, cracks, puddles, snow, phase;
    double freeze_exp, melt_exp, snow_amount;
};

TEST(ArtistStep, WorkedExample)
{
    const std::vector<Row> rows{
        {10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0.994476, 0},
        {10, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0.994476, 0},
        {10, 1, 1, 0, 0.35, 0.25, 0.2, 0, 0, 0, 0.994476, 0},
        {10, 1, 1, 0, 0.7, 0.5, 0.4, 0, 0, 0, 0.994476, 0},
        {-20, 1, 0.5, 0.5, 0.2, 0, 0, 0.25, 0.5, 0.96875, 0.925675, 0.125},
        {-20, 1, 0, 1, 0, 0, 0, 0.3, 1, 0.999023, 0, 0.3},
        {-20, 1, 0, 1, 0, 0, 0, 0.4, 1, 0.999023, 0, 0.4},
        {20, 0, 0, 0, 0.7625, 0, 0, 0, 0.5, 0.96875, 0.925675, 0},
        {20, 0, 0, 0, 0.725, 0, 0, 0, 0, 0, 0.994476, 0},
        {20, 0, 0, 0, 0.6875, 0, 0, 0, 0, 0, 0.994476, 0},
    };
    ArtistState state;
    state.water_to_snow = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        if (i > 0) state = step(state, {}, row.temperature_c, row.rainfall, 1.0);
        const ArtistOutputs out = outputs(state, {}, row.temperature_c, row.rainfall);
        SCOPED_TRACE(i);
        EXPECT_NEAR(state.rain, row.rain, 1e-12);
        EXPECT_NEAR(state.snowfall, row.snowfall, 1e-12);
        EXPECT_NEAR(state.wetness, row.wetness, 1e-12);
        EXPECT_NEAR(state.cracks, row.cracks, 1e-12);
        EXPECT_NEAR(state.puddles, row.puddles, 1e-12);
        EXPECT_NEAR(state.snow, row.snow, 1e-12);
        EXPECT_NEAR(state.water_to_snow, row.phase, 1e-12);
        EXPECT_NEAR(out.freeze_exp, row.freeze_exp, 5e-7);
        EXPECT_NEAR(out.melt_exp, row.melt_exp, 5e-7);
        EXPECT_NEAR(out.snow_amount, row.snow_amount, 1e-12);
    }
}

TEST(ArtistStep, FrameSteppedValues)
{
    const ArtistState first = run({}, 20.0, 0.5, 2.0, 60);
    EXPECT_NEAR(first.wetness, 0.347078, 5e-7);
    EXPECT_NEAR(first.cracks, 0.247913, 5e-7);
    EXPECT_NEAR(first.puddles, 0.198331, 5e-7);
    EXPECT_NEAR(run({}, 20.0, 0.5, 2.0, 1).wetness, 0.175, 1e-12);

    ArtistState snowy;
    snowy.water_to_snow = 1.0;
    snowy.snow = 0.8;
    snowy.wetness = snowy.cracks = snowy.puddles = snowy.water = 0.1;
    const ArtistState thawed = run(snowy, 10.0, 0.0, 3.0, 60);
    EXPECT_NEAR(thawed.snow, 0.008021, 5e-7);
    EXPECT_NEAR(thawed.wetness, 0.835729, 5e-7);

    ArtistState wet;
    wet.water_to_snow = 0.0;
    wet.wetness = 0.9;
    wet.cracks = wet.water = 0.6;
    wet.puddles = 0.4;
    const ArtistState frozen = run(wet, -10.0, 0.8, 2.0, 60);
    EXPECT_NEAR(frozen.snow, 0.216481, 5e-7);
    EXPECT_NEAR(frozen.wetness, 0.395833, 5e-7);
    EXPECT_NEAR(frozen.cracks, 0.095833, 5e-7);
}

TEST(ArtistStep, FivePartScriptDependsOnTheFrameRate)
{
    const double parts[5][3] = {{15, .6, 2}, {-8, .6, 4}, {-8, 0, 2}, {6, 0, 3}, {12, .3, 1.5}};
    const std::pair<int, double> expected[] = {
        {240, .213886}, {60, .213115}, {30, .212080}, {10, .208053}, {2, .185222}};
    for (const auto& [rate, wetness] : expected) {
        ArtistState state;
        for (const auto& part : parts) state = run(state, part[0], part[1], part[2], rate);
        EXPECT_NEAR(state.wetness, wetness, 5e-7) << rate << " frames a second";
    }
}

// ---- the curve ----

TEST(Curve, DefaultOfTheOriginal)
{
    const auto curve = ArtistParams{}.water_to_snow_curve;
    EXPECT_EQ(curve_value(curve, -1.0), 0.25);
    EXPECT_NEAR(curve_value(curve, 0.25), 0.3671875, 1e-15);
    EXPECT_NEAR(curve_value(curve, 0.5), 0.625, 1e-15);
    EXPECT_EQ(curve_value(curve, 1.0), 1.0);
    EXPECT_EQ(curve_value(curve, 9.0), 1.0);
    EXPECT_EQ(curve_value({}, 0.5), 0.0);
}

TEST(Curve, DemoScenePassesItsKeys)
{
    const std::vector<CurveKey> demo{
        {0, 0, 2, 2}, {0.73561, 0.5201, 0.22411, 0.22411}, {1, 1, 0, 0}};
    for (const CurveKey& key : demo) EXPECT_NEAR(curve_value(demo, key.time), key.value, 1e-15);
    // By hand, u = 0.5 of the first segment: (0 + 0.5201)/2 + 0.73561 (2 - 0.22411)/8.
    EXPECT_NEAR(curve_value(demo, 0.367805), 0.26005 + 0.73561 * 1.77589 / 8.0, 1e-14);
}

TEST(Curve, InfiniteSlopeHoldsTheFirstValue)
{
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(curve_value(std::vector<CurveKey>{{0, 3, 0, inf}, {1, 5, 0, 0}}, 0.9), 3.0);
    EXPECT_EQ(curve_value(std::vector<CurveKey>{{0, 3, 0, 0}, {1, 5, -inf, 0}}, 0.9), 3.0);
    EXPECT_EQ(curve_value(std::vector<CurveKey>{{0, 3, 0, inf}, {1, 5, 0, 0}}, 1.0), 5.0);
}

TEST(Curve, AutomaticTangentsNeverOvershoot)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int round = 0; round < 200; ++round) {
        std::vector<CurveKey> keys;
        double time = 0.0;
        for (int i = 0; i < 8; ++i)
            keys.push_back({time += 0.01 + unit(random), unit(random), 0, 0});
        keys = automatic_tangents(keys);
        for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
            const double low = std::min(keys[i].value, keys[i + 1].value);
            const double high = std::max(keys[i].value, keys[i + 1].value);
            for (double u = 0.0; u <= 1.0; u += 0.05) {
                const double t = keys[i].time + u * (keys[i + 1].time - keys[i].time);
                EXPECT_GE(curve_value(keys, t), low - 1e-12);
                EXPECT_LE(curve_value(keys, t), high + 1e-12);
            }
        }
    }
}

TEST(Curve, AutomaticTangentsKeepAStraightLine)
{
    const auto keys = automatic_tangents({{0, 0, 9, 9}, {1, 2, 9, 9}, {4, 8, 9, 9}, {5, 10, 9, 9}});
    EXPECT_NEAR(curve_value(keys, 2.5), 5.0, 1e-12);
}

TEST(PortableExp, AgreesWithTheSystem)
{
    for (double x = -700.0; x < 700.0; x += 0.37) {
        EXPECT_NEAR(portable_exp(x) / std::exp(x), 1.0, 1e-15) << x;
    }
    EXPECT_EQ(portable_exp(0.0), 1.0);
    EXPECT_EQ(portable_exp(-1e300), 0.0);
    EXPECT_TRUE(std::isnan(portable_exp(std::nan(""))));
}

TEST(StateHash, SeesEveryBitAndIgnoresTheSignOfZero)
{
    ArtistState a;
    ArtistState b = a;
    EXPECT_EQ(state_hash(a), state_hash(b));
    b.snow = std::nextafter(b.snow, 1.0);
    EXPECT_NE(state_hash(a), state_hash(b));
    b = a;
    b.snow = -0.0;
    EXPECT_EQ(state_hash(a), state_hash(b));
    EXPECT_NE(state_hash(a, 1), state_hash(a, 2));
}

}  // namespace
}  // namespace petrichor::weather
