#include "texproc/prefilter/detail/chain_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "texproc/prefilter/detail/chain_fit_kernel.h"
#include "texproc/prefilter/detail/fit_lights.h"
#include "texproc/prefilter/detail/fit_pixels.h"
#include "texproc/prefilter/detail/two_lobe_start.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t kMostTexels = 256 * 256;
constexpr int kLeastSide = 8;
// Of a level: pixels drawn for each texel, of one lobe and of two, steps of a pass.
constexpr std::size_t kPixelsPerTexel = 30, kPixelsOfTwo = 60, kSteps = 250;
constexpr std::size_t kSlots = kFitSlots;
// Two fits in turn, the second from the first: bold, then careful, in which a picture that is worse
// than that of plain mips counts more, in full where it is worse by kClearlyWorse.
struct Stage {
    std::size_t passes;
    float first_rate, last_rate, worse;
};
constexpr Stage kBold{2, 0.003f, 0.00003f, 0.0f}, kCareful{2, 0.0015f, 0.00003f, 10.0f};
// Two lobes have farther to go, and those of metal a second fit to go on with.
constexpr Stage kBoldTwo{5, 0.006f, 0.00003f, 0.0f}, kBoldTwoMetal{3, 0.006f, 0.00003f, 0.0f};
constexpr float kClearlyWorse = 0.02f;
constexpr float kFlicker =
    0.5f;  // what changes between two moments counts so much beside all of the error
constexpr float kKeep = 0.9f, kKeepSquare = 0.99f;  // of Adam (Kingma & Ba 2015)
constexpr float kNothing2 = 3e-6f;                  // a mean square of errors that nobody sees
constexpr float kWorseMetal = 2.0f;
constexpr float kLeastLobe = 0.02f;  // the share of a lobe stays above: what has no part finds no way back

class ChainFit {
public:
    ChainFit(const Levels& plain, const PrefilterOptions& options, const Prefiltered& chain);
    bool worth() const { return last_ >= first_ && seen_; }
    void fit(const Stage& stage);
    void store(Prefiltered& chain) const;

private:
    bool is_fitted(std::size_t k) const { return k >= first_ && k <= last_; }
    bool two() const { return options_.lobes == 2; }
    FitLevel level(std::size_t k, FitSlope* slopes, FitLobe* second_slopes) const
    {
        return {plain_[k].width,
                plain_[k].height,
                texels_[k].data(),
                is_fitted(k) ? slopes : nullptr,
                two() ? second_[k].data() : nullptr,
                is_fitted(k) ? second_slopes : nullptr};
    }
    void start_two(std::size_t k);
    void draw();
    FitErrors errors(const FitPool& pool, const FitPicture& picture, bool plain) const;
    void weigh(FitPool& pool, const FitPicture& picture, float worse) const;
    void step(const FitPool& pool, const std::vector<std::size_t>& views, float rate);
    void move(std::size_t k, std::size_t slot_offset, std::size_t pixels, float rate);

    const Levels& plain_;
    const PrefilterOptions& options_;
    const std::size_t pixels_;  // of a view
    FitMeaning meaning_;
    std::vector<std::vector<FitTexel>> texels_, plain_texels_;
    std::vector<std::vector<FitLobe>> second_;  // with two lobes
    std::size_t first_ = 1, last_ = 0;  // levels that are fitted
    std::vector<FitPool> pools_;
    bool seen_ = false;  // plain mips are off somewhere
    const bool colors_metal_, colors_paint_;
    // Of Adam: means of slopes and of their squares, and steps, of a level.
    std::vector<std::vector<FitSlope>> mean_;
    std::vector<std::vector<FitSlope>> square_;
    std::vector<std::vector<FitLobe>> second_mean_, second_square_;
    std::vector<int> steps_;
    std::array<std::vector<FitSlope>, kSlots> slopes_;
    std::array<std::vector<FitLobe>, kSlots> second_slopes_;
};

