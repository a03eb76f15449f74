#include "texproc/prefilter/detail/picture_settle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "texproc/prefilter/detail/lit_floor.h"
#include "texproc/prefilter/picture.h"

namespace petrichor::texproc::detail {

namespace {

// Shares of what was fitted, and of the darkening of the base colour.
constexpr float kShares[] = {1.3f, 1.0f, 0.75f, 0.5f, 0.25f, 0.0f};
constexpr float kDark[] = {1.0f, 0.5f, 0.0f};
constexpr double kFlickerWeight = 0.6;
// What a case costs that is worse than plain mips, beside its part of the mean. Fewer would let one
// picture pay for the gain of another.
constexpr double kWorse = 10.0, kWorseFlicker = 1.0, kWithin = 0.005;
// The same of quick, whose few pictures are let pay for each other: by squares.
constexpr double kWorseSquare = 10.0, kWorseFlickerSquare = 3.0;
constexpr double kNothing = 3e-4;  // an error that nobody sees has no ratio
constexpr double kClear = 1e-3;    // a smaller gain changes nothing
constexpr int kSweeps = 2;

// 0 for plain mips, below it where the pictures are better.
double cost_of(const std::vector<PictureScore>& scores, const std::vector<PictureScore>& plain,
               bool quick)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const double rmse = (scores[i].rmse + kNothing) / (plain[i].rmse + kNothing) - 1.0;
        const double flicker = (scores[i].flicker + kNothing) / (plain[i].flicker + kNothing) - 1.0;
        sum += rmse + kFlickerWeight * flicker;
        if (quick) {
            const double above = std::max(rmse, 0.0), livelier = std::max(flicker, 0.0);
            sum += kWorseSquare * above * above + kWorseFlickerSquare * livelier * livelier;
        } else {
            sum += kWorse * std::max(rmse - kWithin, 0.0) +
                   kWorseFlicker * std::max(flicker - kWithin, 0.0);
        }
    }
    return sum / static_cast<double>(scores.size());
}

// Levels that may stand in for each other. A pixel blends several texels and is shaded once, so what
// its normals lose between its texels has to be in its roughness as well: a level may take that of
// the larger footprints one or two levels above.
struct Candidate {
    enum Source { Fitted, Median, Plain } of;
    std::size_t above;
};
std::vector<Candidate> quick_candidates()
{
    return {{Candidate::Fitted, 0}};
}
std::vector<Candidate> all_candidates()
{
    return {{Candidate::Fitted, 0}, {Candidate::Fitted, 1}, {Candidate::Fitted, 2},
            {Candidate::Median, 0}, {Candidate::Median, 1}, {Candidate::Median, 2},
            {Candidate::Plain, 1}};
}

// Each level from the one so far above it, between its texels.
std::vector<Image> from_above(const std::vector<Image>& levels, std::size_t above)
{
    if (above == 0) return levels;
    std::vector<Image> to(1);
    for (std::size_t k = 1; k < levels.size(); ++k) {
        const Image& from = levels[std::min(k + above, levels.size() - 1)];
        Image& level =
            to.emplace_back(levels[k].width, levels[k].height, 1, ColorSpace::Data, 0.0f);
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x) {
                float sum = 0.0f;
                bilinear(from.width, from.height, (x + 0.5) / level.width, (y + 0.5) / level.height,
                         1.0f, [&](std::size_t i, float w) { sum += w * from.pixels[i]; });
                level.at(x, y, 0) = sum;
            }
    }
    return to;
}

}  // namespace

void settle_picture(const MapSurface& surface, const PrefilterOptions& options,
                    const std::vector<Image>& median, Prefiltered& chain)
{
    const std::size_t levels = chain.roughness.size();
    if (levels < 2) return;
    PictureOptions pictures = design_pictures(options.quick);
    pictures.threads = options.threads;
    const PictureBench bench(surface, options, pictures);
    const std::vector<Image> plain = bench.plain_roughness();
    const std::vector<Candidate> candidates = options.quick ? quick_candidates() : all_candidates();
    const auto candidate = [&](std::size_t which) {
        const Candidate& c = candidates[which];
        return from_above(c.of == Candidate::Plain    ? plain
                          : c.of == Candidate::Median ? median
                                                      : chain.roughness,
                          c.above);
    };
    PictureBench::Blend blend(bench, candidates.size(), candidate, chain.base_share);
    using Shares = PictureBench::Blend::Shares;
    const auto alike = [&](std::size_t which, float share, float dark) {
        return Shares{std::vector<float>(levels, share), std::vector<float>(levels, dark),
                      std::vector<std::size_t>(levels, which)};
    };
    const std::vector<PictureScore> plain_scores = blend.score(alike(0, 0.0f, 0.0f));
    // What was fitted stays where the pictures say nothing: levels that they do not show.
    Shares best = alike(0, 1.0f, 1.0f);
    double least = cost_of(blend.score(best), plain_scores, options.quick);
    const auto attempt = [&](const Shares& shares) {
        const double cost = cost_of(blend.score(shares), plain_scores, options.quick);
        if (!(cost < least - kClear)) return;
        least = cost;
        best = shares;
    };
    // All levels alike first, then one by one, the coarsest first.
    for (std::size_t which = 0; which < candidates.size(); ++which)
        for (const float share : kShares)
            if (!options.quick || share <= 1.0f) attempt(alike(which, share, 1.0f));
    for (const float dark : kDark) {
        Shares shares = best;
        shares.base.assign(levels, dark);
        if (!options.quick && dark != 1.0f) attempt(shares);
    }
    for (int sweep = 0; sweep < kSweeps && !options.quick; ++sweep) {
        const double before = least;
        for (std::size_t k = levels; k-- > 1;) {
            for (std::size_t which = 0; which < candidates.size(); ++which)
                for (const float share : kShares) {
                    Shares shares = best;
                    shares.which[k] = which;
                    shares.roughness[k] = share;
                    if (share != best.roughness[k] || (share > 0.0f && which != best.which[k]))
                        attempt(shares);
                }
            for (const float dark : kDark) {
                Shares shares = best;
                shares.base[k] = dark;
                if (dark != best.base[k]) attempt(shares);
            }
        }
        if (least > before - kClear) break;
    }
    std::vector<std::vector<Image>> taken(candidates.size());
    for (std::size_t k = 1; k < levels; ++k)
        if (taken[best.which[k]].empty()) taken[best.which[k]] = candidate(best.which[k]);
    for (std::size_t k = 1; k < levels; ++k) {
        const Image& from = taken[best.which[k]][k];
        for (std::size_t i = 0; i < chain.roughness[k].pixels.size(); ++i) {
            const float mip = plain[k].pixels[i];
            chain.roughness[k].pixels[i] =
                std::clamp(mip + best.roughness[k] * (from.pixels[i] - mip), 0.0f, 1.0f);
            float& share = chain.base_share[k].pixels[i];
            share = 1.0f + best.base[k] * (share - 1.0f);
        }
    }
}

}  // namespace petrichor::texproc::detail
