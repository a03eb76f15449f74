#include "gpu/passes/falling/splashes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "formulas/weather/drop_births.h"
#include "formulas/weather/falling.h"
#include "gpu/passes/falling/falling_numbers.h"

namespace petrichor::gpu {
namespace {

constexpr double kCell_m = 0.5;
constexpr double kSlot_s = 0.02;       // longer than a splash lives
constexpr float kSmallest_mm = 1.0f;   // smaller drops hardly splash
constexpr float kLargest_mm = 6.0f;
constexpr float kBelowEye_m = 1.6f;    // about where the ground is
constexpr float kAround_m = 2.5f;      // a roof or a slope may bring them into the picture
constexpr std::size_t kMost = 20000;

// Of rings that begin, so many have a crown at most: the map of rings repeats, and crowns should not be seen to.
constexpr float kMostOfRings = 0.5f;

// Which drops splash where rings begin: the largest there are, as many as there are rings for.
struct RingCrowns {
    std::array<float, shared::kRippleLayers> share{};  // of the rings of a layer
    float least_mm = kLargest_mm;                      // smaller drops splash where nothing shows their rings
};

RingCrowns ring_crowns(const Frame& frame, float rate_mm_h)
{
    RingCrowns crowns;
    const float tiling = frame.look.ripple_tiling, speed = frame.look.ripple_speed;
    if (!(tiling > 0.0f) || !(speed > 0.0f)) return crowns;
    float rings = 0.0f;
    for (int i = 0; i < shared::kRippleLayers; ++i) {
        // Rings of a layer that fades in are faint: fewer of them are of drops that splash.
        const auto at = static_cast<std::size_t>(i);
        crowns.share[at] = kMostOfRings * shared::ripple_layer(i, frame.weather.rain, 0.0f, speed).weight;
        rings += crowns.share[at] * shared::ring_births_per_m2_s(i, tiling, speed);
    }
    if (!(rings > 0.0f)) return crowns;
    const auto hits = [&](float least_mm) { return shared::rain_hits_per_m2_s(rate_mm_h, least_mm) * frame.falling.density; };
    if (hits(kSmallest_mm) <= rings) {
        crowns.least_mm = kSmallest_mm;
        for (float& share : crowns.share) share *= hits(kSmallest_mm) / rings;
        return crowns;
    }
    float low_mm = kSmallest_mm, high_mm = kLargest_mm;
    for (int i = 0; i < 24; ++i) {
        const float middle_mm = 0.5f * (low_mm + high_mm);
        (hits(middle_mm) > rings ? low_mm : high_mm) = middle_mm;
    }
    crowns.least_mm = low_mm;
    return crowns;
}

// Takes splashes as they are found, those out of sight left out.
class Seen {
public:
    Seen(const Frame& frame, const FallingView& view, const std::vector<Light>& lamps)
        : view_(view), lamps_(lamps), slope_(0.5f * static_cast<float>(view.size.x) * (1.0f + std::abs(view.shift.x)) / view.focal_px),
          height_m_(static_cast<double>(view.eye_m.y - kBelowEye_m)), time_s_(frame.settings.time_s)
    {
    }

