#include "texproc/prefilter/detail/second_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/hash.h"
#include "texproc/prefilter/detail/chain_fit.h"
#include "texproc/prefilter/detail/fit_parts.h"
#include "texproc/prefilter/detail/look_price.h"
#include "texproc/prefilter/detail/picture_cost.h"

namespace petrichor::texproc::detail {

namespace {

constexpr double kClear = 1e-3;  // a smaller gain changes nothing
constexpr int kRounds = 5;
constexpr float kFarthest = 4.0f;                 // so many steps of a number in a round
constexpr float kShares[] = {1.0f, 0.5f, 0.25f};  // of what the forms say, which holds for small steps

// Of a level: how far it is from plain mips; how much of its own its roughness and either normal have of that; how
// wide its two lobes are, how much the second one counts; how often the base colour is darkened for its slopes, and
// by how much more.
enum Number : std::size_t {
    kWhole, kOfRoughness, kOfNormal, kOfSecondNormal, kWidth, kSecondWidth, kSecond, kDark, kDim, kNumbers
};
struct Range {
    float fitted, least, most, step;
};
constexpr Range kRanges[kNumbers] = {
    {1.0f, 0.0f, 1.0f, -0.1f},  // whole
    {1.0f, 0.0f, 1.3f, -0.1f},  // of its roughness
    {1.0f, 0.0f, 1.3f, -0.1f},  // and its normals
    {1.0f, 0.0f, 1.3f, -0.1f},
    {1.0f, 0.4f, 2.5f, 0.05f},  // widths
    {1.0f, 0.4f, 2.5f, 0.05f},
    {1.0f, 0.0f, 2.0f, -0.1f},   // second
    {1.0f, 0.0f, 3.0f, 0.1f},    // dark
    {0.0f, -0.05f, 0.1f, 0.01f}  // dim
};
using Weighed = std::array<float, kNumbers>;
Weighed as_fitted()
{
    Weighed w;
    for (std::size_t i = 0; i < kNumbers; ++i) w[i] = kRanges[i].fitted;
    return w;
}

class Look {
public:
    Look(const PictureBench& bench, const PrefilterOptions& options, Prefiltered& chain)
        : options_(options),
          chain_(chain),
          parts_(parts_of(chain)),
          plain_scores_(bench.score({})),
          retake_(bench),
          start_(fitted_levels(chain)),
          plain_(start_),
          now_(start_.size(), as_fitted()),
          best_(now_)
    {
        const std::vector<Image> roughness = bench.plain_roughness();
        for (std::size_t k = 1; k < start_.size(); ++k) {
            if (start_[k][kRoughness].empty()) continue;
            levels_.push_back(k);
            plain_[k][kRoughness] = roughness[k];
            for (const FitPart part : {kNormal, kSecondNormal}) set_plain_normals(bench.levels()[k], plain_[k][part]);
            if (!plain_[k][kSecondRoughness].empty()) plain_[k][kSecondRoughness] = roughness[k];
            if (!options.base_colors) continue;
            for (const FitPart part : {kMetalShare, kBaseShare})
                std::fill(plain_[k][part].pixels.begin(), plain_[k][part].pixels.end(), 1.0f);
        }
    }

    bool run()
    {
        if (levels_.empty()) return false;
        cost_ = cost(best_);
        float farthest = kFarthest;
        for (int round = 0; round < kRounds; ++round) {
            const double before = cost_;
            if (!go(farthest)) farthest *= 0.5f;
            if (cost_ > before - kClear && farthest < 1.0f) break;
        }
        show(best_);
        return best_ != std::vector<Weighed>(best_.size(), as_fitted());
    }

private:
    void set_plain_normals(const Level& level, Image& normals) const
    {
        for (std::size_t i = 0; 3 * i < normals.pixels.size(); ++i) {
            const glm::vec3& n = level.texels[i].n;
            float* code = &normals.pixels[3 * i];
            code[0] = 0.5f + 0.5f * n.x;
            code[1] = 0.5f + 0.5f * (options_.green_down ? -n.y : n.y);
            code[2] = 0.5f + 0.5f * n.z;
        }
    }

