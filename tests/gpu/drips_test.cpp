// Drops off edges, before anything is drawn: laws of how many there are and how they fall.
#include "gpu/passes/falling/drips.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "formulas/noise/noise.h"
#include "formulas/weather/falling.h"

namespace petrichor::gpu {
namespace {

using Drops = std::vector<shared::FallingDrop>;

Frame wet(float rain_mm_h)
{
    Frame frame;
    frame.weather.rain_kg_m2_s = rain_mm_h / 3600.0f;
    frame.weather.film_mm = 1.0f;
    frame.settings.time_s = 100.0;
    return frame;
}

FallingView looking()
{
    FallingView view;
    view.focal_px = 800.0f;
    view.eye_m = {0.0f, 1.5f, 6.0f};
    return view;
}

// An edge of 4 m, 3 m above the ground, with the water of a metre's run.
std::vector<scene::DripPoint> edge(float run_m = 1.0f)
{
    std::vector<scene::DripPoint> points;
    for (std::uint32_t i = 0; i < 100; ++i)
        points.push_back({{-2.0f + 0.04f * static_cast<float>(i), 3.0f, 0.0f}, 0.0f, 0.04f * run_m, shared::hash_u(i)});
    return points;
}

bool bead(const shared::FallingDrop& d) { return d.diameter_m < 0.003f; }

// Drops in the air, in the mean over two minutes.
double in_air(Frame frame, const std::vector<scene::DripPoint>& points)
{
    double count = 0.0;
    constexpr int kTimes = 400;
    for (int i = 0; i < kTimes; ++i) {
        frame.settings.time_s = 0.3 * i;
        for (const auto& d : drips(points, frame, looking(), {})) count += bead(d) ? 0.0 : 1.0;
    }
    return count / kTimes;
}

TEST(Drips, CarryTheWaterThatRunsOff)
{
    // 3 mm/h on 4 m2 in drops of 0.05 ml: 66.7 a second, each in the air for the time of its fall.
    const double fall_s = static_cast<double>(drip_fall_time_s(4.55f, 3.0f));
    Frame frame = wet(3.0f);
    frame.weather.film_mm = 5.0f;
    EXPECT_NEAR(in_air(frame, edge()), 66.7 * fall_s, 0.06 * 66.7 * fall_s);
    // Twice the run or twice the rain: twice as many.
    const double one = in_air(frame, edge());
    EXPECT_NEAR(in_air(frame, edge(2.0f)) / one, 2.0, 0.1);
    frame.weather.rain_kg_m2_s *= 2.0f;
    EXPECT_NEAR(in_air(frame, edge()) / one, 2.0, 0.1);
}

TEST(Drips, NoneWhereItIsDryOrFrozenAndWhileRainWetsTheGround)
{
    const auto none = [](const shared::WeatherMoment& w) { return runs_off_kg_m2_s(w) == 0.0f; };
    shared::WeatherMoment w;
    EXPECT_TRUE(none(w));
    w.rain_kg_m2_s = 5.0f / 3600.0f;
    EXPECT_TRUE(none(w)) << "all of it stays where it falls";
    w.film_mm = 0.5f;
    EXPECT_FALSE(none(w));
    w.rain_kg_m2_s = 0.0f;
    EXPECT_FALSE(none(w)) << "for a while after it";
    w.film_mm = 0.4f;
    EXPECT_TRUE(none(w)) << "what is left is held";
    w.film_mm = 0.0f;
    w.swe_kg_m2 = 20.0f;
    w.air_temperature_k = 272.0f;
    EXPECT_TRUE(none(w));
    w.air_temperature_k = 276.15f;
    EXPECT_TRUE(none(w)) << "the pack is cold yet";
    w.melt = 0.1f;
    EXPECT_NEAR(runs_off_kg_m2_s(w) * 3600.0f, 0.6f, 1e-4f) << "melts by the degree";
    EXPECT_TRUE(drips(edge(), wet(0.0f), FallingView{}, {}).empty()) << "out of sight";
    Frame off = wet(5.0f);
    EXPECT_FALSE(drips(edge(), off, looking(), {}).empty());
    off.settings.falling = false;
    EXPECT_TRUE(drips(edge(), off, looking(), {}).empty());
}

TEST(Drips, DwindleAsTheFilmDoes)
{
    float last = 1.0f;
    for (const float film_mm : {0.66f, 0.6f, 0.5f, 0.45f, 0.41f}) {
        shared::WeatherMoment w;
        w.film_mm = film_mm;
        const float now = runs_off_kg_m2_s(w);
        EXPECT_GT(now, 0.0f);
        EXPECT_LT(now, last);
        last = now;
    }
}

// Against steps of the equation of motion: gravity less a drag that grows with the square of the speed.
TEST(Drips, FallWithTheDragOfTheAir)
{
    for (const float mm : {4.2f, 4.9f}) {
        const double last = static_cast<double>(shared::drop_speed_m_s(mm));
        double way = 0.0, speed = 0.0;
        constexpr double kStep_s = 1e-4;
        for (int i = 1; i <= 20000; ++i) {
            const double middle = speed + 0.5 * kStep_s * 9.81 * (1.0 - speed * speed / (last * last));
            way += kStep_s * middle;
            speed += kStep_s * 9.81 * (1.0 - middle * middle / (last * last));
            if (i % 4000 != 0) continue;
            const float t = static_cast<float>(i * kStep_s);
            const DripFall fall = drip_fall(mm, t);
            EXPECT_NEAR(static_cast<double>(fall.way_m), way, 1e-4 * way);
            EXPECT_NEAR(static_cast<double>(fall.speed_m_s), speed, 1e-4 * speed);
            EXPECT_NEAR(drip_fall_time_s(mm, fall.way_m), t, 1e-4f);
        }
    }
    EXPECT_NEAR(drip_fall(4.5f, 0.1f).way_m, 0.5f * 9.81f * 0.01f, 1e-3f);
}

// In the mean over time drops are as high as their fall says: more of them high up, where they are slow.
TEST(Drips, AreThickestBelowTheEdge)
{
    Frame frame = wet(3.0f);
    double height = 0.0, count = 0.0;
    for (int i = 0; i < 300; ++i) {
        frame.settings.time_s = 0.37 * i;
        for (const auto& d : drips(edge(), frame, looking(), {})) {
            if (bead(d)) continue;
            height += static_cast<double>(d.position_m.y);
            count += 1.0;
            EXPECT_LE(d.position_m.y, 3.00001f);
            EXPECT_GE(d.position_m.y, -0.001f);
        }
    }
    double expected = 0.0;
    const float fall_s = drip_fall_time_s(4.55f, 3.0f);
    for (int i = 0; i < 1000; ++i)
        expected += static_cast<double>(3.0f - drip_fall(4.55f, fall_s * (static_cast<float>(i) + 0.5f) / 1000.0f).way_m) / 1000.0;
    ASSERT_GT(count, 5000.0);
    EXPECT_NEAR(height / count, expected, 0.03);
}

TEST(Drips, AFrameAloneIsTheFrameOfARunAndADropGoesOn)
{
    Frame frame = wet(3.0f);
    const Drops first = drips(edge(), frame, looking(), {});
    frame.settings.time_s += 0.01;
    const Drops later = drips(edge(), frame, looking(), {});
    frame.settings.time_s -= 0.01;
    const Drops again = drips(edge(), frame, looking(), {});
    ASSERT_EQ(first.size(), again.size());
    EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(first[0])), 0);
    std::size_t found = 0, all = 0;
    for (const auto& d : first) {
        if (bead(d) || d.position_m.y < 0.1f) continue;
        ++all;
        for (const auto& l : later) {
            const glm::vec3 way = l.position_m - d.position_m;
            if (l.diameter_m == d.diameter_m && way.y < 0.0f && way.y > -0.09f) {
                ++found;
                break;
            }
        }
    }
    ASSERT_GT(all, 20u);
    EXPECT_EQ(found, all);
}

