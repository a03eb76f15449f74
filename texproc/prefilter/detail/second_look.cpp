#include "texproc/prefilter/detail/second_look.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/hash.h"
#include "texproc/prefilter/detail/chain_fit.h"
#include "texproc/prefilter/detail/fit_parts.h"
#include "texproc/prefilter/detail/picture_cost.h"

namespace petrichor::texproc::detail {

namespace {

// What a light costs that is worse than with plain mips in the mean of its views, and what each of them does, beside
// their part of the mean.
constexpr double kWorseLight = 12.0, kWorseView = 3.0;
constexpr double kClear = 1e-3;  // a smaller gain changes nothing
constexpr int kSweeps = 2;

// Of a level, in shares of what it was: how far it is from plain mips, how much of its own its roughness and its
// normals have of that, how wide its two lobes are, how much the second one counts; how often the base colour is
// darkened for its slopes, and by how much more.
struct Weighed {
    float whole = 1.0f, roughness = 1.0f, normal = 1.0f, width = 1.0f, second_width = 1.0f, second = 1.0f;
    float dark = 1.0f, dim = 0.0f;
    bool operator==(const Weighed&) const = default;
};

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
          now_(start_.size()),
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
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            const double before = cost_;
            together();
            for (std::size_t i = levels_.size(); i-- > 0;) one(levels_[i]);  // the coarsest first
            if (cost_ > before - kClear) break;
        }
        together();
        show(best_);
        return !(best_ == std::vector<Weighed>(best_.size()));
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

    // The same steps of one level or of all, larger ones of one.
    template <class Change>
    void steps(float step, const Change& change)
    {
        const float less = 1.0f - step, more = 1.0f + step, width = 0.2f * step;
        change([&](Weighed& w) { w.whole *= less; });
        change([&](Weighed& w) { w.whole = std::min(w.whole * more, 1.0f); });
        change([&](Weighed& w) { w.roughness *= less; });
        change([&](Weighed& w) { w.normal *= less; });
        for (const float wide : {1.0f - width, 1.0f + width}) {
            change([&](Weighed& w) { w.width *= wide; });
            change([&](Weighed& w) { w.second_width *= wide; });
        }
        for (const float second : {less, more}) change([&](Weighed& w) { w.second *= second; });
        if (!options_.base_colors) return;
        for (const float dark : {less, more}) change([&](Weighed& w) { w.dark *= dark; });
        for (const float dim : {0.03f * step, -0.03f * step}) change([&](Weighed& w) { w.dim += dim; });
    }
    void together()
    {
        steps(0.2f, [&](const auto& set) {
            std::vector<Weighed> levels = best_;
            for (Weighed& level : levels) set(level);
            attempt(levels);
        });
    }
    void one(std::size_t k)
    {
        steps(0.3f, [&](const auto& set) {
            std::vector<Weighed> levels = best_;
            set(levels[k]);
            attempt(levels);
        });
    }
    void attempt(const std::vector<Weighed>& levels)
    {
        if (levels == best_) return;
        const double tried = cost(levels);
        if (!(tried < cost_ - kClear)) return;
        cost_ = tried;
        best_ = levels;
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
            const bool rough = i == kRoughness || i == kSecondRoughness, normal = i == kNormal || i == kSecondNormal;
            mix(plain_[k][i], start_[k][i], w.whole * (rough ? w.roughness : normal ? w.normal : 1.0f), part(k, i));
        }
        widen(part(k, kRoughness), w.width);
        if (!start_[k][kSecondShare].empty()) {
            widen(part(k, kSecondRoughness), w.second_width);
            for (float& share : part(k, kSecondShare).pixels) share = std::min(share * w.second, 1.0f);
        }
        if (!options_.base_colors || start_[k][kBaseShare].empty()) return;
        for (float& share : part(k, kBaseShare).pixels)
            share = std::clamp(1.0f - w.dim + w.dark * (share - 1.0f), 0.0f, 1.0f);
    }
    Image& part(std::size_t k, std::size_t i) { return (*parts_[i])[k]; }
    void widen(Image& level, float width) const
    {
        if (width == 1.0f) return;
        for (float& stored : level.pixels)
            stored = stored_value(std::clamp(perceptual(stored, options_) * width, 0.0f, 1.0f), options_);
    }

    double cost(const std::vector<Weighed>& levels)
    {
        const std::vector<PictureScore> scores = retake_.score(chain_, show(levels));
        double sum = 0.0;
        for (std::size_t first = 0; first < scores.size(); first += kHeldOutViews) {
            double light = 0.0;
            for (std::size_t i = first; i < first + kHeldOutViews; ++i) {
                const double view = change_of(scores[i].rmse, plain_scores_[i].rmse);
                light += view;
                sum += kWorseView * std::max(view, 0.0) +
                       kFlickerWeight * change_of(scores[i].flicker, plain_scores_[i].flicker);
            }
            sum += light + kWorseLight * std::max(light, 0.0);
        }
        return sum / static_cast<double>(scores.size());
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
