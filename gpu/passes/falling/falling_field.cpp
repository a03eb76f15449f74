#include "gpu/passes/falling/falling_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formulas/weather/falling.h"
#include "formulas/weather/gusts.h"
#include "formulas/weather/visibility.h"
#include "gpu/passes/falling/falling_numbers.h"

namespace petrichor::gpu {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kFarthest_m = 250.0f;
constexpr float kFaintest = 0.01f;  // a hundredth is not seen
constexpr double kMostInCell = 400.0;
constexpr float kMostRain_mm_h = 1000.0f;  // nothing has been measured beyond: no more are drawn
constexpr float kMostSnow_mm_h = 100.0f;
// Drops are seen near the ground: the wind at 2 m over a suburb.
constexpr float kSeenAt_m = 2.0f;
constexpr float kRoughness_m = 0.5f;

constexpr float kDrops_m_s = 6.5f;  // of 2 mm
constexpr float kFlakes_m_s = 1.1f;

struct Size {
    float low_mm, high_mm, cell_m;
};
// Cells hold a few drops in heavy rain, and are small beside the reach of their class.
constexpr std::array<Size, 9> kDrops{{{0.5f, 0.75f, 0.25f},
                                      {0.75f, 1.0f, 0.3f},
                                      {1.0f, 1.35f, 0.4f},
                                      {1.35f, 1.75f, 0.5f},
                                      {1.75f, 2.2f, 0.7f},
                                      {2.2f, 2.75f, 1.0f},
                                      {2.75f, 3.5f, 1.4f},
                                      {3.5f, 4.5f, 2.0f},
                                      {4.5f, 6.5f, 3.0f}}};
constexpr std::array<Size, 9> kFlakes{{{0.7f, 1.1f, 0.3f},
                                       {1.1f, 1.6f, 0.4f},
                                       {1.6f, 2.3f, 0.5f},
                                       {2.3f, 3.2f, 0.6f},
                                       {3.2f, 4.5f, 0.8f},
                                       {4.5f, 6.5f, 1.0f},
                                       {6.5f, 9.0f, 1.5f},
                                       {9.0f, 13.0f, 2.0f},
                                       {13.0f, 20.0f, 3.0f}}};

float middle_mm(const FallingClass& c)
{
    return std::sqrt(c.low_mm * c.high_mm);
}

void add_rain(FallingPlan& plan, float rate_mm_h)
{
    if (rate_mm_h <= 0.0f) return;
    for (const Size& size : kDrops) {
        FallingClass c;
        c.id = static_cast<std::uint32_t>(&size - kDrops.data());
        c.low_mm = size.low_mm;
        c.high_mm = size.high_mm;
        c.cell_m = size.cell_m;
        c.fall_m_s = shared::drop_speed_m_s(middle_mm(c));
        c.per_m3 = shared::rain_drops_per_m3(rate_mm_h, c.low_mm, c.high_mm);
        c.extinction_per_m = shared::rain_extinction_per_m(rate_mm_h, c.low_mm, c.high_mm);
        plan.classes.push_back(c);
    }
    plan.extinction_per_m += shared::rain_extinction_per_m(rate_mm_h, 0.0f, 20.0f);
}

void add_snow(FallingPlan& plan, float rate_mm_h, float snow_kg_m2)
{
    if (rate_mm_h <= 0.0f) return;
    const bool wet = snow_kg_m2 > shared::kDrySnow_kg_m2;
    const float broken = shared::snow_breakup(glm::length(plan.air_m_s));
    for (const Size& size : kFlakes) {
        FallingClass c;
        c.id = static_cast<std::uint32_t>(&size - kFlakes.data()) + (wet ? 64 : 32);
        c.low_mm = size.low_mm;
        c.high_mm = size.high_mm;
        c.cell_m = size.cell_m;
        c.snow_kg_m2 = snow_kg_m2;
        // Wet flakes are denser and fall half as fast again.
        c.fall_m_s = shared::flake_speed_m_s(middle_mm(c)) *
                     (wet ? 1.5f : 1.0f);
        c.per_m3 = shared::snow_flakes_per_m3(rate_mm_h, snow_kg_m2, broken, c.low_mm, c.high_mm);
        c.extinction_per_m =
            shared::snow_extinction_per_m(rate_mm_h, snow_kg_m2, broken, c.low_mm, c.high_mm);
        plan.classes.push_back(c);
    }
    plan.extinction_per_m += shared::snow_extinction_per_m(rate_mm_h, snow_kg_m2, broken, 0.0f, 60.0f);
}

// Volume of the view between two distances, over their cubes' difference.
double view_cone(const FallingView& view)
{
    const double focal = static_cast<double>(view.focal_px);
    return view.size.x / focal * (view.size.y / focal) / 3.0;
}

float reach_of(const FallingPlan& plan, const FallingClass& c, const FallingView& view,
               float shutter_s, float least)
{
    const float speed = glm::length(plan.air_m_s - glm::vec3(0.0f, c.fall_m_s, 0.0f));
    const float reach =
        shared::streak_reach_m(view.focal_px, middle_mm(c) * 1e-3f, speed, shutter_s, least);
    return std::min(reach, kFarthest_m);
}

double drawn_at(const FallingPlan& plan, const FallingView& view, const Falling& falling,
                float least)
{
    const double cone = view_cone(view);
    const double near = static_cast<double>(kNear_m);
    double sum = 0.0;
    for (const FallingClass& c : plan.classes) {
        const double reach =
            static_cast<double>(reach_of(plan, c, view, falling.shutter_s, least));
        if (reach <= near) continue;
        sum += static_cast<double>(c.per_m3) * cone * (reach * reach * reach - near * near * near);
    }
    return sum;
}

// The faintest opacity at which the budget suffices.
float least_opacity(const FallingPlan& plan, const FallingView& view, const Falling& falling)
{
    const double budget = falling.budget;
    if (drawn_at(plan, view, falling, kFaintest) <= budget) return kFaintest;
    float low = kFaintest;
    float high = 1e4f;
    for (int i = 0; i < 40; ++i) {
        const float middle = std::sqrt(low * high);
        (drawn_at(plan, view, falling, middle) > budget ? low : high) = middle;
    }
    return high;
}

// ---- cells ------------------------------------------------------------------------------------

// A pyramid from the eye to a distance, in coordinates that move with the air.
struct Pyramid {
    std::array<glm::dvec3, 5> points;  // eye, then the corners of its base
};
constexpr int kEdges[8][2] = {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {2, 3}, {3, 4}, {4, 1}};

// Where the pyramid lies on the two other axes between two values of one: false where it does not.
bool slab_bounds(const Pyramid& pyramid, int axis, double from, double to, glm::dvec3& low,
                 glm::dvec3& high)
{
    low = glm::dvec3(1e300);
    high = glm::dvec3(-1e300);
    for (const auto& edge : kEdges) {
        const glm::dvec3& a = pyramid.points[static_cast<std::size_t>(edge[0])];
        const glm::dvec3& b = pyramid.points[static_cast<std::size_t>(edge[1])];
        const double length = b[axis] - a[axis];
        double t0 = 0.0;
        double t1 = 1.0;
        if (std::abs(length) < 1e-12) {
            if (a[axis] < from || a[axis] > to) continue;
        } else {
            const double u = (from - a[axis]) / length;
            const double v = (to - a[axis]) / length;
            t0 = std::max(t0, std::min(u, v));
            t1 = std::min(t1, std::max(u, v));
            if (t0 > t1) continue;
        }
        for (const double t : {t0, t1}) {
            const glm::dvec3 p = a + (b - a) * t;
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    return low[axis] <= high[axis];
}

// ---- one drop ---------------------------------------------------------------------------------

// To and fro about its way, and how fast: drops a little, flakes as eddies turn them.
struct Sway {
    glm::vec3 offset_m, speed_m_s;
};
float sway_amplitude_m(bool flake, float wind_m_s)
{
    return flake ? 0.05f + 0.012f * std::min(wind_m_s, 8.0f) : 0.015f;
}
Sway sway_of(Numbers& numbers, bool flake, float wind_m_s, double time_s)
{
    Sway sway{glm::vec3(0.0f), glm::vec3(0.0f)};
    const float wide = sway_amplitude_m(flake, wind_m_s);
    for (int axis = 0; axis < 3; ++axis) {
        const float amplitude = wide * (0.3f + numbers.next()) * (axis == 1 ? 0.5f : 1.0f);
        const double turns = static_cast<double>(flake ? 0.25f + 0.5f * numbers.next()
                                                       : 0.8f + 0.8f * numbers.next());
        const double at = turns * time_s + static_cast<double>(numbers.next());
        const double phase = 2.0 * kPi * (at - std::floor(at));
        sway.offset_m[axis] = amplitude * static_cast<float>(std::sin(phase));
        sway.speed_m_s[axis] =
            amplitude * static_cast<float>(2.0 * kPi * turns * std::cos(phase));
    }
    return sway;
}

// Eddies between houses, of sizes of arms to rooms, turn neighbours alike and strangers otherwise: waves across
// the air that moves with the wind, each across its own way, so that nothing thickens or thins out. They turn
// with the way of the wind, so all stands still without it. Speeds are a quarter of the wind's (Panofsky and Dutton
// 1984: turbulence over rough ground).
struct Eddy {
    glm::vec3 wave_per_m;  // 2 pi over its length
    glm::vec3 aside_m;     // how far, and where to
    glm::vec2 turns_per_m; // of the wind's way
};
// Of 1.0, 1.9, 3.4 and 5.8 m; 0.08 of it aside.
constexpr std::array<Eddy, 4> kEddies{{
    {{4.7911f, 2.0442f, -3.5135f}, {-0.0011f, 0.0698f, 0.0391f}, {2.773f, 1.386f}},
    {{-1.3958f, 1.7613f, 2.4260f}, {0.1343f, 0.0090f, 0.0707f}, {-0.760f, 1.521f}},
    {{1.3678f, -0.4806f, 1.1460f}, {0.1121f, 0.2459f, -0.0307f}, {0.703f, 0.609f}},
    {{0.4995f, 0.2280f, -0.9338f}, {0.3732f, 0.1444f, 0.2349f}, {-0.382f, 0.382f}},
}};
constexpr float kEddiesReach_m = 0.97f;  // all of them together
// in_air_m: where without them, in coordinates that go with the wind; speed_m_s: of the wind and the fall.
Sway eddies_at(const glm::dvec3& in_air_m, const glm::dvec2& way_m, const glm::vec3& speed_m_s)
{
    Sway sum{glm::vec3(0.0f), glm::vec3(0.0f)};
    for (const Eddy& eddy : kEddies) {
        const glm::dvec2 turns(eddy.turns_per_m);
        const double phase = glm::dot(glm::dvec3(eddy.wave_per_m), in_air_m) + glm::dot(turns, way_m);
        const double at = phase - 2.0 * kPi * std::floor(phase / (2.0 * kPi));
        const float rate = glm::dot(eddy.turns_per_m, glm::vec2(speed_m_s.x, speed_m_s.z)) +
                           eddy.wave_per_m.y * speed_m_s.y;
        sum.offset_m += eddy.aside_m * static_cast<float>(std::sin(at));
        sum.speed_m_s += eddy.aside_m * (rate * static_cast<float>(std::cos(at)));
    }
    return sum;
}

// Gusts carry flakes in clouds: how many of the mean there are at a place of the air, 1 in the mean.
float thickness_of(const glm::dvec3& in_air_m, float wind_m_s, std::uint32_t seed)
{
    const float strength = 0.95f * std::min(wind_m_s / 8.0f, 1.0f);
    const glm::dvec3 p = in_air_m / 2.6;
    const glm::dvec3 cell = glm::floor(p);
    const glm::vec3 f = glm::smoothstep(glm::vec3(0.0f), glm::vec3(1.0f), glm::vec3(p - cell));
    float sum = 0.0f;
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 c(i & 1, (i >> 1) & 1, i >> 2);
        const auto number = [&](int axis) { return static_cast<std::int64_t>(cell[axis]) + c[axis]; };
        const float value = Numbers(mixed(mixed(mixed(seed, number(0)), number(1)), number(2))).next();
        const glm::vec3 w = glm::mix(1.0f - f, f, glm::vec3(c));
        sum += w.x * w.y * w.z * value;
    }
    return 1.0f + strength * (2.0f * sum - 1.0f);
}

constexpr double kThickest = 2.0;  // thickness_of() is less

// One class as one view sees it.
class ClassInView {
public:
    ClassInView(const FallingPlan& plan, const FallingClass& of, const Frame& frame,
                const FallingView& view, const std::vector<Light>& lamps)
        : class_(&of),
          view_(&view),
          lamps_(&lamps),
          flake_(of.snow_kg_m2 > 0.0f),
          time_s_(frame.settings.time_s),
          shutter_s_(frame.falling.shutter_s),
          wind_m_s_(glm::length(plan.air_m_s)),
          speed_m_s_(plan.air_m_s - glm::vec3(0.0f, of.fall_m_s, 0.0f)),
          half_px_(glm::vec2(view.size) * 0.5f),
          eye_m_(view.eye_m),
          cell_m_(static_cast<double>(of.cell_m)),
          seed_(mixed(shared::hash_u(frame.falling.seed), of.id)),
          gust_seed_(mixed(shared::hash_u(frame.falling.seed), 4096))
    {
        const double share = static_cast<double>(shared::wind_share_at(kSeenAt_m, kRoughness_m));
        travelled_m_ = {frame.falling.air_m.x * share,
                        -static_cast<double>(of.fall_m_s) * time_s_,
                        frame.falling.air_m.y * share};
        mean_ = std::min(static_cast<double>(of.per_m3) * cell_m_ * cell_m_ * cell_m_,
                         kMostInCell);
        none_below_ = std::exp(-mean_ * (flake_ ? kThickest : 1.0));
    }

    void add_to(std::vector<shared::FallingDrop>& drops) const
    {
        // Of so little no cell holds any, and a long lens looks through millions of them.
        if (kLargestNumber < none_below_) return;
        const Pyramid pyramid = seen_part();
        const glm::vec3 along = glm::abs(view_->forward);
        const int axis = along.x >= along.y && along.x >= along.z ? 0 : along.y >= along.z ? 1 : 2;
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        double first = 1e300;
        double last = -1e300;
        for (const glm::dvec3& p : pyramid.points) {
            first = std::min(first, p[axis]);
            last = std::max(last, p[axis]);
        }
        // Where drops of cells beside the view sway into it, and streaks reach into it.
        const float way = std::min(0.5f * glm::length(speed_m_s_) * shutter_s_,
                                   kLongest_px * class_->reach_m / view_->focal_px);
        const double margin = static_cast<double>(sway_most_m() + way);
        std::array<std::int64_t, 3> cell{};
        for (cell[at(axis)] = cell_of(first - margin); cell[at(axis)] <= cell_of(last + margin);
             ++cell[at(axis)]) {
            const double begin = static_cast<double>(cell[at(axis)]) * cell_m_;
            glm::dvec3 low;
            glm::dvec3 high;
            if (!slab_bounds(pyramid, axis, begin - margin, begin + cell_m_ + margin, low, high))
                continue;
            low -= margin;
            high += margin;
            for (cell[at(u)] = cell_of(low[u]); cell[at(u)] <= cell_of(high[u]); ++cell[at(u)]) {
                for (cell[at(v)] = cell_of(low[v]); cell[at(v)] <= cell_of(high[v]); ++cell[at(v)])
                    add_cell(cell, drops);
            }
        }
    }

private:
    float sway_most_m() const
    {
        return 1.3f * sway_amplitude_m(flake_, wind_m_s_) + (flake_ ? kEddiesReach_m : 0.0f);
    }
    static std::size_t at(int axis) { return static_cast<std::size_t>(axis); }
    std::int64_t cell_of(double x) const
    {
        return static_cast<std::int64_t>(std::floor(x / cell_m_));
    }

    // In coordinates that move with the drops.
    Pyramid seen_part() const
    {
        Pyramid pyramid;
        pyramid.points[0] = eye_m_ - travelled_m_;
        const glm::vec3 x = view_->right * (half_px_.x / view_->focal_px);
        const glm::vec3 y = view_->up * (half_px_.y / view_->focal_px);
        const glm::vec3 aside = x * view_->shift.x + y * view_->shift.y;
        const glm::vec3 rays[] = {aside - x - y, aside + x - y, aside + x + y, aside - x + y};
        for (std::size_t i = 0; i < 4; ++i) {
            pyramid.points[i + 1] =
                pyramid.points[0] + glm::dvec3(view_->forward + rays[i]) *
                                        static_cast<double>(class_->reach_m);
        }
        return pyramid;
    }

    void add_cell(const std::array<std::int64_t, 3>& cell,
                  std::vector<shared::FallingDrop>& drops) const
    {
        const std::uint32_t seed = mixed(mixed(mixed(seed_, cell[0]), cell[1]), cell[2]);
        const double number = static_cast<double>(Numbers(seed).next());
        // Most cells of light snow are empty, wherever the gusts are.
        if (number < none_below_) return;
        const glm::dvec3 corner(static_cast<double>(cell[0]), static_cast<double>(cell[1]),
                                static_cast<double>(cell[2]));
        double mean = mean_;
        if (flake_)
            mean *= static_cast<double>(thickness_of((corner + 0.5) * cell_m_, wind_m_s_, gust_seed_));
        const int count = poisson(mean, number);
        for (int n = 0; n < count; ++n) {
            Numbers numbers(mixed(seed, n + 1));
            const double x = static_cast<double>(numbers.next());
            const double y = static_cast<double>(numbers.next());
            const double z = static_cast<double>(numbers.next());
            const glm::dvec3 where = travelled_m_ + (corner + glm::dvec3(x, y, z)) * cell_m_;
            add_drop(where, numbers, drops);
        }
    }

    // Off the picture, with what may yet be added to a place.
    bool far_aside(const glm::vec3& from_eye, float most) const
    {
        const float slack =
            most * (1.0f + half_px_.x * (1.0f + std::max(std::abs(view_->shift.x), std::abs(view_->shift.y))) / view_->focal_px);
        const float z = glm::dot(from_eye, view_->forward);
        const glm::vec2 half = half_px_ * (std::max(z, 0.0f) / view_->focal_px);
        const glm::vec2 reach = half + slack;
        return std::abs(glm::dot(from_eye, view_->right) - half.x * view_->shift.x) > reach.x ||
               std::abs(glm::dot(from_eye, view_->up) - half.y * view_->shift.y) > reach.y;
    }

    void add_drop(const glm::dvec3& where, Numbers& numbers,
                  std::vector<shared::FallingDrop>& drops) const
    {
        const float reach = class_->reach_m;
        const float most = sway_most_m();
        glm::vec3 from_eye(where - eye_m_);
        const float before = glm::dot(from_eye, view_->forward);
        if (before > reach + most || before < kNear_m - most) return;
        if (flake_) {
            if (far_aside(from_eye, most + 0.5f * glm::length(speed_m_s_) * shutter_s_ + 0.05f)) return;
        }
        Sway sway = sway_of(numbers, flake_, wind_m_s_, time_s_);
        if (flake_) {
            const glm::dvec2 way(travelled_m_.x, travelled_m_.z);
            const Sway eddies =
                eddies_at(where - glm::dvec3(way.x, 0.0, way.y), way, speed_m_s_);
            sway.offset_m += eddies.offset_m;
            sway.speed_m_s += eddies.speed_m_s;
        }
        from_eye += sway.offset_m;
        const float z = glm::dot(from_eye, view_->forward);
        if (z <= kNear_m || z >= reach) return;
        const glm::vec3 moves = speed_m_s_ + sway.speed_m_s;
        shared::FallingDrop drop{};
        drop.diameter_m = glm::mix(class_->low_mm, class_->high_mm, numbers.next()) * 1e-3f;
        float seen_px = drop.diameter_m * view_->focal_px / z;
        if (flake_) {
            // It tumbles: flat on, it hides three times as much as on edge.
            drop.flake = 1.0f + numbers.next();
            seen_px *= std::sqrt(0.5f + numbers.next());
        }
        if (!see_drop(*view_, from_eye, moves * (0.5f * shutter_s_), seen_px, reach, drop)) return;
        drop.speed_m_s = glm::length(moves);
        drop.lamps = light_of(*lamps_, drop.position_m, view_->eye_m, flake_);
        drops.push_back(drop);
    }

    const FallingClass* class_;
    const FallingView* view_;
    const std::vector<Light>* lamps_;
    bool flake_;
    double time_s_;
    float shutter_s_;
    float wind_m_s_;
    glm::vec3 speed_m_s_;
    glm::vec2 half_px_;
    glm::dvec3 eye_m_;
    double cell_m_;
    std::uint32_t seed_;
    std::uint32_t gust_seed_;
    glm::dvec3 travelled_m_{0.0};
    double mean_ = 0.0;
    double none_below_ = 0.0;  // a cell with a smaller number is empty
};

}  // namespace

FallingPlan plan_falling(const Frame& frame, const FallingView& view)
{
    const shared::WeatherMoment& w = frame.weather;
    const Falling& falling = frame.falling;
    FallingPlan plan;
    const float share = shared::wind_share_at(kSeenAt_m, kRoughness_m);
    plan.air_m_s = glm::vec3(w.wind_m_s.x * share, 0.0f, w.wind_m_s.y * share);
    const bool only_snow = w.snowfall_kg_m2_s > 0.0f && w.rain_kg_m2_s <= 0.0f;
    plan.shelter_fall_m_s =
        0.5f * plan.air_m_s - glm::vec3(0.0f, only_snow ? kFlakes_m_s : kDrops_m_s, 0.0f);
    if (!frame.settings.falling || falling.density <= 0.0f) return plan;

    add_rain(plan, std::min(w.rain_kg_m2_s * 3600.0f, kMostRain_mm_h));
    const float air_per_m =
        static_cast<float>(KOSCHMIEDER_2_PERCENT) / std::max(w.visibility_m, 1.0f);
    const float a_mm_h = shared::snow_bulk_extinction_per_m(1.0f, shared::kDrySnow_kg_m2, 1.0f);
    const float snow_mm_h =
        std::min({w.snowfall_kg_m2_s * 3600.0f, 3.0f * air_per_m / a_mm_h, kMostSnow_mm_h});
    const float wet = glm::smoothstep(272.15f, 274.65f, w.air_temperature_k);
    add_snow(plan, snow_mm_h * (1.0f - wet), shared::kDrySnow_kg_m2);
    add_snow(plan, snow_mm_h * wet, shared::kWetSnow_kg_m2);
    for (FallingClass& c : plan.classes) {
        c.per_m3 *= falling.density;
        c.extinction_per_m *= falling.density;
        plan.per_m3 += c.per_m3;
    }
    plan.extinction_per_m *= falling.density;
    const double period = static_cast<double>(shared::kGustPeriod_m);
    const glm::dvec2 way = frame.falling.air_m * static_cast<double>(share);
    plan.gusts = glm::vec3(glm::vec2(way - period * glm::floor(way / period)),
                           shared::gust_strength(glm::length(plan.air_m_s), plan.extinction_per_m / air_per_m));
    const double sight = static_cast<double>(w.visibility_m);
    plan.seen = static_cast<double>(plan.per_m3) * view_cone(view) * sight * sight * sight;
    const bool orthographic = frame.camera.orthographic_height_m > 0.0f;
    if (plan.classes.empty() || falling.budget <= 0 || orthographic) return plan;

    plan.least_opacity = least_opacity(plan, view, falling);
    float weighted = 0.0f;
    for (FallingClass& c : plan.classes) {
        c.reach_m = reach_of(plan, c, view, falling.shutter_s, plan.least_opacity);
        // What fades in and out counts by half.
        const float whole =
            0.5f * (1.0f + kFadeFrom) * c.reach_m - 0.5f * (kNear_m + kWhole_m);
        if (whole <= 0.0f) continue;
        plan.drawn_per_m += shared::kStopped * c.extinction_per_m;
        weighted += shared::kStopped * c.extinction_per_m * whole;
    }
    if (plan.drawn_per_m <= 0.0f) return plan;
    plan.drawn_reach_m = weighted / plan.drawn_per_m;
    // The air's own extinction is that of the visibility, whatever falls: no more can be taken off.
    plan.drawn_per_m = std::min(plan.drawn_per_m, air_per_m);
    return plan;
}

std::vector<shared::FallingDrop> falling_drops(const FallingPlan& plan, const Frame& frame,
                                               const FallingView& view,
                                               const std::vector<Light>& lamps)
{
    std::vector<shared::FallingDrop> drops;
    drops.reserve(static_cast<std::size_t>(std::max(frame.falling.budget, 0)) + 1024);
    for (const FallingClass& c : plan.classes) {
        if (c.reach_m <= kNear_m || c.per_m3 <= 0.0f) continue;
        ClassInView(plan, c, frame, view, lamps).add_to(drops);
    }
    std::stable_sort(drops.begin(), drops.end(),
                     [](const auto& a, const auto& b) { return a.view_m > b.view_m; });
    return drops;
}

}  // namespace petrichor::gpu
