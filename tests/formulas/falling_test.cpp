#include <gtest/gtest.h>

#include "formulas/weather/falling.h"

namespace petrichor::shared {
namespace {

constexpr float kAll = 30.0f;

struct RainCase {
    float rate_mm_h;
    float above_half, above_one;  // drops per m3
    float hits;                   // above 1 mm, per m2 and second
    float per_km;
};

// Marshall and Palmer 1948 with the speeds of Atlas 1973, scaled so that the water adds up.
TEST(Rain, HoldsTheDropsOfTheTable)
{
    for (const RainCase& c : {RainCase{1.0f, 213.0f, 27.0f, 129.0f, 0.309f},
                              {5.0f, 537.0f, 125.0f, 618.0f, 0.852f},
                              {10.0f, 768.0f, 217.0f, 1102.0f, 1.336f},
                              {50.0f, 1651.0f, 670.0f, 3625.0f, 3.930f}}) {
        const float r = c.rate_mm_h;
        EXPECT_NEAR(rain_drops_per_m3(r, 0.5f, kAll), c.above_half, 0.004f * c.above_half) << r;
        EXPECT_NEAR(rain_drops_per_m3(r, 1.0f, kAll), c.above_one, 0.02f * c.above_one) << r;
        EXPECT_NEAR(rain_hits_per_m2_s(r, 1.0f), c.hits, 0.004f * c.hits) << r;
        EXPECT_NEAR(rain_extinction_per_m(r, 0.0f, kAll) * 1000.0f, c.per_km, 0.004f * c.per_km);
    }
}

TEST(Rain, CarriesDownWhatFalls)
{
    for (const float r : {0.1f, 2.0f, 10.0f, 50.0f, 300.0f}) {
        double mm_h = 0.0;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double d = 12.0 * (i + 0.5) / steps;
            const double n = static_cast<double>(rain_drops_per_m3(
                r, static_cast<float>(d - 6.0 / steps), static_cast<float>(d + 6.0 / steps)));
            mm_h += n * 0.5235988 * d * d * d * 1e-9 *
                    static_cast<double>(drop_speed_m_s(static_cast<float>(d))) * 3.6e6;
        }
        // Drops below half a millimetre follow another law of speed than the scale assumes.
        EXPECT_NEAR(mm_h, static_cast<double>(r), 0.03 * static_cast<double>(r));
    }
    EXPECT_EQ(rain_drops_per_m3(0.0f, 0.5f, kAll), 0.0f);
    EXPECT_EQ(rain_extinction_per_m(0.0f, 0.0f, kAll), 0.0f);
    EXPECT_TRUE(std::isfinite(rain_extinction_per_m(1e9f, 0.0f, kAll)));
}

TEST(Rain, SizesAddUp)
{
    const float edges[] = {0.0f, 0.3f, 0.5f, 1.0f, 2.0f, 4.0f, kAll};
    float count = 0.0f;
    float dims = 0.0f;
    for (int i = 0; i < 6; ++i) {
        count += rain_drops_per_m3(12.0f, edges[i], edges[i + 1]);
        dims += rain_extinction_per_m(12.0f, edges[i], edges[i + 1]);
    }
    EXPECT_NEAR(count, rain_drops_per_m3(12.0f, 0.0f, kAll), 1e-3f * count);
    EXPECT_NEAR(dims, rain_extinction_per_m(12.0f, 0.0f, kAll), 1e-3f * dims);
}

// Gunn and Kinzer 1949.
TEST(Rain, FallsAsFastAsMeasured)
{
    const float measured[][2] = {{0.5f, 2.06f}, {1.0f, 4.03f}, {2.0f, 6.49f},
                                 {3.0f, 8.06f}, {4.0f, 8.83f}, {5.0f, 9.09f}};
    for (const auto& [d, v] : measured) EXPECT_NEAR(drop_speed_m_s(d), v, 0.17f) << d;
    EXPECT_NEAR(drop_speed_m_s(0.3f), 1.17f, 1e-4f);
    EXPECT_GT(drop_speed_m_s(0.0f), 0.0f);
}

TEST(Snow, TakesLightAsMeasured)
{
    EXPECT_NEAR(snow_bulk_extinction_per_m(1.0f, kDrySnow_kg_m2, 1.0f), 4.90e-3f, 1e-5f);
    EXPECT_NEAR(snow_bulk_extinction_per_m(1.0f, kWetSnow_kg_m2, 1.5f), 7.7e-4f, 5e-6f);
    EXPECT_NEAR(3.912f / snow_bulk_extinction_per_m(2.5f, kDrySnow_kg_m2, 1.0f), 319.0f, 1.0f);
    EXPECT_NEAR(snow_extinction_per_m(1.0f, kDrySnow_kg_m2, 1.0f, 0.0f, 100.0f), 5.04e-3f, 1e-5f);
    EXPECT_NEAR(snow_flakes_per_m3(1.0f, kDrySnow_kg_m2, 1.0f, 0.0f, 200.0f), 1092.0f, 1.0f);
    EXPECT_NEAR(flake_speed_m_s(4.0f), 0.999f, 1e-3f);
    EXPECT_EQ(snow_flakes_per_m3(0.0f, kDrySnow_kg_m2, 1.0f, 0.0f, 200.0f), 0.0f);
    // Beyond what was measured more of the same: light is taken in proportion.
    EXPECT_NEAR(snow_extinction_per_m(50.0f, kDrySnow_kg_m2, 1.0f, 0.0f, 200.0f),
                5.0f * snow_extinction_per_m(10.0f, kDrySnow_kg_m2, 1.0f, 0.0f, 200.0f), 1e-3f);
}

// Wind makes more and smaller flakes of the same water: as much light is taken, by more of them.
TEST(Snow, WindBreaksFlakesAndNoWaterIsLost)
{
    EXPECT_EQ(snow_breakup(0.0f), 1.0f);
    EXPECT_EQ(snow_breakup(2.0f), 1.0f) << "those of a calm day stay";
    EXPECT_NEAR(snow_breakup(9.0f), 2.8f, 1e-5f);
    for (const float broken : {1.5f, 2.8f}) {
        const float whole = snow_extinction_per_m(5.0f, kDrySnow_kg_m2, 1.0f, 0.0f, 300.0f);
        EXPECT_NEAR(snow_extinction_per_m(5.0f, kDrySnow_kg_m2, broken, 0.0f, 300.0f), whole, 1e-3f * whole);
        const float count = snow_flakes_per_m3(5.0f, kDrySnow_kg_m2, 1.0f, 0.0f, 300.0f);
        EXPECT_NEAR(snow_flakes_per_m3(5.0f, kDrySnow_kg_m2, broken, 0.0f, 300.0f),
                    broken * broken * broken * count, 1e-3f * count * broken * broken * broken);
        // Half of the light by flakes above 13 mm when whole, hardly any when broken.
        EXPECT_LT(snow_extinction_per_m(5.0f, kDrySnow_kg_m2, 2.8f, 13.0f, 300.0f), 0.02f * whole);
        EXPECT_GT(snow_extinction_per_m(5.0f, kDrySnow_kg_m2, 1.0f, 13.0f, 300.0f), 0.5f * whole);
    }
}

TEST(Snow, FlakesWeighWhatTheyMeltTo)
{
    for (const float d : {0.8f, 4.0f, 12.0f}) {
        const float melted = melted_diameter_mm(d, kDrySnow_kg_m2);
        const float water_mg = 0.5235988f * melted * melted * melted;
        // The volume of a ball of that diameter times C over it.
        const float flake_mg = 0.5235988f * d * d * kDrySnow_kg_m2;
        EXPECT_NEAR(water_mg, flake_mg, 1e-4f * flake_mg);
    }
}

// f = 1108.5: 1280 x 720 with 60 degrees across.
TEST(Streaks, AreAsFaintAsShuttersMakeThem)
{
    const float f = 1108.5f;
    EXPECT_NEAR(streak_opacity(f, 0.002f, 0.5f, 6.55f, 0.02f), 0.0153f, 1e-4f);
    EXPECT_NEAR(streak_opacity(f, 0.004f, 0.5f, 8.72f, 0.02f), 0.0229f, 2e-4f);
    EXPECT_EQ(streak_opacity(f, 0.004f, 0.5f, 0.0f, 0.02f), 1.0f);
    const float reach = streak_reach_m(f, 0.002f, 6.55f, 0.004f, 0.01f);
    EXPECT_NEAR(streak_opacity(f, 0.002f, reach, 6.55f, 0.004f), 0.01f, 1e-6f);
}

// Summed over the picture a streak hides as much as the section of what makes it, however fast it goes
// and however the lens blurs it; nowhere more than all; the longer the fainter, soft at its ends.
TEST(Streaks, HideTheirSectionHoweverFastTheyGo)
{
    for (const float seen : {0.3f, 2.0f, 9.0f}) {
        for (const float blur : {0.0f, 3.0f}) {
            const float radius = spot_radius_px(seen, blur);
            const float opacity = spot_opacity(seen, radius);
            EXPECT_LE(opacity, 1.0f);
            float middle = 2.0f;
            for (const float half_way : {0.0f, 0.01f, 0.5f, 6.0f, 60.0f}) {
                double sum = 0.0;
                const double step = 0.02 * static_cast<double>(radius);
                const double end = static_cast<double>(half_way + radius);
                for (double x = -end; x < end; x += step) {
                    for (double y = -static_cast<double>(radius); y < static_cast<double>(radius); y += step) {
                        sum += static_cast<double>(streak_cover(static_cast<float>(x + 0.5 * step),
                                                                static_cast<float>(y + 0.5 * step), half_way,
                                                                radius));
                    }
                }
                sum *= step * step * static_cast<double>(opacity);
                const double section = 0.78539816 * static_cast<double>(seen * seen);
                EXPECT_NEAR(sum, section, 0.01 * section) << seen << " " << blur << " " << half_way;
                const float here = streak_cover(0.0f, 0.0f, half_way, radius);
                EXPECT_LE(here, middle);
                middle = here;
                EXPECT_NEAR(streak_cover(half_way + radius, 0.0f, half_way, radius), 0.0f, 1e-6f);
                if (half_way < radius) continue;
                EXPECT_NEAR(streak_cover(half_way, 0.0f, half_way, radius), 0.5f * here, 1e-5f);
            }
        }
    }
    // At rest it hides half where the flake itself ends, more within.
    EXPECT_NEAR(spot_opacity(200.0f, spot_radius_px(200.0f, 0.0f)) *
                    streak_cover(0.0f, 100.0f, 0.0f, spot_radius_px(200.0f, 0.0f)), 0.5f, 1e-3f);
}

// How many drops hide at least a hundredth of a pixel, beyond 0.3 m, in such a picture.
TEST(Streaks, AreAsManyAsTheTableSays)
{
    const float table[][2] = {{1, 9.5e3f}, {5, 5.2e4f}, {10, 1.1e5f}, {25, 3.3e5f}, {50, 7.7e5f}};
    for (const auto& [rate, expected] : table) {
        double seen = 0.0;
        for (float d = 0.5f; d < 8.0f; d += 0.01f) {
            const float reach = streak_reach_m(1108.5f, (d + 0.005f) * 1e-3f,
                                               drop_speed_m_s(d + 0.005f), 0.004f, 0.01f);
            // Of the solid angle of such a picture.
            const float cone = 4.0f * std::asin(0.5f * 0.30901f) / 3.0f;
            const float volume = cone * std::max(reach * reach * reach - 0.027f, 0.0f);
            seen += static_cast<double>(rain_drops_per_m3(rate, d, d + 0.01f) * volume);
        }
        EXPECT_NEAR(seen, static_cast<double>(expected), 0.03 * static_cast<double>(expected))
            << rate;
    }
}

// What is drawn and what dims the picture are all there is, never twice.
TEST(Streaks, LeaveTheRestToTheAir)
{
    // Exact near the camera and far from it, whatever the sizes; between near the sum over them.
    const float rate = 20.0f;
    const float all = rain_extinction_per_m(rate, 0.0f, kAll);
    float drawn = 0.0f;
    float weighted = 0.0f;
    const auto reach = [](float d) {
        return streak_reach_m(1108.5f, d * 1e-3f, drop_speed_m_s(d), 0.004f, 0.02f);
    };
    for (float d = 0.0f; d < 8.0f; d += 0.1f) {
        const float part = rain_extinction_per_m(rate, d, d + 0.1f);
        drawn += part;
        weighted += part * reach(d + 0.05f);
    }
    const float mean_m = weighted / drawn;
    EXPECT_NEAR(drawn, all, 1e-3f * all);
    for (const float x : {0.1f, 2.0f, 6.0f, 15.0f, 60.0f, 1000.0f}) {
        double exact = 0.0;
        for (float d = 0.0f; d < 8.0f; d += 0.1f) {
            exact += static_cast<double>(rain_extinction_per_m(rate, d, d + 0.1f)) *
                     static_cast<double>(std::min(x, reach(d + 0.05f)));
        }
        const float closed = drawn_depth(x, drawn, mean_m);
        EXPECT_LE(closed, all * x * 1.001f) << "never more than there is";
        EXPECT_NEAR(closed, exact, 0.25 * static_cast<double>(all * mean_m)) << x;
        if (x > 100.0f || x < 0.2f) {
            EXPECT_NEAR(closed, exact, 0.06 * exact) << x;
        }
    }
    EXPECT_EQ(drawn_depth(10.0f, 0.0f, 0.0f), 0.0f);
}

TEST(Streaks, SendOnAllThatTheyGet)
{
    double drop = 0.0;
    double flake = 0.0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
        const auto c = static_cast<float>(-1.0 + 2.0 * (i + 0.5) / n);
        drop += static_cast<double>(drop_phase(c)) * 4.0 * 3.14159265 / n;
        flake += static_cast<double>(flake_phase(c)) * 4.0 * 3.14159265 / n;
    }
    EXPECT_NEAR(drop, 1.0, 1e-3);
    EXPECT_NEAR(flake, 1.0, 1e-3);
    EXPECT_GT(drop_phase(1.0f), 100.0f * drop_phase(0.0f)) << "a drop bends light forward";
}

TEST(Wind, GrowsWithHeight)
{
    EXPECT_NEAR(wind_share_at(10.0f, 0.5f), 1.0f, 1e-6f);
    EXPECT_NEAR(wind_share_at(2.0f, 0.5f), 0.4627f, 1e-3f);
    EXPECT_EQ(wind_share_at(0.1f, 0.5f), 0.0f);
}

TEST(Crown, GrowsWithTheRootOfTime)
{
    EXPECT_NEAR(crown_radius_m(0.002f, 6.55f, 0.002f), 5.1e-3f, 5e-5f);
    EXPECT_NEAR(crown_radius_m(0.002f, 6.55f, 0.005f), 8.1e-3f, 5e-5f);
    EXPECT_NEAR(crown_radius_m(0.002f, 6.55f, 0.010f), 11.4e-3f, 8e-5f);
}

}  // namespace
}  // namespace petrichor::shared
