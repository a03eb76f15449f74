#include "gpu/passes/falling/falling_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formulas/weather/falling.h"
#include "formulas/weather/visibility.h"
#include "gpu/passes/falling/falling_numbers.h"

namespace petrichor::gpu {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kNear_m = 0.3f;     // nearer ones are a blur on the lens
constexpr float kWhole_m = 0.7f;    // they come in until here
constexpr float kFadeFrom = 0.75f;  // and go from this share of the reach on
constexpr float kFarthest_m = 250.0f;
constexpr float kFaintest = 0.01f;  // a hundredth is not seen
constexpr double kMostInCell = 400.0;
constexpr float kMostRain_mm_h = 1000.0f;  // nothing has been measured beyond: no more are drawn
constexpr float kMostSnow_mm_h = 100.0f;
constexpr float kLongest_px = 200.0f;  // of a streak that begins outside of the picture
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
        c.per_m3 = shared::snow_flakes_per_m3(rate_mm_h, snow_kg_m2, c.low_mm, c.high_mm);
        c.extinction_per_m =
            shared::snow_extinction_per_m(rate_mm_h, snow_kg_m2, c.low_mm, c.high_mm);
        plan.classes.push_back(c);
    }
    plan.extinction_per_m += shared::snow_extinction_per_m(rate_mm_h, snow_kg_m2, 0.0f, 60.0f);
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
          seed_(mixed(shared::hash_u(frame.falling.seed), of.id))
    {
        const double share = static_cast<double>(shared::wind_share_at(kSeenAt_m, kRoughness_m));
        travelled_m_ = {frame.falling.air_m.x * share,
                        -static_cast<double>(of.fall_m_s) * time_s_,
                        frame.falling.air_m.y * share};
        mean_ = std::min(static_cast<double>(of.per_m3) * cell_m_ * cell_m_ * cell_m_,
                         kMostInCell);
    }

    void add_to(std::vector<shared::FallingDrop>& drops) const
    {
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
    float sway_most_m() const { return 1.3f * sway_amplitude_m(flake_, wind_m_s_); }
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
        const glm::vec3 rays[] = {-x - y, x - y, x + y, -x + y};
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
        const int count = poisson(mean_, static_cast<double>(Numbers(seed).next()));
        const glm::dvec3 corner(static_cast<double>(cell[0]), static_cast<double>(cell[1]),
                                static_cast<double>(cell[2]));
        for (int n = 0; n < count; ++n) {
            Numbers numbers(mixed(seed, n + 1));
            const double x = static_cast<double>(numbers.next());
            const double y = static_cast<double>(numbers.next());
            const double z = static_cast<double>(numbers.next());
            const glm::dvec3 where = travelled_m_ + (corner + glm::dvec3(x, y, z)) * cell_m_;
            add_drop(glm::vec3(where - eye_m_), numbers, drops);
        }
    }

    glm::vec2 on_screen(const glm::vec3& from_eye) const
    {
        const float scale = view_->focal_px / std::max(glm::dot(from_eye, view_->forward), 0.1f);
        return {half_px_.x + glm::dot(from_eye, view_->right) * scale,
                half_px_.y - glm::dot(from_eye, view_->up) * scale};
    }

    void add_drop(glm::vec3 from_eye, Numbers& numbers,
                  std::vector<shared::FallingDrop>& drops) const
    {
        const float reach = class_->reach_m;
        const float most = sway_most_m();
        const float before = glm::dot(from_eye, view_->forward);
        if (before > reach + most || before < kNear_m - most) return;
        const Sway sway = sway_of(numbers, flake_, wind_m_s_, time_s_);
        from_eye += sway.offset_m;
        const float z = glm::dot(from_eye, view_->forward);
        if (z <= kNear_m || z >= reach) return;
        const glm::vec3 moves = speed_m_s_ + sway.speed_m_s;
        const glm::vec3 half_way = moves * (0.5f * shutter_s_);
        shared::FallingDrop drop{};
        drop.from_px = on_screen(from_eye - half_way);
        drop.to_px = on_screen(from_eye + half_way);
        drop.view_m = z;
        drop.diameter_m = glm::mix(class_->low_mm, class_->high_mm, numbers.next()) * 1e-3f;
        const float seen_px = drop.diameter_m * view_->focal_px / z;
        drop.half_px = 0.5f * seen_px + 0.5f;
        const glm::vec2 middle = on_screen(from_eye);
        const glm::vec2 low = glm::max(glm::min(drop.from_px, drop.to_px), middle - kLongest_px) -
                              drop.half_px;
        const glm::vec2 high = glm::min(glm::max(drop.from_px, drop.to_px), middle + kLongest_px) +
                               drop.half_px;
        if (high.x < 0.0f || high.y < 0.0f || low.x > 2.0f * half_px_.x ||
            low.y > 2.0f * half_px_.y) {
            return;
        }
        // What is hidden, summed over pixels and the shutter's time, is twice the section of the
        // drop, as extinction counts it (bent light and shadow); the divisor is the sum of the
        // outline that the shader draws.
        const float length = glm::length(drop.to_px - drop.from_px);
        const float section = 1.5707963f * seen_px * seen_px;
        const float outline = drop.half_px * (1.3333333f * length + 1.5707963f * drop.half_px);
        const float there = glm::smoothstep(kNear_m, kWhole_m, z) *
                            (1.0f - glm::smoothstep(kFadeFrom * reach, reach, z));
        drop.opacity = section / outline * there;
        if (drop.opacity <= 0.0f) return;
        drop.flake = flake_ ? 1.0f + numbers.next() : 0.0f;
        drop.position_m = view_->eye_m + from_eye;
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
    glm::dvec3 travelled_m_{0.0};
    double mean_ = 0.0;
};

}  // namespace

FallingView falling_view(const shared::FrameConstants& c)
{
    FallingView view;
    view.eye_m = c.camera_m;
    view.forward = c.forward;
    view.right = glm::normalize(c.ray_dx);
    view.up = -glm::normalize(c.ray_dy);
    view.focal_px = 1.0f / std::max(glm::length(c.ray_dx), 1e-9f);
    view.size = c.size;
    return view;
}

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
        plan.drawn_per_m += c.extinction_per_m;
        weighted += c.extinction_per_m * whole;
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
