#include "gpu/passes/falling/drips.h"

#include <algorithm>
#include <cmath>

#include "formulas/weather/falling.h"
#include "formulas/weather/falls_here.h"
#include "gpu/passes/falling/falling_numbers.h"

namespace petrichor::gpu {
namespace {

constexpr float kGravity_m_s2 = 9.81f;
constexpr float kDrop_m3 = 5.0e-8f;  // that comes off an edge: 0.05 ml, as of a dropper
constexpr float kLow_mm = 4.2f, kHigh_mm = 4.9f;  // 0.04 to 0.06 ml
// What a surface holds, and how fast it sheds what is above: weather/physics/surfaces.h. By hand the film may be
// set to any depth: it sheds no more than a light rain.
constexpr float kHeld_mm = 0.4f;
constexpr float kSheds_1_s = 0.003f;
constexpr float kMostShed_mm_h = 3.0f;
constexpr float kMelt_mm_h_k = 0.2f;  // by the warmth of the air: 4.8 mm a day and kelvin (Hock 2003: 2.5 to 5.5)
constexpr float kMostMelt_mm_h = 5.0f;
constexpr float kLeast_mm_h = 0.02f;
constexpr float kSeenAt_m = 2.0f, kRoughness_m = 0.5f;  // as of rain
constexpr float kLee = 0.5f;          // of that wind beside walls (ours)
constexpr float kFarthest_m = 60.0f;
constexpr float kFaintest = 0.01f;
constexpr float kTypical_m_s = 4.0f;
// What a drop throws up: some beads a millimetre wide, by eye.
constexpr int kBeads = 4;
constexpr float kBeadLow_mm = 0.7f, kBeadHigh_mm = 1.5f;
constexpr float kBeadUp_m_s = 1.5f, kBeadOut_m_s = 0.6f;
constexpr float kBeadsLive_s = 2.0f * kBeadUp_m_s / kGravity_m_s2;

struct Seen {
    const scene::DripPoint* point;
    float fall_m;
    float per_s;
};

// Of one view and moment.
class Drips {
public:
    Drips(const Frame& frame, const FallingView& view, const std::vector<Light>& lamps)
        : view_(&view), lamps_(&lamps), time_s_(frame.settings.time_s), shutter_s_(frame.falling.shutter_s),
          seed_(mixed(shared::hash_u(frame.falling.seed), 8192))
    {
        const float share = kLee * shared::wind_share_at(kSeenAt_m, kRoughness_m);
        wind_m_s_ = glm::vec3(frame.weather.wind_m_s.x, 0.0f, frame.weather.wind_m_s.y) * share;
        reach_m_ = std::min(kFarthest_m, shared::streak_reach_m(view.focal_px, kLow_mm * 1e-3f, kTypical_m_s,
                                                                shutter_s_, kFaintest));
        half_view_ = glm::vec2(view.size) * (0.5f / view.focal_px);
    }

    // Whether any of its drops may be in the picture.
    bool sees(const scene::DripPoint& point, float fall_m) const
    {
        const float drift_m = 0.5f * glm::length(wind_m_s_) + 0.3f;
        const glm::vec3 from_eye = point.from_m - glm::vec3(0.0f, 0.5f * fall_m, 0.0f) - view_->eye_m;
        const float around_m = 0.5f * fall_m + drift_m;
        const float z = glm::dot(from_eye, view_->forward);
        if (z < kNear_m - around_m || z > reach_m_ + around_m) return false;
        const glm::vec2 at(glm::dot(from_eye, view_->right), glm::dot(from_eye, view_->up));
        const float far = std::max(z, 0.0f) + around_m;
        const glm::vec2 off = glm::abs(at - half_view_ * view_->shift * std::max(z, 0.0f));
        return off.x < half_view_.x * (1.0f + std::abs(view_->shift.x)) * far + around_m &&
               off.y < half_view_.y * (1.0f + std::abs(view_->shift.y)) * far + around_m;
    }