    // All numbers at once to where the forms about the best ones cost least; whether that went all the way.
    bool go(float farthest)
    {
        cost(best_);  // what the forms are about
        const std::size_t count = levels_.size() * kNumbers;
        const PictureForms forms = retake_.forms(chain_, count, [&](std::size_t i) {
            std::vector<Weighed> levels = best_;
            if (i < count) number(levels, i) += kRanges[i % kNumbers].step;
            changed_ |= show(levels);
            return i < count ? levels_[i / kNumbers] : 0;
        });
        std::vector<float> low(count, 0.0f), high = low;
        for (std::size_t i = 0; i < count; ++i) {
            const Range& range = kRanges[i % kNumbers];
            if (!options_.base_colors && (i % kNumbers == kDark || i % kNumbers == kDim)) continue;
            const float at = number(best_, i);
            const float to_least = (range.least - at) / range.step, to_most = (range.most - at) / range.step;
            low[i] = std::max(std::min(to_least, to_most), -farthest);
            high[i] = std::min(std::max(to_least, to_most), farthest);
        }
        const std::vector<float> steps = cheapest_steps(forms, plain_scores_, low, high, kNumbers);
        for (const float share : kShares) {
            std::vector<Weighed> levels = best_;
            for (std::size_t i = 0; i < count; ++i) number(levels, i) += share * steps[i] * kRanges[i % kNumbers].step;
            const double tried = cost(levels);
            if (!(tried < cost_)) continue;
            cost_ = tried;
            best_ = levels;
            return share == 1.0f;
        }
        return false;
    }
    float& number(std::vector<Weighed>& levels, std::size_t i) const
    {
        return levels[levels_[i / kNumbers]][i % kNumbers];
    }

    // Which levels of the chain that changes.
    std::uint32_t show(const std::vector<Weighed>& levels)
    {
        std::uint32_t changed = 0;
        for (const std::size_t k : levels_) {
            if (levels[k] == now_[k]) continue;
            changed |= 1u << k;
            show(k, levels[k]);
        }
        now_ = levels;
        return changed;
    }
    void show(std::size_t k, const Weighed& w)
    {
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (start_[k][i].empty()) continue;
            const bool rough = i == kRoughness || i == kSecondRoughness;
            const float own = rough ? w[kOfRoughness]
                              : i == kNormal       ? w[kOfNormal]
                              : i == kSecondNormal ? w[kOfSecondNormal]
                                                   : 1.0f;
            mix(plain_[k][i], start_[k][i], w[kWhole] * own, part(k, i));
        }
        widen(part(k, kRoughness), w[kWidth]);
        if (!start_[k][kSecondShare].empty()) {
            widen(part(k, kSecondRoughness), w[kSecondWidth]);
            for (float& share : part(k, kSecondShare).pixels) share = std::min(share * w[kSecond], 1.0f);
        }
        if (!options_.base_colors || start_[k][kBaseShare].empty()) return;
        for (float& share : part(k, kBaseShare).pixels)
            share = std::clamp(1.0f - w[kDim] + w[kDark] * (share - 1.0f), 0.0f, 1.0f);
    }
    Image& part(std::size_t k, std::size_t i) { return (*parts_[i])[k]; }
    void widen(Image& level, float width) const
    {
        for (float& stored : level.pixels)
            stored = stored_value(std::clamp(perceptual(stored, options_) * width, 0.0f, 1.0f), options_);
    }

    double cost(const std::vector<Weighed>& levels)
    {
        changed_ |= show(levels);
        const std::vector<PictureScore> scores = retake_.score(chain_, changed_);
        changed_ = 0;
        std::vector<double> changes, unused(scores.size());
        double flicker = 0.0;
        for (std::size_t i = 0; i < scores.size(); ++i) {
            changes.push_back(change_of(scores[i].rmse, plain_scores_[i].rmse));
            flicker += change_of(scores[i].flicker, plain_scores_[i].flicker);
        }
        return look_price(changes, unused) + kFlickerWeight * flicker / static_cast<double>(scores.size());
    }

    const PrefilterOptions& options_;
    Prefiltered& chain_;
    const std::array<std::vector<Image>*, 7> parts_;
    const std::vector<PictureScore> plain_scores_;
    PictureBench::Retake retake_;
    const FitLevels start_;
    FitLevels plain_;
    std::vector<std::size_t> levels_{};
    std::vector<Weighed> now_, best_;
    std::uint32_t changed_ = 0;  // levels, since the last score
    double cost_ = 0.0;
};

}  // namespace

std::uint32_t floors_seed(const Levels& plain)
{
    Hasher hasher;
    for (const Level& level : plain) {
        if (level.texels.empty() || level.texels.size() > 1024) continue;
        for (const Texel& t : level.texels)
            for (const float number : {t.n.x, t.n.y, t.n.z, t.stored}) hasher.add(number);
    }
    return static_cast<std::uint32_t>(std::stoul(hasher.text().substr(0, 8), nullptr, 16));
}

bool look_again(const PictureBench& of_maps, const PrefilterOptions& options, Prefiltered& chain)
{
    PictureOptions pictures = held_out_pictures(options.surface, floors_seed(of_maps.levels()));
    pictures.threads = options.threads;
    const PictureBench bench(of_maps, pictures);
    return Look(bench, options, chain).run();
}

}  // namespace petrichor::texproc::detail
