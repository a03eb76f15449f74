#include "texproc/prefilter/detail/picture_settle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "texproc/prefilter/picture.h"

namespace petrichor::texproc::detail {

namespace {

constexpr float kShares[] = {1.0f, 0.75f, 0.5f, 0.25f, 0.0f};
constexpr double kFlickerWeight = 0.3;
// What a case costs that is worse than plain mips, beside its mean error.
constexpr double kWorse = 10.0, kWorseFlicker = 3.0;
constexpr double kClear = 1e-3;  // a smaller gain changes nothing

// Below 0 where the pictures are better than those of plain mips.
double cost_of(const std::vector<PictureScore>& scores, const std::vector<PictureScore>& plain)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        constexpr double kNothing = 1e-5;  // a picture without error has no ratio
        const double rmse = (scores[i].rmse + kNothing) / (plain[i].rmse + kNothing);
        const double flicker = (scores[i].flicker + kNothing) / (plain[i].flicker + kNothing);
        const double above = std::max(rmse - 1.0, 0.0), livelier = std::max(flicker - 1.0, 0.0);
        sum += (rmse - 1.0) + kFlickerWeight * (flicker - 1.0) + kWorse * above * above +
               kWorseFlicker * livelier * livelier;
    }
    return sum / static_cast<double>(scores.size());
}

void mix(std::vector<Image>& to, const std::vector<Image>& from, const std::vector<Image>& with,
         float share)
{
    for (std::size_t k = 1; k < to.size(); ++k)
        for (std::size_t i = 0; i < to[k].pixels.size(); ++i)
            to[k].pixels[i] = from[k].pixels[i] + share * (with[k].pixels[i] - from[k].pixels[i]);
}

}  // namespace

void settle_picture(const MapSurface& surface, const PrefilterOptions& options, Prefiltered& chain)
{
    if (chain.roughness.size() < 2) return;
    PictureOptions pictures = design_pictures();
    pictures.threads = options.threads;
    if (options.quick) pictures.samples = 5;
    const PictureBench bench(surface, options, pictures);
    const std::vector<PictureScore> plain_scores = bench.score({});
    const std::vector<Image> plain = bench.plain_roughness();
    const std::vector<Image> fitted = chain.roughness;
    double least = 0.0;
    float best = -1.0f;
    for (const float share : kShares) {
        mix(chain.roughness, plain, fitted, share);
        const double cost = cost_of(bench.score(chain), plain_scores);
        if (best >= 0.0f && cost > least - kClear) continue;
        least = cost;
        best = share;
    }
    mix(chain.roughness, plain, fitted, best);
}

}  // namespace petrichor::texproc::detail
