// What falls through a picture, before anything is drawn: laws of the field of drops.
#include "gpu/passes/falling/falling_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "formulas/weather/falling.h"
#include "formulas/weather/visibility.h"

namespace petrichor::gpu {
namespace {

Frame rainy(float rate_mm_h)
{
    Frame frame;
    frame.weather.rain_kg_m2_s = rate_mm_h / 3600.0f;
    frame.weather.visibility_m = 2000.0f;
    frame.weather.wind_m_s = {4.0f, -1.0f};
    frame.settings.time_s = 3.0;
    frame.falling.air_m = {12.0, -3.0};
    return frame;
}

Frame snowy(float rate_mm_h)
{
    Frame frame = rainy(0.0f);
    frame.weather.snowfall_kg_m2_s = rate_mm_h / 3600.0f;
    frame.weather.air_temperature_k = 265.0f;
    return frame;
}

FallingView looking(const glm::vec3& forward = {0.0f, 0.0f, -1.0f})
{
    FallingView view;
    view.focal_px = 1108.5f;
    view.forward = glm::normalize(forward);
    view.right = glm::normalize(glm::cross(view.forward, glm::vec3(0.01f, 1.0f, 0.0f)));
    view.up = glm::cross(view.right, view.forward);
    return view;
}

using Drops = std::vector<shared::FallingDrop>;

Drops drops_of(const Frame& frame, const FallingView& view)
{
    return falling_drops(plan_falling(frame, view), frame, view, {});
}

// Drops of both lists at one place, to a tenth of a millimetre.
std::size_t common(const Drops& a, const Drops& b)
{
    std::map<std::array<long, 3>, int> at;
    const auto key = [](const shared::FallingDrop& d) {
        return std::array<long, 3>{std::lround(d.position_m.x * 1e4f),
                                   std::lround(d.position_m.y * 1e4f),
                                   std::lround(d.position_m.z * 1e4f)};
    };
    for (const auto& d : a) ++at[key(d)];
    std::size_t found = 0;
    for (const auto& d : b) found += at.count(key(d));
    return found;
}

TEST(FallingField, DrawsAsManyAsTheBudgetAllows)
{
    for (const float rate : {1.0f, 10.0f, 50.0f}) {
        for (const int budget : {500, 5000, 20000}) {
            Frame frame = rainy(rate);
            frame.falling.budget = budget;
            const FallingPlan plan = plan_falling(frame, looking());
            const auto count = static_cast<double>(drops_of(frame, looking()).size());
            if (plan.least_opacity > 0.0101f) {
                EXPECT_NEAR(count, budget, 0.1 * budget + 50.0) << rate;
            } else {
                EXPECT_LE(count, 1.1 * budget + 50.0) << rate;
            }
        }
    }
}

// Whatever the budget: what is drawn and what dims the picture is what falls.
TEST(FallingField, CountsEveryDropOnce)
{
    for (const int budget : {0, 300, 20000}) {
        Frame frame = rainy(20.0f);
        frame.weather.visibility_m = 500.0f;
        frame.falling.budget = budget;
        const FallingPlan plan = plan_falling(frame, looking());
        const float all = shared::rain_extinction_per_m(20.0f, 0.0f, 20.0f);
        EXPECT_NEAR(plan.extinction_per_m, all, 1e-3f * all);
        EXPECT_LE(plan.drawn_per_m, plan.extinction_per_m);
        EXPECT_EQ(plan.drawn_reach_m > 0.0f, budget > 0);
        // Summed over the picture, drops hide what they no longer dim: their spots, over the picture's
        // pixels, are the depth of what is left out, which is half of their extinction.
        EXPECT_LE(plan.drawn_per_m, 0.5f * plan.extinction_per_m);
        double hidden = 0.0;
        for (const auto& d : drops_of(frame, looking())) {
            const double half = static_cast<double>(d.half_px);
            hidden += static_cast<double>(d.opacity) * 1.5707963 * half * half;
        }
        hidden /= 1280.0 * 720.0;
        const double left_out =
            static_cast<double>(plan.drawn_per_m) * static_cast<double>(plan.drawn_reach_m);
        EXPECT_NEAR(hidden, left_out, 0.15 * left_out + 1e-9) << budget;
    }
}

TEST(FallingField, NeverTakesMoreFromTheAirThanItHas)
{
    Frame frame = rainy(50.0f);
    frame.weather.visibility_m = 30000.0f;
    EXPECT_LE(plan_falling(frame, looking()).drawn_per_m,
              static_cast<float>(KOSCHMIEDER_2_PERCENT) / 30000.0f);
    // Nor is there more snow than three times what the visibility allows.
    Frame white = snowy(50.0f);
    white.weather.visibility_m = 2000.0f;
    const float seen = plan_falling(white, looking()).extinction_per_m;
    EXPECT_LT(seen, 4.0f * static_cast<float>(KOSCHMIEDER_2_PERCENT) / 2000.0f);
    EXPECT_GT(seen, 2.0f * static_cast<float>(KOSCHMIEDER_2_PERCENT) / 2000.0f);
}

// The camera turns and walks; every drop that it still sees is where it was.
TEST(FallingField, HangsInTheWorldWhateverTheCameraDoes)
{
    const Frame frame = rainy(10.0f);
    const Drops before = drops_of(frame, looking());
    const Drops turned = drops_of(frame, looking({0.2f, 0.1f, -1.0f}));
    EXPECT_GT(common(before, turned), before.size() / 3);
    FallingView walked = looking();
    walked.eye_m = {0.0f, 0.0f, -0.05f};
    EXPECT_GT(common(before, drops_of(frame, walked)), before.size() * 9 / 10);
    FallingView elsewhere = looking();
    elsewhere.eye_m = {500.0f, 0.0f, 300.0f};
    EXPECT_LT(common(before, drops_of(frame, elsewhere)), before.size() / 100);
}

// A frame alone is the frame of the run, and between two frames drops go the way of wind and fall.
TEST(FallingField, MovesWithTheAirAndFalls)
{
    Frame frame = rainy(10.0f);
    const Drops first = drops_of(frame, looking());
    const Drops again = drops_of(frame, looking());
    ASSERT_EQ(first.size(), again.size());
    EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(first[0])), 0);

