#include "texproc/prefilter/detail/second_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "texproc/prefilter/detail/chain_fit.h"
#include "texproc/prefilter/detail/fit_parts.h"
#include "texproc/prefilter/detail/look_price.h"
#include "texproc/prefilter/detail/picture_cost.h"
#include "texproc/prefilter/detail/worst_lights.h"

namespace petrichor::texproc::detail {

namespace {

constexpr double kClear = 1e-3;  // a smaller gain changes nothing
// So many rounds downhill, then as many times the worst lights are sought and it goes on with them.
constexpr int kRounds = 2, kSearches = 2;
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
          start_(fitted_levels(chain)),
          plain_(start_),
          now_(start_.size(), as_fitted()),
          best_(now_)
    {
        see(bench);
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

    /// With the floors, and then those of worst_lights(), too; `bench` must outlive this.
    void see(const PictureBench& bench)
    {
        seen_.push_back({PictureBench::Retake(bench), bench.score({}), ~0u});
    }

    /// Goes on from the best numbers so far, which the chain then has; whether they are others than those of the fit.
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
        change_to(best_);
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
        PictureForms forms{count, {}};
        std::vector<PictureScore> plain;
        for (const Seen& seen : seen_) {
            PictureForms more = seen.retake.forms(chain_, count, [&](std::size_t i) {
                std::vector<Weighed> levels = best_;
                if (i < count) number(levels, i) += kRanges[i % kNumbers].step;
                change_to(levels);
                return i < count ? levels_[i / kNumbers] : 0;
            });
            std::move(more.cases.begin(), more.cases.end(), std::back_inserter(forms.cases));
            plain.insert(plain.end(), seen.plain.begin(), seen.plain.end());
        }
        const std::size_t sought = plain.size() - seen_.front().plain.size();
        std::vector<float> low(count, 0.0f), high = low;
        for (std::size_t i = 0; i < count; ++i) {
            const Range& range = kRanges[i % kNumbers];
            if (!options_.base_colors && (i % kNumbers == kDark || i % kNumbers == kDim)) continue;
            const float at = number(best_, i);
            const float to_least = (range.least - at) / range.step, to_most = (range.most - at) / range.step;
            low[i] = std::max(std::min(to_least, to_most), -farthest);
            high[i] = std::min(std::max(to_least, to_most), farthest);
        }
        const std::vector<float> steps = cheapest_steps(forms, plain, low, high, kNumbers, sought);
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

    void change_to(const std::vector<Weighed>& levels)
    {
        const std::uint32_t changed = show(levels);
        for (Seen& seen : seen_) seen.changed |= changed;
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
        change_to(levels);
        double sum = 0.0;
        for (Seen& seen : seen_) {
            const std::vector<PictureScore> scores = seen.retake.score(chain_, seen.changed);
            seen.changed = 0;
            std::vector<double> changes, unused(scores.size());
            double flicker = 0.0;
            for (std::size_t i = 0; i < scores.size(); ++i) {
                changes.push_back(change_of(scores[i].rmse, seen.plain[i].rmse));
                flicker += change_of(scores[i].flicker, seen.plain[i].flicker);
            }
            const bool floors = &seen == &seen_.front();
            sum += floors ? look_price(changes, unused) + kFlickerWeight * flicker / static_cast<double>(scores.size())
                          : worst_price(changes, unused);
        }
        return sum;
    }

    const PrefilterOptions& options_;
    Prefiltered& chain_;
    const std::array<std::vector<Image>*, 7> parts_;
    const FitLevels start_;
    FitLevels plain_;
    std::vector<std::size_t> levels_{};
    std::vector<Weighed> now_, best_;
    struct Seen {
        PictureBench::Retake retake;
        std::vector<PictureScore> plain;
        std::uint32_t changed;  // levels, since the last score
    };
    std::vector<Seen> seen_{};  // the floors, then what was sought
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
    Look look(bench, options, chain);
    bool changed = look.run();
    std::vector<PictureBench> sought;
    sought.reserve(kSearches);  // they stay where they are
    for (std::uint32_t search = 1; search <= kSearches; ++search) {
        const PictureOptions worst = worst_lights(of_maps, pictures, options, chain, pictures.seed + 7919 * search);
        if (worst.cases.empty()) break;
        look.see(sought.emplace_back(of_maps, worst));
        changed = look.run();
    }
    return changed;
}

}  // namespace petrichor::texproc::detail
