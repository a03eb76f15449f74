#include "gpu/passes/falling/splashes.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

std::vector<shared::FallingSplash> falling_splashes(const FallingPlan& plan, const Frame& frame,
                                                    const FallingView& view,
                                                    const std::vector<Light>& lamps)
{
    std::vector<shared::FallingSplash> splashes;
    const float rate = frame.weather.rain_kg_m2_s * 3600.0f;
    if (rate <= 0.0f || plan.drawn_reach_m <= 0.0f) return splashes;
    const double hits = static_cast<double>(
        shared::rain_hits_per_m2_s(std::min(rate, 1000.0f), kSmallest_mm) * frame.falling.density);
    const double mean = std::min(hits * kCell_m * kCell_m * kSlot_s, 100.0);
    const float mean_mm = 1.0f / shared::rain_slope_per_mm(rate);
    const double time_s = frame.settings.time_s;
    const auto slot = static_cast<std::int64_t>(std::floor(time_s / kSlot_s));
    const std::uint32_t seed = mixed(shared::hash_u(frame.falling.seed), 128);
    const float slope = 0.5f * static_cast<float>(view.size.x) * (1.0f + std::abs(view.shift.x)) / view.focal_px;
    const double reach = static_cast<double>(shared::kSplashReach_m);
    const auto cell_of = [](double x) { return static_cast<std::int64_t>(std::floor(x / kCell_m)); };
    const double x0 = static_cast<double>(view.eye_m.x);
    const double z0 = static_cast<double>(view.eye_m.z);
    for (std::int64_t i = cell_of(x0 - reach); i <= cell_of(x0 + reach); ++i) {
        for (std::int64_t k = cell_of(z0 - reach); k <= cell_of(z0 + reach); ++k) {
            for (std::int64_t s = slot - 1; s <= slot; ++s) {
                const std::uint32_t here = mixed(mixed(mixed(seed, i), k), s);
                const int count = poisson(mean, static_cast<double>(Numbers(here).next()));
                for (int n = 0; n < count && splashes.size() < kMost; ++n) {
                    Numbers numbers(mixed(here, n + 1));
                    const double born =
                        (static_cast<double>(s) + static_cast<double>(numbers.next())) * kSlot_s;
                    shared::FallingSplash splash{};
                    splash.age_s = static_cast<float>(time_s - born);
                    if (splash.age_s < 0.0f || splash.age_s >= shared::kSplashLife_s) continue;
                    const double x =
                        (static_cast<double>(i) + static_cast<double>(numbers.next())) * kCell_m;
                    const double z =
                        (static_cast<double>(k) + static_cast<double>(numbers.next())) * kCell_m;
                    splash.above_m = glm::vec3(x, static_cast<double>(view.eye_m.y - kBelowEye_m), z);
                    const glm::vec3 from_eye = splash.above_m - view.eye_m;
                    // Out of sight, whatever it falls on.
                    const float ahead = glm::dot(from_eye, view.forward) + kAround_m;
                    if (ahead < 0.0f ||
                        std::abs(glm::dot(from_eye, view.right)) > ahead * slope + kAround_m) {
                        continue;
                    }
                    const float size =
                        kSmallest_mm - mean_mm * std::log(1.0f - 0.999f * numbers.next());
                    splash.diameter_m = std::min(size, kLargest_mm) * 1e-3f;
                    splash.lamps = light_of(lamps, splash.above_m, view.eye_m, true);
                    splashes.push_back(splash);
                }
            }
        }
    }
    return splashes;
}

}  // namespace petrichor::gpu
