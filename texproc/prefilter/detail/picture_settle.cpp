#include "texproc/prefilter/detail/picture_settle.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "texproc/prefilter/detail/fit_settle.h"
#include "texproc/prefilter/detail/picture_cost.h"
#include "texproc/prefilter/picture.h"

namespace petrichor::texproc::detail {

namespace {

// Shares of what was fitted, and of the darkening of the base colour.
constexpr float kShares[] = {1.3f, 1.0f, 0.75f, 0.5f, 0.25f, 0.0f};
constexpr float kDark[] = {1.0f, 0.5f, 0.0f};
// A picture that is worse than plain mips: quick lets its few pay for each other, by squares.
constexpr double kWorseSquare = 10.0, kWorseFlickerSquare = 3.0;
constexpr double kClear = 1e-3;    // a smaller gain changes nothing
constexpr int kSweeps = 2;

double look_cost(const std::vector<PictureScore>& scores, const std::vector<PictureScore>& plain,
                 bool quick)
{
    if (!quick) return cost_of(scores, plain);
    double sum = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const double rmse = (scores[i].rmse + kNothing) / (plain[i].rmse + kNothing) - 1.0;
        const double flicker = (scores[i].flicker + kNothing) / (plain[i].flicker + kNothing) - 1.0;
        const double above = std::max(rmse, 0.0), livelier = std::max(flicker, 0.0);
        sum += rmse + kFlickerWeight * flicker + kWorseSquare * above * above +
               kWorseFlickerSquare * livelier * livelier;
    }
    return sum / static_cast<double>(scores.size());
}

}  // namespace

void settle_picture(const MapSurface& surface, const PrefilterOptions& options, Prefiltered& chain)
{
    const std::size_t levels = chain.roughness.size();
    if (levels < 2) return;
    PictureOptions pictures = design_pictures(options.quick, options.surface);
    pictures.threads = options.threads;
    const PictureBench bench(surface, options, pictures);
    PictureBench::Blend blend(bench, chain);
    using Shares = PictureBench::Blend::Shares;
    const auto alike = [&](float share, float dark) {
        return Shares{std::vector<float>(levels, share), std::vector<float>(levels, dark)};
    };
    const std::vector<PictureScore> plain_scores = blend.score(alike(0.0f, 0.0f));
    // What was fitted stays where the pictures say nothing: levels that they do not show.
    Shares best = alike(1.0f, 1.0f);
    double least = look_cost(blend.score(best), plain_scores, options.quick);
    const auto attempt = [&](const Shares& shares) {
        const double cost = look_cost(blend.score(shares), plain_scores, options.quick);
        if (!(cost < least - kClear)) return;
        least = cost;
        best = shares;
    };
    const bool paint = options.quick || options.surface != SurfaceClass::Metal;
    // All levels alike first, then one by one, the coarsest first.
    for (const float dark : kDark) {
        if ((options.quick || !paint) && dark < 1.0f) break;
        for (const float share : kShares)
            if (!options.quick || share <= 1.0f) attempt(alike(share, dark));
    }
    for (int sweep = 0; sweep < kSweeps && !options.quick; ++sweep) {
        const double before = least;
        for (std::size_t k = levels; k-- > 1;) {
            for (const float share : kShares) {
                Shares shares = best;
                shares.roughness[k] = share;
                if (share != best.roughness[k]) attempt(shares);
            }
            for (const float dark : kDark) {
                if (!paint) break;  // metal does not show it
                Shares shares = best;
                shares.base[k] = dark;
                if (dark != best.base[k]) attempt(shares);
            }
        }
        if (least > before - kClear) break;
    }
    const std::vector<Image> plain = bench.plain_roughness();
    for (std::size_t k = 1; k < levels; ++k) {
        for (std::size_t i = 0; i < chain.roughness[k].pixels.size(); ++i) {
            float& p = chain.roughness[k].pixels[i];
            p = std::clamp(plain[k].pixels[i] + best.roughness[k] * (p - plain[k].pixels[i]), 0.0f,
                           1.0f);
            float& share = chain.base_share[k].pixels[i];
            share = 1.0f + best.base[k] * (share - 1.0f);
        }
    }
    if (!options.quick) settle_fit(bench, options, chain);
}

}  // namespace petrichor::texproc::detail