    const float share = shared::wind_share_at(2.0f, 0.5f);
    Frame later = frame;
    const double dt = 0.002;
    later.settings.time_s += dt;
    later.falling.air_m += glm::dvec2(4.0, -1.0) * dt;
    const Drops next = drops_of(later, looking());
    // Each drop of the first frame, moved by its own speed, is met by one of the next.
    std::size_t met = 0;
    for (std::size_t i = 0; i < first.size(); i += 50) {
        const auto& d = first[i];
        // Of its class: by the nearest within the sway.
        float nearest = 1e9f;
        for (const auto& e : next) {
            if (std::abs(e.diameter_m - d.diameter_m) > 1e-7f) continue;
            const glm::vec3 moved = e.position_m - d.position_m;
            const glm::vec3 expected(4.0f * share * 0.002f, -d.speed_m_s * 0.002f,
                                     -1.0f * share * 0.002f);
            nearest = std::min(nearest, glm::length(moved - expected));
        }
        if (nearest < 0.004f) ++met;
    }
    EXPECT_GT(met, first.size() / 50 * 8 / 10);
}

// Flakes go with eddies: neighbours alike, strangers not; and without wind all go down.
TEST(FallingField, EddiesTurnNeighboursAlike)
{
    Frame frame = snowy(3.0f);
    frame.weather.wind_m_s = {14.0f, -4.0f};
    const Drops drops = drops_of(frame, looking());
    ASSERT_GT(drops.size(), 5000u);
    const auto way = [](const shared::FallingDrop& d) {
        const glm::vec2 v = (d.to_px - d.from_px) * d.view_m;
        return v / std::max(glm::length(v), 1e-6f);
    };
    double near = 0.0, far = 0.0, nears = 0.0, fars = 0.0;
    for (std::size_t i = 0; i < drops.size(); i += 7) {
        for (std::size_t k = i + 1; k < std::min(i + 400, drops.size()); ++k) {
            const float apart = glm::length(drops[i].position_m - drops[k].position_m);
            const double turn = std::acos(std::min(1.0, static_cast<double>(glm::dot(way(drops[i]), way(drops[k])))));
            if (apart < 0.12f) near += turn, nears += 1.0;
            if (apart > 1.0f && apart < 3.0f) far += turn, fars += 1.0;
        }
    }
    ASSERT_GT(nears, 100.0);
    ASSERT_GT(fars, 1000.0);
    EXPECT_LT(near / nears, 0.8 * far / fars);
    EXPECT_GT(far / fars, 0.1) << "radians between ways";
}