TEST(Drips, HeavierRainKeepsThoseThatAreThere)
{
    const Drops light = drips(edge(), wet(3.0f), looking(), {});
    const Drops heavy = drips(edge(), wet(9.0f), looking(), {});
    EXPECT_GT(heavy.size(), 2 * light.size());
    for (const auto& d : light) {
        bool there = false;
        for (const auto& h : heavy) there = there || (h.position_m == d.position_m && h.diameter_m == d.diameter_m);
        EXPECT_TRUE(there);
    }
}

TEST(Drips, BeadsFlyUpWhereDropsHit)
{
    Frame frame = wet(9.0f);
    frame.weather.wind_m_s = {4.0f, 0.0f};
    std::size_t beads = 0;
    for (const auto& d : drips(edge(), frame, looking(), {})) {
        if (!bead(d)) {
            EXPECT_GE(d.position_m.x, -2.0f) << "blown to +x";
            continue;
        }
        ++beads;
        EXPECT_LT(d.position_m.y, 0.13f);
        EXPECT_GT(d.position_m.y, -0.001f);
    }
    EXPECT_GT(beads, 20u);
}

TEST(Drips, AreAtMostSoMany)
{
    std::vector<scene::DripPoint> many;
    for (int k = 0; k < 60; ++k)
        for (scene::DripPoint p : edge(5.0f)) {
            p.number = shared::hash_u(p.number + static_cast<std::uint32_t>(k));
            p.from_m.z -= 0.1f * static_cast<float>(k);
            many.push_back(p);
        }
    Frame frame = wet(50.0f);
    const std::size_t count = drips(many, frame, looking(), {}).size();
    EXPECT_LT(count, 1.1 * kMostDrips);
    EXPECT_GT(count, 0.5 * kMostDrips);
    frame.falling.budget = 100;
    EXPECT_LT(drips(many, frame, looking(), {}).size(), 150u);
    frame.falling.budget = 0;
    EXPECT_TRUE(drips(many, frame, looking(), {}).empty());
}

TEST(Drips, TakeTheirPlaceAmongWhatFallsFarOnesFirst)
{
    Drops rain(3), own(2);
    rain[0].view_m = 9.0f;
    rain[1].view_m = 5.0f;
    rain[2].view_m = 1.0f;
    own[0].view_m = 6.0f;
    own[1].view_m = 0.5f;
    add_drips(rain, own);
    ASSERT_EQ(rain.size(), 5u);
    for (std::size_t i = 1; i < rain.size(); ++i) EXPECT_GE(rain[i - 1].view_m, rain[i].view_m);
}

}  // namespace
}  // namespace petrichor::gpu