ChainFit::ChainFit(const Levels& plain, const PrefilterOptions& options, const Prefiltered& chain)
    : plain_(plain),
      options_(options),
      pixels_(fit_layout(options.surface).pixels()),
      meaning_{options.smoothness, options.alpha},
      texels_(plain.size()),
      plain_texels_(plain.size()),
      second_(plain.size()),
      colors_metal_(!chain.metal_share.empty()),
      colors_paint_(options.lobes == 2 && options.base_colors),
      mean_(plain.size()),
      square_(plain.size()),
      second_mean_(plain.size()),
      second_square_(plain.size()),
      steps_(plain.size(), 0)
{
    const auto count = [&](std::size_t k) {
        return static_cast<std::size_t>(plain[k].width) * static_cast<std::size_t>(plain[k].height);
    };
    while (first_ < plain.size() && count(first_) > kMostTexels) ++first_;
    for (std::size_t k = first_; k < plain.size(); ++k)
        if (std::min(plain[k].width, plain[k].height) >= kLeastSide) last_ = k;
    if (last_ < first_) return;
    // The level above the finest of them is blended with it, and one below the coarsest.
    for (std::size_t k = first_ - 1; k <= std::min(last_ + 1, plain.size() - 1); ++k) {
        texels_[k].resize(count(k));
        plain_texels_[k].resize(count(k));
        for (std::size_t i = 0; i < texels_[k].size(); ++i) {
            const Texel t = plain[k].at(i);
            FitTexel& to = texels_[k][i];
            to = {{t.n.x, t.n.y, t.n.z}, t.stored, 1.0f, 1.0f, 0.5f, 0.0f};
            plain_texels_[k][i] = to;
            if (k == 0) continue;
            to.stored = chain.roughness[k].pixels[i];
            if (k < chain.base_share.size()) to.share = chain.base_share[k].pixels[i];
            if (k < chain.metal_share.size()) to.metal = chain.metal_share[k].pixels[i];
        }
        mean_[k].resize(k ? count(k) : 0);
        square_[k].resize(k ? count(k) : 0);
        if (two()) start_two(k);
    }
    draw();
}

// From two that are the same no slope would lead them apart. Levels that are not fitted keep such.
void ChainFit::start_two(std::size_t k)
{
    std::vector<FitTexel>& texels = texels_[k];
    second_mean_[k].resize(mean_[k].size());
    second_square_[k].resize(mean_[k].size());
    for (const FitTexel& t : texels) second_[k].push_back({{t.n[0], t.n[1], t.n[2]}, t.stored});
    if (!is_fitted(k)) return;
    std::vector<Texel> one;
    for (const FitTexel& t : texels) one.push_back({{t.n[0], t.n[1], t.n[2]}, t.stored});
    const std::vector<TwoLobeStart> starts = start_two_lobes(plain_, k, one, options_);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            texels[i].n[c] = starts[i].n[0][c];
            second_[k][i].n[c] = starts[i].n[1][c];
        }
        texels[i].stored = stored_value(starts[i].p[0], options_);
        second_[k][i].stored = stored_value(starts[i].p[1], options_);
        texels[i].of_second = std::clamp(starts[i].second, kLeastLobe, 1.0f - kLeastLobe);
    }
}

// A pool for each pair of levels of which one is fitted.
void ChainFit::draw()
{
    for (std::size_t number = 0; number < last_ - first_ + 2; ++number) {
        const std::size_t fine = first_ - 1 + number;
        // As many as the finest fitted level of the two has texels.
        const Level& size = plain_[std::max(fine, first_)];
        const std::size_t texels =
            static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
        const std::size_t enough = texels * (two() ? kPixelsOfTwo : kPixelsPerTexel) / (fine < first_ ? 2 : 1);
        FitPool& pool = pools_.emplace_back(draw_fit_pixels(plain_, options_, number, fine, enough));
        std::vector<char> off(pool.pictures.size(), 0);
        parallel_for(pool.pictures.size(), options_.threads, [&](std::size_t which) {
            FitPicture& picture = pool.pictures[which];
            picture.plain = errors(pool, picture, true);
            off[which] = std::any_of(picture.plain.squares.begin(), picture.plain.squares.end(),
                                     [](float squares) { return squares > 2.0f * kNothing2; });
            weigh(pool, picture, 0.0f);
        });
        seen_ |= std::find(off.begin(), off.end(), 1) != off.end();
    }
}