    void add(const Seen& seen, float share, std::vector<shared::FallingDrop>& drops) const
    {
        const scene::DripPoint& point = *seen.point;
        const float longest_s = drip_fall_time_s(kLow_mm, seen.fall_m);
        const double lasts_s = static_cast<double>(longest_s + kBeadsLive_s);
        const double slot_s = static_cast<double>(kDripSlot_s);
        const float chance = std::min(seen.per_s, kMostDrips_s) * kDripSlot_s * share;
        const std::uint32_t here = mixed(seed_, point.number);
        const auto slot_of = [&](double t) { return static_cast<std::int64_t>(std::floor(t / slot_s)); };
        for (std::int64_t slot = slot_of(time_s_ - lasts_s); slot <= slot_of(time_s_); ++slot) {
            Numbers numbers(mixed(here, slot));
            if (numbers.next() >= chance) continue;
            const double born_s = (static_cast<double>(slot) + static_cast<double>(numbers.next())) * slot_s;
            const auto age_s = static_cast<float>(time_s_ - born_s);
            const float diameter_mm = glm::mix(kLow_mm, kHigh_mm, numbers.next());
            const float lands_s = drip_fall_time_s(diameter_mm, seen.fall_m);
            if (age_s > -0.5f * shutter_s_ && age_s < lands_s) {
                add_falling(point, diameter_mm, age_s, lands_s, drops);
            } else if (age_s >= lands_s && age_s < lands_s + kBeadsLive_s) {
                add_beads(point, seen.fall_m, diameter_mm, lands_s, age_s, numbers, drops);
            }
        }
    }

private:
    glm::vec3 place(const scene::DripPoint& point, float diameter_mm, float age_s) const
    {
        const DripFall fall = drip_fall(diameter_mm, age_s);
        return point.from_m - glm::vec3(0.0f, fall.way_m, 0.0f) + wind_m_s_ * fall.blown_s;
    }

    void add_falling(const scene::DripPoint& point, float diameter_mm, float age_s, float lands_s,
                     std::vector<shared::FallingDrop>& drops) const
    {
        const float begin_s = std::max(age_s - 0.5f * shutter_s_, 0.0f);
        const float end_s = std::min(age_s + 0.5f * shutter_s_, lands_s);
        add_between(place(point, diameter_mm, begin_s), place(point, diameter_mm, end_s), diameter_mm, drops);
    }

    void add_beads(const scene::DripPoint& point, float fall_m, float diameter_mm, float lands_s, float age_s,
                   Numbers& numbers, std::vector<shared::FallingDrop>& drops) const
    {
        const glm::vec3 blown = wind_m_s_ * drip_fall(diameter_mm, lands_s).blown_s;
        const glm::vec3 from = point.from_m - glm::vec3(0.0f, fall_m, 0.0f) + blown;
        const float first_turn = numbers.next();
        for (int i = 0; i < kBeads; ++i) {
            const float turn = 6.2831853f * (first_turn + (static_cast<float>(i) + 0.6f * numbers.next()) / kBeads);
            const float up_m_s = kBeadUp_m_s * (0.4f + 0.6f * numbers.next());
            const float out_m_s = kBeadOut_m_s * (0.3f + 0.7f * numbers.next());
            const float bead_mm = glm::mix(kBeadLow_mm, kBeadHigh_mm, numbers.next());
            const float lives_s = 2.0f * up_m_s / kGravity_m_s2;
            const float at_s = age_s - lands_s;
            if (at_s >= lives_s) continue;
            const auto where = [&](float t) {
                t = std::clamp(t, 0.0f, lives_s);
                return from + glm::vec3(std::cos(turn) * out_m_s * t, (up_m_s - 0.5f * kGravity_m_s2 * t) * t,
                                        std::sin(turn) * out_m_s * t);
            };
            add_between(where(at_s - 0.5f * shutter_s_), where(at_s + 0.5f * shutter_s_), bead_mm, drops);
        }
    }

    void add_between(const glm::vec3& from, const glm::vec3& to, float diameter_mm,
                     std::vector<shared::FallingDrop>& drops) const
    {
        const glm::vec3 from_eye = 0.5f * (from + to) - view_->eye_m;
        const float z = glm::dot(from_eye, view_->forward);
        if (z <= kNear_m) return;
        shared::FallingDrop drop{};
        drop.diameter_m = diameter_mm * 1e-3f;
        drop.flake = -1.0f;
        const float seen_px = drop.diameter_m * view_->focal_px / z;
        if (!see_drop(*view_, from_eye, 0.5f * (to - from), seen_px, reach_m_, drop)) return;
        drop.speed_m_s = glm::length(to - from) / std::max(shutter_s_, 1e-6f);
        drop.lamps = light_of(*lamps_, drop.position_m, view_->eye_m, false);
        drops.push_back(drop);
    }

