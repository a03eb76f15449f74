#include "texproc/prefilter/stored_guard.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace petrichor::texproc {

namespace {

bool is_worse(const PictureScore& score, const PictureScore& plain)
{
    return score.rmse > plain.rmse || score.flicker > plain.flicker;
}

// How far a score is above plain, in shares of it.
double excess(const PictureScore& score, const PictureScore& plain)
{
    constexpr double kNothing = 1e-9;  // a picture without error has no ratio
    return std::max(score.rmse / (plain.rmse + kNothing) - 1.0, 0.0) +
           std::max(score.flicker / (plain.flicker + kNothing) - 1.0, 0.0);
}

}  // namespace

PictureOptions build_pictures(int threads, SurfaceClass surface)
{
    PictureOptions pictures = reference_pictures();
    pictures.frames = 2;
    pictures.samples = 8;
    pictures.threads = threads;
    if (surface != SurfaceClass::Both) {
        std::erase_if(pictures.cases, [](const PictureCase& c) { return c.metal; });
        for (PictureCase& c : pictures.cases) c.metal = surface == SurfaceClass::Metal;
    }
    return pictures;
}

PictureScore mean_score(const std::vector<PictureScore>& scores)
{
    PictureScore sum;
    for (const PictureScore& score : scores) {
        sum.rmse += score.rmse / static_cast<double>(scores.size());
        sum.flicker += score.flicker / static_cast<double>(scores.size());
    }
    return sum;
}

StoredGuard guard_stored(const PictureBench& bench, const Prefiltered& ours,
                         const std::vector<Image>& plain)
{
    StoredGuard guard;
    const auto score = [&](const Prefiltered& chain) { return mean_score(bench.score(chain)); };
    guard.plain_score = score({ours.normal, plain, {}, {}, {}});
    Prefiltered chain = ours;
    guard.score = score(chain);
    if (!is_worse(guard.score, guard.plain_score)) return guard;

    const std::size_t levels = std::min(ours.roughness.size(), plain.size());
    // With the roughness of a level its second lobe goes.
    const auto set_plain = [&](std::size_t k, bool is_plain) {
        chain.roughness[k] = is_plain ? plain[k] : ours.roughness[k];
        if (k >= ours.second.share.size()) return;
        for (auto part : {&SecondLobe::normal, &SecondLobe::roughness, &SecondLobe::share}) {
            Image& level = (chain.second.*part)[k];
            level = is_plain ? Image() : (ours.second.*part)[k];
        }
    };
    std::vector<std::pair<double, std::size_t>> costs;  // with one level plain
    for (std::size_t k = 1; k < levels; ++k) {
        if (ours.roughness[k].empty() || plain[k].empty()) continue;
        set_plain(k, true);
        costs.emplace_back(excess(score(chain), guard.plain_score), k);
        set_plain(k, false);
    }
    std::sort(costs.begin(), costs.end());
    guard.plain.assign(levels, 0);
    for (const auto& [cost, k] : costs) {
        set_plain(k, true);
        guard.plain[k] = 1;
        guard.score = score(chain);
        if (!is_worse(guard.score, guard.plain_score)) return guard;
    }
    // All are plain, and still worse: it is the base colour. Without it the levels may stay.
    guard.darken = false;
    chain.base_share.clear();
    chain.metal_share.clear();
    chain.roughness = ours.roughness;
    chain.second = ours.second;
    guard.score = score(chain);
    if (!is_worse(guard.score, guard.plain_score)) {
        guard.plain.clear();
    } else {
        guard.score = guard.plain_score;
    }
    return guard;
}

}  // namespace petrichor::texproc