// Gusts carry flakes in clouds: parts of the picture hold more than chance gives them, as many in all.
TEST(FallingField, GustsCarryCloudsOfFlakes)
{
    const auto scatter = [](float wind_m_s, double& total) {
        Frame frame = snowy(2.0f);
        frame.weather.wind_m_s = {wind_m_s, 0.0f};
        FallingPlan plan = plan_falling(frame, looking());
        for (FallingClass& c : plan.classes) c.per_m3 = 40.0f, c.reach_m = 8.0f;
        const Drops drops = falling_drops(plan, frame, looking(), {});
        std::array<double, 144> counts{};
        for (const auto& d : drops) {
            const glm::vec2 at = 0.5f * (d.from_px + d.to_px);
            if (at.x < 0.0f || at.y < 0.0f || at.x >= 1280.0f || at.y >= 720.0f) continue;
            counts[static_cast<std::size_t>(static_cast<int>(at.y / 80.0f) * 16 + static_cast<int>(at.x / 80.0f))] += 1.0;
        }
        total = 0.0;
        for (const double n : counts) total += n;
        double variance = 0.0;
        for (const double n : counts) variance += (n - total / 144.0) * (n - total / 144.0) / 143.0;
        return variance / (total / 144.0);
    };
    double calm = 0.0, gale = 0.0;
    EXPECT_NEAR(scatter(0.0f, calm), 1.0, 0.5);
    EXPECT_GT(scatter(20.0f, gale), 2.0);
    EXPECT_NEAR(gale / calm, 1.0, 0.25);
}

// What is out of focus is as large and as faint as the lens makes it; without an aperture, near drops are.
TEST(FallingField, TheLensBlursWhatIsNear)
{
    FallingView view = looking();
    view.lens = {.radius_m = 0.01f, .focus_m = 4.0f};
    EXPECT_EQ(view.blur_px(4.0f), 0.0f);
    EXPECT_NEAR(view.blur_px(1.0f), 1108.5f * 0.01f * 0.75f, 1e-3f);
    EXPECT_NEAR(view.blur_px(1e6f), 1108.5f * 0.01f / 4.0f, 1e-2f);
    const Frame frame = snowy(2.0f);
    const auto widest = [&](const Drops& drops) {
        float most = 0.0f;
        for (const auto& d : drops) {
            if (d.view_m > 0.9f && d.view_m < 1.1f) most = std::max(most, d.half_px);
        }
        return most;
    };
    const Drops blurred = drops_of(frame, view);
    for (const auto& d : blurred) ASSERT_GE(d.half_px, view.blur_px(d.view_m));
    EXPECT_GT(widest(blurred), widest(drops_of(frame, looking())) + 1.0f);
    EXPECT_EQ(falling_view({}, Lens{}).lens.focus_m, 6.0f);
    EXPECT_EQ(falling_view({}, view.lens).lens.focus_m, 4.0f);
}

// What falls in one place is not what falls a cell further: no two drops look alike from the side.
TEST(FallingField, HasNoPattern)
{
    Frame frame = rainy(30.0f);
    frame.falling.budget = 20000;
    const Drops drops = drops_of(frame, looking());
    // Counts in 16 x 9 parts of the picture scatter as independent drops do.
    std::array<double, 144> counts{};
    double total = 0.0;
    for (const auto& d : drops) {
        const glm::vec2 at = 0.5f * (d.from_px + d.to_px);
        const int x = static_cast<int>(at.x / 80.0f);
        const int y = static_cast<int>(at.y / 80.0f);
        if (x < 0 || y < 0 || x > 15 || y > 8 || at.x < 0.0f || at.y < 0.0f) continue;
        counts[static_cast<std::size_t>(y * 16 + x)] += 1.0;
        total += 1.0;
    }
    const double mean = total / 144.0;
    double variance = 0.0;
    for (const double n : counts) variance += (n - mean) * (n - mean) / 143.0;
    EXPECT_NEAR(variance / mean, 1.0, 0.5);
}

// More rain keeps the drops that were there and adds others.
TEST(FallingField, HeavierRainAddsDrops)
{
    Frame light = rainy(5.0f);
    light.falling.budget = 3000;
    Frame heavy = rainy(5.5f);
    heavy.falling.budget = 3000;
    const Drops a = drops_of(light, looking());
    EXPECT_GT(common(a, drops_of(heavy, looking())), a.size() * 7 / 10);
}