FitErrors ChainFit::errors(const FitPool& pool, const FitPicture& picture, bool plain) const
{
    const auto at = [&](std::size_t k) {
        return plain ? FitLevel{plain_[k].width, plain_[k].height, plain_texels_[k].data(), nullptr}
                     : level(k, nullptr, nullptr);
    };
    const FitLevel fine = at(pool.fine), coarse = at(std::min(pool.fine + 1, plain_.size() - 1));
    std::vector<float> light(pixels_ * kFitLights);
    FitErrors sums;
    for (const std::size_t v : picture.views) {
        const FitPixel* pixels = &pool.pixels[v * pixels_];
        chain_fit_kernel().seen(pool.views[v], meaning_, fine, coarse, pixels,
                                static_cast<int>(pixels_), light.data());
        for (std::size_t i = 0; i < pixels_; i += kFitFrames) {
            for (std::size_t l = 0; l < kFitLights; ++l) {
                float sum = 0.0f, squares = 0.0f;
                for (std::size_t f = i; f < i + kFitFrames; ++f) {
                    const float error = std::sqrt(std::min(light[f * kFitLights + l], 1.0f)) -
                                        static_cast<float>(pixels[f].shown[l]) * (1.0f / 65535.0f);
                    sum += error;
                    squares += error * error;
                }
                sums.squares[l] += squares;
                sums.changes[l] += std::max(squares - sum * sum * (1.0f / kFitFrames), 0.0f);
            }
        }
    }
    const float count = static_cast<float>(pixels_ * picture.views.size());
    for (std::array<float, kFitLights>* all : {&sums.squares, &sums.changes})
        for (float& sum : *all) sum = sum / count + kNothing2;
    return sums;
}

// FitErrors count relative to those of plain mips: the slope of their ratio, not of its square, so
// that a light in which little is left to gain is not given up for one in which much is lost.
// worse: how much more a picture counts that is worse than that of plain mips.
void ChainFit::weigh(FitPool& pool, const FitPicture& picture, float worse) const
{
    const FitErrors now = errors(pool, picture, false);
    for (std::size_t l = 0; l < kFitLights; ++l) {
        const float plain = picture.plain.squares[l], ratio = std::sqrt(now.squares[l] / plain);
        float weight = 1.0f / std::sqrt(plain * now.squares[l]);
        weight *= 1.0f + worse * std::clamp((ratio - 1.0f) / kClearlyWorse, 0.0f, 1.0f);
        const float flicker = kFlicker / std::sqrt(picture.plain.changes[l] * now.changes[l]);
        for (const std::size_t v : picture.views) {
            FitView& view = pool.views[v];
            // One lobe cannot be wide enough ahead and narrow enough behind: what step 2 made worse
            // on metal comes first.
            const bool first = view.lights.f0_metal[l] > 0.0f && ratio > 1.0f;
            view.weight[l] = first && !(worse > 0.0f) ? kWorseMetal * weight : weight;
            view.flicker[l] = flicker;
        }
    }
}

void ChainFit::move(std::size_t k, std::size_t slot_offset, std::size_t pixels, float rate)
{
    if (k < first_ || k > last_) return;
    ++steps_[k];
    const float n = static_cast<float>(steps_[k]);
    const float full = 1.0f - portable_pow(kKeep, n),
                full_square = 1.0f - portable_pow(kKeepSquare, n);
    const float scale = static_cast<float>(texels_[k].size()) / static_cast<float>(pixels);
    constexpr std::size_t kBlock = 4096;
    const FitMove how{rate, scale, kKeep, kKeepSquare, full, full_square, kLeastLobe,
                      options_.joint, colors_metal_, two(), colors_paint_};
    parallel_for((texels_[k].size() + kBlock - 1) / kBlock, options_.threads, [&](std::size_t block) {
        const std::size_t first = block * kBlock, end = std::min(first + kBlock, texels_[k].size());
        FitMoved level{&texels_[k][first], &mean_[k][first], &square_[k][first], nullptr, nullptr, nullptr, {}, {}};
        if (two()) {
            level.second = &second_[k][first];
            level.second_mean = &second_mean_[k][first];
            level.second_square = &second_square_[k][first];
        }
        for (std::size_t slot = 0; slot < kSlots; ++slot) {
            level.slopes[slot] = &slopes_[slot][slot_offset + first];
            if (two()) level.second_slopes[slot] = &second_slopes_[slot][slot_offset + first];
        }
        chain_fit_kernel().move(how, level, static_cast<int>(end - first));
    });
}