    double time_s() const { return time_s_; }
    bool full() const { return splashes_.size() >= kMost; }
    // Whether it may be in the picture, whatever it falls on.
    bool may_show(double x, double z) const
    {
        const glm::vec3 from_eye = glm::vec3(x, height_m_, z) - view_.eye_m;
        const float ahead = glm::dot(from_eye, view_.forward) + kAround_m;
        return ahead >= 0.0f && std::abs(glm::dot(from_eye, view_.right)) <= ahead * slope_ + kAround_m;
    }
    void add(double x, double z, float age_s, float diameter_m)
    {
        shared::FallingSplash splash{};
        splash.above_m = glm::vec3(x, height_m_, z);
        splash.age_s = age_s;
        splash.diameter_m = diameter_m;
        splash.lamps = light_of(lamps_, splash.above_m, view_.eye_m, true);
        splashes_.push_back(splash);
    }
    std::vector<shared::FallingSplash> take() { return std::move(splashes_); }

private:
    const FallingView& view_;
    const std::vector<Light>& lamps_;
    float slope_;
    double height_m_, time_s_;
    std::vector<shared::FallingSplash> splashes_;
};

// Crowns over rings that begin: the map of rings knows a few of them, at every repeat of it.
void add_over_rings(Seen& seen, const Frame& frame, const FallingView& view, const RingCrowns& crowns, float mean_mm)
{
    const auto tiling = static_cast<double>(frame.look.ripple_tiling);
    const double reach = static_cast<double>(shared::kSplashReach_m);
    const std::uint32_t seed = mixed(shared::hash_u(frame.falling.seed), 256);
    const auto time_s = static_cast<float>(seen.time_s());
    for (int layer = 0; layer < shared::kRippleLayers; ++layer) {
        const float share = crowns.share[static_cast<std::size_t>(layer)];
        if (!(share > 0.0f)) continue;
        const float period_s = 1.0f / (shared::kRippleBirths_per_s * frame.look.ripple_speed * shared::ripple_rate(layer));
        for (int n = 0; n < shared::kDropCells * shared::kDropCells; ++n) {
            const glm::ivec2 cell(n % shared::kDropCells, n / shared::kDropCells);
            const shared::RingBirth birth = shared::ring_birth(cell, layer, time_s, frame.look.ripple_speed);
            const float age_s = birth.age * period_s;
            if (age_s >= shared::kSplashLife_s) continue;
            const auto first = [&](float eye_m, float at) { return static_cast<int>(std::ceil((static_cast<double>(eye_m) - reach) * tiling - static_cast<double>(at))); };
            const auto last = [&](float eye_m, float at) { return static_cast<int>(std::floor((static_cast<double>(eye_m) + reach) * tiling - static_cast<double>(at))); };
            for (int i = first(view.eye_m.x, birth.place.x); i <= last(view.eye_m.x, birth.place.x); ++i) {
                for (int k = first(view.eye_m.z, birth.place.y); k <= last(view.eye_m.z, birth.place.y) && !seen.full(); ++k) {
                    const glm::ivec2 here = cell + shared::kDropCells * glm::ivec2(i, k);
                    if (shared::ring_chance(here, layer, birth.turn, seed) >= share) continue;
                    const double x = (static_cast<double>(birth.place.x) + i) / tiling, z = (static_cast<double>(birth.place.y) + k) / tiling;
                    if (!seen.may_show(x, z)) continue;
                    const float over_mm = -mean_mm * std::log(1.0f - 0.999f * shared::ring_chance(here, layer, birth.turn, seed + 8u));
                    seen.add(x, z, age_s, -std::min(crowns.least_mm + over_mm, kLargest_mm) * 1e-3f);
                }
            }
        }
    }
}

}  // namespace

std::vector<shared::FallingSplash> falling_splashes(const FallingPlan& plan, const Frame& frame,
                                                    const FallingView& view,
                                                    const std::vector<Light>& lamps)
{
    const float rate = std::min(frame.weather.rain_kg_m2_s * 3600.0f, 1000.0f);
    if (rate <= 0.0f || plan.drawn_reach_m <= 0.0f) return {};
    Seen seen(frame, view, lamps);
    const float mean_mm = 1.0f / shared::rain_slope_per_mm(rate);
    const RingCrowns crowns = ring_crowns(frame, rate);
    add_over_rings(seen, frame, view, crowns, mean_mm);
    const bool all = crowns.least_mm >= kLargest_mm;
    const float larger = all ? 0.0f : shared::rain_hits_per_m2_s(rate, crowns.least_mm);
    const double hits = static_cast<double>((shared::rain_hits_per_m2_s(rate, kSmallest_mm) - larger) * frame.falling.density);
    const double mean = std::clamp(hits * kCell_m * kCell_m * kSlot_s, 0.0, 100.0);
    // Of drops from the smallest to those that have rings.
    const float within = all ? 0.999f : 1.0f - std::exp((kSmallest_mm - crowns.least_mm) / mean_mm);
    const double time_s = seen.time_s();
    const auto slot = static_cast<std::int64_t>(std::floor(time_s / kSlot_s));
    const std::uint32_t seed = mixed(shared::hash_u(frame.falling.seed), 128);
    const double reach = static_cast<double>(shared::kSplashReach_m);
    const auto cell_of = [](double x) { return static_cast<std::int64_t>(std::floor(x / kCell_m)); };
    const double x0 = static_cast<double>(view.eye_m.x);
    const double z0 = static_cast<double>(view.eye_m.z);
    for (std::int64_t i = cell_of(x0 - reach); i <= cell_of(x0 + reach); ++i) {
        for (std::int64_t k = cell_of(z0 - reach); k <= cell_of(z0 + reach); ++k) {
            for (std::int64_t s = slot - 1; s <= slot; ++s) {
                const std::uint32_t here = mixed(mixed(mixed(seed, i), k), s);
                const int count = poisson(mean, static_cast<double>(Numbers(here).next()));
                for (int n = 0; n < count && !seen.full(); ++n) {
                    Numbers numbers(mixed(here, n + 1));
                    const double born =
                        (static_cast<double>(s) + static_cast<double>(numbers.next())) * kSlot_s;
                    const auto age_s = static_cast<float>(time_s - born);
                    if (age_s < 0.0f || age_s >= shared::kSplashLife_s) continue;
                    const double x =
                        (static_cast<double>(i) + static_cast<double>(numbers.next())) * kCell_m;
                    const double z =
                        (static_cast<double>(k) + static_cast<double>(numbers.next())) * kCell_m;
                    if (!seen.may_show(x, z)) continue;
                    const float size = kSmallest_mm - mean_mm * std::log(1.0f - within * numbers.next());
                    seen.add(x, z, age_s, std::min(size, kLargest_mm) * 1e-3f);
                }
            }
        }
    }
    return seen.take();
}

}  // namespace petrichor::gpu
