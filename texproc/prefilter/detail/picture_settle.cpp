#include "texproc/prefilter/detail/picture_settle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "texproc/prefilter/detail/chain_fit.h"
#include "texproc/prefilter/picture.h"

namespace petrichor::texproc::detail {

namespace {

// Shares of what was fitted, and of the darkening of the base colour.
constexpr float kShares[] = {1.3f, 1.0f, 0.75f, 0.5f, 0.25f, 0.0f};
constexpr float kDark[] = {1.0f, 0.5f, 0.0f};
constexpr float kFitted[] = {1.0f, 0.75f, 0.5f, 0.25f, 0.12f};
constexpr float kFittedLevel[] = {1.0f, 0.75f, 0.5f, 0.25f, 0.0f}, kFewer[] = {1.0f, 0.5f, 0.0f};
constexpr double kFlickerWeight = 0.3;
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

// A level between two: 0 the first, 1 the second.
void mix(const Image& from, const Image& to, float share, Image& mixed)
{
    for (std::size_t i = 0; i < mixed.pixels.size(); ++i)
        mixed.pixels[i] = from.pixels[i] + share * (to.pixels[i] - from.pixels[i]);
    if (mixed.channels < 3) return;
    for (std::size_t i = 0; i < mixed.pixels.size(); i += 3) {  // normals, made unit length again
        float* code = &mixed.pixels[i];
        float squares = 0.0f;
        for (int c = 0; c < 3; ++c) squares += (2.0f * code[c] - 1.0f) * (2.0f * code[c] - 1.0f);
        const float scale = 1.0f / std::sqrt(std::max(squares, 1e-12f));
        for (int c = 0; c < 3; ++c) code[c] = 0.5f + scale * (code[c] - 0.5f);
    }
}

// Fits all texels to pixels, and keeps that share of it with which the pictures are best.
void settle_fit(const PictureBench& bench, const std::vector<PictureScore>& plain,
                const PrefilterOptions& options, Prefiltered& chain)
{
    // Levels that are fitted, which are small, before and after.
    const std::size_t levels = chain.roughness.size();
    if (options.joint && options.metal_colors && options.surface != SurfaceClass::Paint) {
        chain.metal_share.resize(levels);
        for (std::size_t k = 1; k < levels; ++k)
            chain.metal_share[k] = Image(chain.roughness[k].width, chain.roughness[k].height, 1,
                                         ColorSpace::Data, 1.0f);
    }
    if (options.lobes == 2) {
        chain.second = {chain.normal, chain.roughness, std::vector<Image>(levels)};
        chain.second.normal[0] = chain.second.roughness[0] = Image();
        for (std::size_t k = 1; k < levels; ++k)
            chain.second.share[k] = Image(chain.roughness[k].width, chain.roughness[k].height, 1,
                                          ColorSpace::Data, 0.5f);
    }
    const bool colors_metal = !chain.metal_share.empty();
    // Of each level: which of the fits, how much of it, and how much of its colour of metal.
    struct Share {
        std::size_t fit;
        float fitted, metal;
        bool operator==(const Share&) const = default;
    };
    using Shares = std::vector<Share>;
    constexpr std::size_t kParts = 6, kMetal = 2;
    const std::array<std::vector<Image>*, kParts> parts{
        &chain.roughness,     &chain.normal,           &chain.metal_share,
        &chain.second.normal, &chain.second.roughness, &chain.second.share};
    using Kept = std::vector<std::array<Image, kParts>>;
    const auto kept = [&] {
        Kept all(levels);
        for (std::size_t k = 1; k < levels; ++k) {
            if (!is_fitted(chain.roughness[k].width, chain.roughness[k].height)) continue;
            for (std::size_t i = 0; i < kParts; ++i)
                if (k < parts[i]->size()) all[k][i] = (*parts[i])[k];
        }
        return all;
    };
    const Kept before = kept();
    double least = cost_of(bench.score(chain), plain, false);
    std::vector<Kept> after;
    if (!fit_chain(bench.levels(), options, chain, [&] { after.push_back(kept()); })) return;
    after.push_back(kept());
    Shares best(levels, {0, 0.0f, 0.0f}), now(levels, {after.size() - 1, 1.0f, 1.0f});
    const auto show = [&](const Shares& shares) {
        for (std::size_t k = 1; k < levels; ++k) {
            if (before[k][0].empty() || shares[k] == now[k]) continue;
            for (std::size_t i = 0; i < kParts; ++i)
                if (k < parts[i]->size())
                    mix(before[k][i], after[shares[k].fit][k][i],
                        i == kMetal ? shares[k].metal : shares[k].fitted, (*parts[i])[k]);
        }
        now = shares;
    };
    const auto attempt = [&](const Shares& shares) {
        show(shares);
        const double cost = cost_of(bench.score(chain), plain, false);
        if (!(cost < least - kClear)) return;
        least = cost;
        best = shares;
    };
    const bool thorough = options.surface == SurfaceClass::Metal;
    const std::span<const float> of_level = thorough ? std::span<const float>(kFittedLevel) : kFewer;
    for (std::size_t fit = 0; fit < after.size(); ++fit)
        for (const float share : kFitted)
            if (thorough || share >= 0.25f) attempt(Shares(levels, {fit, share, share}));
    for (int sweep = 0; sweep < (thorough ? kSweeps : 1); ++sweep) {
        const double at_first = least;
        for (std::size_t k = levels; k-- > 1;) {
            if (before[k][0].empty()) continue;
            const auto change = [&](const Share& share) {
                Shares shares = best;
                shares[k] = share;
                if (!(share == best[k])) attempt(shares);
            };
            for (std::size_t fit = 0; fit < after.size(); ++fit)
                for (const float share : of_level) change({fit, share, best[k].metal});
            for (const float share : of_level)
                if (colors_metal) change({best[k].fit, best[k].fitted, share});
        }
        if (least > at_first - kClear) break;
    }
    show(best);
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
    double least = cost_of(blend.score(best), plain_scores, options.quick);
    const auto attempt = [&](const Shares& shares) {
        const double cost = cost_of(blend.score(shares), plain_scores, options.quick);
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
    if (!options.quick) settle_fit(bench, plain_scores, options, chain);
}

}  // namespace petrichor::texproc::detail
