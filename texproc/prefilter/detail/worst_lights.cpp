#include "texproc/prefilter/detail/worst_lights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "texproc/prefilter/detail/picture_cost.h"

namespace petrichor::texproc::detail {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// Where plain mips are right by chance is some ten degrees wide.
constexpr double kApart = 7.0, kLowest = 19.0, kHighest = 60.0, kJitter = 3.0;
constexpr int kWindows = 12;
constexpr double kWindowsWide = 40.0;
// One look at few samples is enough to find them: what comes back is looked at as closely as the floors.
constexpr int kFrames = 1, kSamples = 8;
constexpr std::size_t kMost = 24;
constexpr double kNear = 5.0;         // degrees
constexpr double kClearGain = -0.03;  // in the mean of the views
constexpr float kMetalSky = 0.1f;

}  // namespace

PictureOptions worst_lights(const PictureBench& of_maps, const PictureOptions& floors, const PrefilterOptions& options,
                            const Prefiltered& chain, std::uint32_t seed)
{
    std::mt19937 dice(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(dice()) / 4294967296.0;
    };
    // Views of large pixels stand for levels that no other shows: what is lost there is a price, not the worst.
    double least = 1.0;
    for (const PictureView& view : floors.views) least = std::min(least, view.covers);
    std::vector<int> views;
    for (std::size_t v = 0; v < floors.views.size(); ++v)
        if (floors.views[v].covers == least) views.push_back(static_cast<int>(v));

    PictureOptions pool = floors;
    pool.lights.clear();
    pool.cases.clear();
    pool.frames = kFrames;
    pool.samples = kSamples;
    pool.seed = seed;
    const auto add = [&](double around, double up, double alpha) {
        for (const bool metal : {false, true}) {
            if (options.surface == (metal ? SurfaceClass::Paint : SurfaceClass::Metal) || (metal && alpha > 0.0)) continue;
            const std::size_t light = pool.lights.size();
            for (std::size_t i = 0; i < kHeldOutViews; ++i)
                pool.cases.push_back({views[(7 * light + 5 * i) % views.size()], static_cast<int>(light), metal});
            pool.lights.push_back({.name = "sought " + std::to_string(light + 1),
                                   .to_light = {static_cast<float>(std::sin(around) * std::cos(up)),
                                                static_cast<float>(std::cos(around) * std::cos(up)),
                                                static_cast<float>(std::sin(up))},
                                   .alpha = static_cast<float>(alpha),
                                   .sky = metal ? kMetalSky : 0.0f});
        }
    };
    for (double up = kLowest + between(0.0, kJitter); up < kHighest; up += kApart) {
        const int round = static_cast<int>(360.0 * std::cos(up * kDegree) / kApart);
        const double first = between(0.0, 1.0);
        for (int i = 0; i < round; ++i) add((i + first) * 2.0 * std::numbers::pi / round, up * kDegree, 0.0);
    }
    for (int i = 0; i < kWindows; ++i) {
        const double around = between(-kWindowsWide, kWindowsWide) * kDegree, up = between(16.0, 36.0) * kDegree;
        add(around, up, between(0.08, 0.14));
    }

    const PictureBench bench(of_maps, pool);
    const std::vector<PictureScore> plain = bench.score({}), scores = bench.score(chain);
    std::vector<std::pair<double, std::size_t>> worst;
    for (std::size_t light = 0; light < pool.lights.size(); ++light) {
        double change = 0.0;
        for (std::size_t i = light * kHeldOutViews; i < (light + 1) * kHeldOutViews; ++i)
            change += change_of(scores[i].rmse, plain[i].rmse) / kHeldOutViews;
        if (change > kClearGain) worst.emplace_back(change, light);
    }
    std::stable_sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.first > b.first; });

    PictureOptions found = floors;
    found.lights.clear();
    found.cases.clear();
    found.seed = seed + 1;
    std::vector<bool> of_metal;
    for (const auto& [change, light] : worst) {
        if (found.lights.size() >= kMost) break;
        const PictureLight& here = pool.lights[light];
        const bool metal = pool.cases[light * kHeldOutViews].metal;
        bool near = false;
        for (std::size_t i = 0; i < found.lights.size(); ++i) {
            const PictureLight& other = found.lights[i];
            double cosine = 0.0;
            for (std::size_t c = 0; c < 3; ++c) cosine += static_cast<double>(here.to_light[c] * other.to_light[c]);
            const bool alike = metal == of_metal[i] && (here.alpha > 0.0f) == (other.alpha > 0.0f);
            near |= alike && cosine > std::cos(kNear * kDegree);
        }
        if (near) continue;
        for (std::size_t i = 0; i < kHeldOutViews; ++i) {
            PictureCase seen = pool.cases[light * kHeldOutViews + i];
            seen.light = static_cast<int>(found.lights.size());
            found.cases.push_back(seen);
        }
        found.lights.push_back(here);
        of_metal.push_back(metal);
    }
    return found;
}

}  // namespace petrichor::texproc::detail