    const FallingView* view_;
    const std::vector<Light>* lamps_;
    double time_s_;
    float shutter_s_;
    std::uint32_t seed_;
    glm::vec3 wind_m_s_{0.0f};
    float reach_m_ = 0.0f;
    glm::vec2 half_view_{0.0f};
};

}  // namespace

float runs_off_kg_m2_s(const shared::WeatherMoment& w)
{
    // On dry ground rain fills the film first; on snow it runs through.
    const bool snow = w.swe_kg_m2 > 1.0f;
    const float wet = snow ? 1.0f : shared::wetness_of_film(w.film_mm);
    const float rain_mm_h = w.rain_kg_m2_s * 3600.0f * wet;
    const float shed_mm_h = std::clamp((w.film_mm - kHeld_mm) * kSheds_1_s * 3600.0f, 0.0f, kMostShed_mm_h);
    const float warm_k = std::max(w.air_temperature_k - 273.15f, 0.0f);
    // A pack above freezing is cold for a while yet: it drips once it holds water.
    const bool thaws = w.melt > 0.0f || w.snow_liquid_fraction > 0.0f;
    const float melt_mm_h =
        thaws && w.swe_kg_m2 > 0.0f ? std::min(kMelt_mm_h_k * warm_k, kMostMelt_mm_h) * std::min(w.swe_kg_m2, 1.0f) : 0.0f;
    const float sum_mm_h = std::max(rain_mm_h, shed_mm_h) + melt_mm_h;
    return sum_mm_h < kLeast_mm_h ? 0.0f : sum_mm_h / 3600.0f;
}

float drips_per_s(const scene::DripPoint& point, float runs_off)
{
    return runs_off * 1e-3f * point.drained_m2 / kDrop_m3;
}

DripFall drip_fall(float diameter_mm, float age_s)
{
    const float t = std::max(age_s, 0.0f);
    const float last_m_s = shared::drop_speed_m_s(diameter_mm);
    const float scale_s = last_m_s / kGravity_m_s2;
    const float lag = std::exp(-t / scale_s);
    DripFall fall;
    // ln cosh x, that does not run over.
    const float x = t / scale_s;
    fall.way_m = last_m_s * scale_s * (x + std::log1p(std::exp(-2.0f * x)) - 0.69314718f);
    fall.speed_m_s = last_m_s * std::tanh(x);
    fall.share = 1.0f - lag;
    fall.blown_s = t - scale_s * fall.share;
    return fall;
}

float drip_fall_time_s(float diameter_mm, float height_m)
{
    const float last_m_s = shared::drop_speed_m_s(diameter_mm);
    const float scale_s = last_m_s / kGravity_m_s2;
    const float y = std::max(height_m, 0.0f) / (last_m_s * scale_s);
    return scale_s * (y + std::log1p(std::sqrt(-std::expm1(-2.0f * y))));
}

std::vector<shared::FallingDrop> drips(std::span<const scene::DripPoint> points, const Frame& frame,
                                       const FallingView& view, const std::vector<Light>& lamps)
{
    std::vector<shared::FallingDrop> drops;
    const Falling& falling = frame.falling;
    if (points.empty() || !frame.settings.falling || falling.density <= 0.0f || falling.budget <= 0 ||
        frame.camera.orthographic_height_m > 0.0f) {
        return drops;
    }
    const float runs_off = runs_off_kg_m2_s(frame.weather) * falling.density;
    if (!(runs_off > 0.0f)) return drops;
    const Drips of(frame, view, lamps);
    std::vector<Seen> seen;
    double expected = 0.0;
    for (const scene::DripPoint& point : points) {
        if (point.gutter != 0) continue;
        const float fall_m = point.from_m.y - point.ground_m;
        if (!of.sees(point, fall_m)) continue;
        const float per_s = drips_per_s(point, runs_off);
        seen.push_back({&point, fall_m, per_s});
        const float lasts_s = drip_fall_time_s(kLow_mm, fall_m) + kBeads * 0.7f * kBeadsLive_s;
        expected += static_cast<double>(std::min(per_s, kMostDrips_s) * lasts_s);
    }
    const int most = std::min(falling.budget, kMostDrips);
    const float share = expected > most ? static_cast<float>(most / expected) : 1.0f;
    for (const Seen& one : seen) of.add(one, share, drops);
    std::stable_sort(drops.begin(), drops.end(), [](const auto& a, const auto& b) { return a.view_m > b.view_m; });
    return drops;
}

void add_drips(std::vector<shared::FallingDrop>& falling, std::vector<shared::FallingDrop> drips)
{
    const auto middle = static_cast<std::ptrdiff_t>(falling.size());
    falling.insert(falling.end(), drips.begin(), drips.end());
    std::inplace_merge(falling.begin(), falling.begin() + middle, falling.end(),
                       [](const auto& a, const auto& b) { return a.view_m > b.view_m; });
}

}  // namespace petrichor::gpu