void ChainFit::step(const FitPool& pool, const std::vector<std::size_t>& views, float rate)
{
    const std::size_t coarse = std::min(pool.fine + 1, plain_.size() - 1);
    const std::size_t offset = pool.fine < first_ ? 0 : texels_[pool.fine].size();
    parallel_for(std::min(kSlots, views.size()), options_.threads, [&](std::size_t slot) {
        FitSlope* const to = slopes_[slot].data();
        FitLobe* const second = two() ? second_slopes_[slot].data() : nullptr;
        for (std::size_t i = slot; i < views.size(); i += kSlots)
            chain_fit_kernel().add_slopes(
                pool.views[views[i]], meaning_, level(pool.fine, to, second),
                level(coarse, to + offset, second ? second + offset : nullptr),
                &pool.pixels[views[i] * pixels_], static_cast<int>(pixels_));
    });
    move(pool.fine, 0, views.size() * pixels_, rate);
    if (coarse != pool.fine) move(coarse, offset, views.size() * pixels_, rate);
}

void ChainFit::fit(const Stage& stage)
{
    std::size_t most = 0;
    for (std::size_t k = first_; k <= last_; ++k)
        most = std::max(most, texels_[k].size() + (k < last_ ? texels_[k + 1].size() : 0));
    for (std::vector<FitSlope>& slot : slopes_) slot.assign(most, {});
    for (std::vector<FitLobe>& slot : second_slopes_) slot.assign(two() ? most : 0, {});
    // All steps of a pass in one order: levels by turns.
    struct Step {
        std::size_t pool, first, count;
    };
    std::vector<Step> steps;
    for (std::size_t i = 0; i < pools_.size(); ++i) {
        const std::size_t views = pools_[i].views.size(),
                          batch = std::max<std::size_t>(views / kSteps, 1);
        for (std::size_t v = 0; v < views; v += batch)
            steps.push_back({i, v, std::min(batch, views - v)});
    }
    FitDice dice(7);
    const auto shuffle = [&](auto& all) {
        for (std::size_t i = all.size(); i-- > 1;) std::swap(all[i], all[dice.whole() % (i + 1)]);
    };
    std::vector<std::size_t> views;
    const std::size_t total = steps.size() * stage.passes;
    for (std::size_t pass = 0, done = 0; pass < stage.passes; ++pass) {
        shuffle(steps);
        for (FitPool& pool : pools_) {
            // Weighed as it was drawn; where two lobes start, little is known of where they end.
            if (!(stage.worse > 0.0f) && (!two() || pass == 0)) break;
            parallel_for(pool.pictures.size(), options_.threads,
                         [&](std::size_t i) { weigh(pool, pool.pictures[i], stage.worse); });
        }
        for (const Step& s : steps) {
            views.resize(s.count);
            for (std::size_t i = 0; i < s.count; ++i) views[i] = s.first + i;
            const float share = static_cast<float>(done++) / static_cast<float>(total);
            step(pools_[s.pool], views,
                 stage.first_rate + (stage.last_rate - stage.first_rate) * share);
        }
    }
}

void ChainFit::store(Prefiltered& chain) const
{
    const auto store_normal = [&](const float* n, float* to) {
        to[0] = 0.5f + 0.5f * n[0];
        to[1] = 0.5f + 0.5f * (options_.green_down ? -n[1] : n[1]);
        to[2] = 0.5f + 0.5f * n[2];
    };
    for (std::size_t k = first_; k <= last_; ++k) {
        for (std::size_t i = 0; i < texels_[k].size(); ++i) {
            const FitTexel& t = texels_[k][i];
            chain.roughness[k].pixels[i] = t.stored;
            if (!options_.joint) continue;
            if (colors_metal_) chain.metal_share[k].pixels[i] = t.metal;
            store_normal(t.n, &chain.normal[k].pixels[3 * i]);
            if (!two()) continue;
            store_normal(second_[k][i].n, &chain.second.normal[k].pixels[3 * i]);
            chain.second.roughness[k].pixels[i] = second_[k][i].stored;
            chain.second.share[k].pixels[i] = t.of_second;
            if (colors_paint_) chain.base_share[k].pixels[i] = t.share;
        }
    }
}

}  // namespace

bool is_fitted(int width, int height)
{
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) <= kMostTexels &&
           std::min(width, height) >= kLeastSide;
}

bool fit_chain(const Levels& plain, const PrefilterOptions& options, Prefiltered& chain,
               const std::function<void()>& bold)
{
    ChainFit fit(plain, options, chain);
    if (!fit.worth()) return false;
    const bool metal = options.surface == SurfaceClass::Metal;
    fit.fit(options.lobes != 2 ? kBold : metal ? kBoldTwoMetal : kBoldTwo);
    fit.store(chain);
    if (!metal) return true;
    if (bold) bold();
    fit.fit(kCareful);
    fit.store(chain);
    return true;
}

}  // namespace petrichor::texproc::detail