TEST(FallingField, IsNothingWhereNothingFallsOrIsAskedFor)
{
    EXPECT_TRUE(plan_falling(rainy(0.0f), looking()).classes.empty());
    Frame off = rainy(10.0f);
    off.settings.falling = false;
    EXPECT_TRUE(plan_falling(off, looking()).classes.empty());
    Frame none = rainy(10.0f);
    none.falling.density = 0.0f;
    EXPECT_TRUE(plan_falling(none, looking()).classes.empty());
    Frame flat = rainy(10.0f);
    flat.camera.orthographic_height_m = 10.0f;
    EXPECT_EQ(plan_falling(flat, looking()).drawn_per_m, 0.0f);
}

TEST(FallingField, HoldsOutAgainstAnyWeather)
{
    for (const float rate : {1e-6f, 500.0f, 1e6f}) {
        for (const bool snow : {false, true}) {
            Frame frame = snow ? snowy(rate) : rainy(rate);
            frame.falling.density = 10.0f;
            frame.falling.shutter_s = rate > 1.0f ? 1.0f : 1e-5f;
            frame.weather.wind_m_s = {80.0f, 0.0f};
            frame.weather.visibility_m = 20.0f;
            frame.falling.air_m = {1e9, -1e9};
            frame.settings.time_s = 1e7;
            for (const float focal : {50.0f, 1000.0f, 60000.0f}) {
                FallingView view = looking({0.3f, -0.9f, 0.2f});
                view.focal_px = focal;
                const Drops drops = drops_of(frame, view);
                EXPECT_LE(drops.size(), 24000u);
                for (const auto& d : drops) {
                    ASSERT_TRUE(std::isfinite(d.opacity) && std::isfinite(d.from_px.x) &&
                                std::isfinite(d.to_px.y) && std::isfinite(d.lamps.r));
                    ASSERT_GT(d.view_m, 0.3f);
                }
            }
        }
    }
}

// Most cells are empty then, and are passed over before anything of them is worked out.
TEST(FallingField, ALightFallHasWhatItsCellsHold)
{
    for (const float rate : {0.003f, 0.03f}) {
        Frame frame = snowy(rate);
        frame.weather.wind_m_s = {9.0f, 2.0f};
        frame.falling.shutter_s = 1e-4f;
        frame.falling.budget = 200000;
        const FallingView view = looking();
        const FallingPlan plan = plan_falling(frame, view);
        const double cone = 1280.0 * 720.0 / (3.0 * std::pow(static_cast<double>(view.focal_px), 2.0));
        double wanted = 0.0;
        for (const FallingClass& c : plan.classes)
            wanted += static_cast<double>(c.per_m3) * cone * std::pow(static_cast<double>(c.reach_m), 3.0);
        ASSERT_GT(wanted, 200.0);
        double found = 0.0;
        const Drops light = drops_of(frame, view);
        for (const auto& d : light) {
            const glm::vec2 middle = 0.5f * (d.from_px + d.to_px);
            if (middle.x >= 0.0f && middle.y >= 0.0f && middle.x < 1280.0f && middle.y < 720.0f) found += 1.0;
        }
        // They lie in clouds: the spread is larger than that of a count.
        EXPECT_NEAR(found, wanted, 0.06 * wanted + 5.0 * std::sqrt(wanted)) << rate;
    }
}

TEST(FallingField, FarDropsComeFirst)
{
    const Drops drops = drops_of(snowy(3.0f), looking());
    ASSERT_GT(drops.size(), 1000u);
    EXPECT_TRUE(std::is_sorted(drops.begin(), drops.end(), [](const auto& a, const auto& b) {
        return a.view_m > b.view_m;
    }));
    for (const auto& d : drops) EXPECT_GE(d.flake, 1.0f);
}

TEST(FallingField, ALampLightsDropsBeforeIt)
{
    const Frame frame = rainy(10.0f);
    Light lamp;
    lamp.position_m = {0.0f, 0.0f, -6.0f};
    lamp.intensity = 500.0f;
    const FallingView view = looking();
    const auto drops = falling_drops(plan_falling(frame, view), frame, view, {lamp});
    double before = 0.0, behind = 0.0;
    for (const auto& d : drops) {
        if (std::abs(glm::length(d.position_m - lamp.position_m) - 2.0f) > 0.5f) continue;
        double& most = d.position_m.z > -5.0f ? before : behind;
        most = std::max(most, static_cast<double>(d.lamps.g));
    }
    EXPECT_GT(before, 3.0 * behind);
    EXPECT_GT(before, 1.0);
}

}  // namespace
}  // namespace petrichor::gpu
