#include "texproc/prefilter/detail/fit_settle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "texproc/prefilter/detail/chain_fit.h"
#include "texproc/prefilter/detail/picture_cost.h"
#include "texproc/prefilter/detail/second_look.h"

namespace petrichor::texproc::detail {

namespace {

// Of a level: how much of a fit is kept; of two lobes on anything but metal also: times which the base colour of paint is darker for its slopes
// than a filter makes it, and how much darker whatever they are, since a wide second lobe is a haze on
// what is diffuse; how much of the second lobe's share; how much of what was before the fit.
constexpr float kShares[] = {1.0f, 0.75f, 0.5f, 0.25f, 0.0f}, kFewer[] = {1.0f, 0.5f, 0.0f};
constexpr float kDark[] = {0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 3.0f};
constexpr float kDim[] = {0.0f, 0.01f, 0.02f, 0.04f};
constexpr float kSecond[] = {1.0f, 0.75f, 0.5f};
constexpr float kLeft[] = {1.0f, 0.5f, 0.0f};
// Of all levels at once.
constexpr float kAlike[] = {1.0f, 0.75f, 0.5f, 0.25f}, kLess[] = {0.75f, 0.5f}, kLeastMetal = 0.12f;
constexpr int kSweeps = 2;  // of metal and where there is a guard, else one
constexpr double kClear = 1e-3;  // a smaller gain changes nothing
// What the pictures of a guard count beside the others: a price of so much that it holds back what is
// clearly worse, and not what is gained for it.
constexpr double kGuard = 0.3;
// And what a picture costs there that is worse than that of plain mips, its own or the guard's: half of what it
// costs without a guard. Of so many hardly any fit has none, and what that holds back is more than it saves.
constexpr double kWorseGuarded = 5.0;

// Of a level.
struct Kept {
    std::size_t fit = 0;
    float fitted = 0.0f, metal = 0.0f, dark = 1.0f, dim = 0.0f, second = 1.0f, left = 1.0f;
    bool operator==(const Kept&) const = default;
};

// Pictures of a bench, whose mean is to be small, and those of a guard, of which none is to be worse
// than plain mips.
class Judge {
public:
    Judge(const PictureBench& bench, const PictureBench* guard) : looks_()
    {
        looks_.emplace_back(bench);
        if (guard) looks_.emplace_back(*guard);
    }
    /// changed: levels, a bit each. A cost that is not below `enough` may be less than it is: the guard can only
    /// add to it, so its pictures are left for later.
    double cost(const Prefiltered& chain, std::uint32_t changed, double enough)
    {
        for (Look& look : looks_) look.changed |= changed;
        const bool guarded = looks_.size() > 1;
        const Look& own = looks_.front();
        look(looks_.front(), chain);
        const double cost = cost_of(own.scores, own.plain, guarded ? kWorseGuarded : kWorse);
        if (!guarded || !(cost < enough)) return cost;
        const Look& guard = looks_.back();
        look(looks_.back(), chain);
        return cost + kGuard * penalty_of(guard.scores, guard.plain, kWorseGuarded) /
                          static_cast<double>(guard.scores.size());
    }

private:
    struct Look {
        explicit Look(const PictureBench& bench)
            : plain(bench.score({})), retake(bench)
        {
        }
        std::vector<PictureScore> plain, scores{};
        PictureBench::Retake retake;
        std::uint32_t changed = 0;  // since it looked last
    };
    static void look(Look& at, const Prefiltered& chain)
    {
        if (at.changed || at.scores.empty()) at.scores = at.retake.score(chain, at.changed);
        at.changed = 0;
    }
    std::vector<Look> looks_;
};

class Search {
public:
    Search(const PictureBench& bench, const PictureBench* guard, const Fits& fits, const PrefilterOptions& options,
           Prefiltered& chain)
        : fits_(fits),
          metal_(options.surface == SurfaceClass::Metal),
          guarded_(guard != nullptr),
          colors_(guarded_ && options.base_colors),
          shares_(metal_ || guarded_ ? std::span<const float>(kShares) : kFewer),
          chain_(chain),
          plain_(bench.plain_roughness()),
          judge_(bench, guard),
          now_(chain.roughness.size())
    {
        best_ = now_;
    }

    void run()
    {
        best_cost_ = judge_.cost(chain_, show(best_), INFINITY);
        alike();
        if (guarded_) together();
        for (int sweep = 0; sweep < (metal_ || guarded_ ? kSweeps : 1); ++sweep) {
            const double before = best_cost_;
            one_by_one();
            if (best_cost_ > before - kClear) break;
        }
        show(best_);
    }

private:
    bool is_fitted(std::size_t k) const { return !fits_.before[k][kRoughness].empty(); }

    // Which levels of the chain that changes.
    std::uint32_t show(const std::vector<Kept>& levels)
    {
        std::uint32_t changed = 0;
        for (std::size_t k = 1; k < now_.size(); ++k)
            if (is_fitted(k) && !(levels[k] == now_[k])) changed |= 1u << k, show(k, levels[k]);
        now_ = levels;
        return changed;
    }

    void show(std::size_t k, const Kept& kept)
    {
        const FitParts &before = fits_.before[k], &after = fits_.after[kept.fit][k];
        const auto parts = parts_of(chain_);
        Image rough = before[kRoughness];
        mix(plain_[k], before[kRoughness], kept.left, rough);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (k >= parts[i]->size()) continue;
            const bool is_rough = i == kRoughness || i == kSecondRoughness;
            mix(is_rough ? rough : before[i], after[i], i == kMetalShare ? kept.metal : kept.fitted,
                (*parts[i])[k]);
            if (i != kSecondShare) continue;
            for (float& share : (*parts[i])[k].pixels) share *= kept.second;
        }
        for (float& share : chain_.base_share[k].pixels)
            share = std::clamp(1.0f - kept.dim + kept.dark * (share - 1.0f), 0.0f, 1.0f);
    }

    void attempt(const std::vector<Kept>& levels)
    {
        const double enough = best_cost_ - kClear, cost = judge_.cost(chain_, show(levels), enough);
        if (!(cost < enough)) return;
        best_cost_ = cost;
        best_ = levels;
    }

    void alike()
    {
        for (std::size_t fit = 0; fit < fits_.after.size(); ++fit) {
            const auto share = [&](float fitted, float dim) {
                Kept kept;
                kept.fit = fit, kept.fitted = kept.metal = fitted, kept.dim = dim;
                attempt(std::vector<Kept>(now_.size(), kept));
            };
            for (const float fitted : kAlike)
                for (const float dim : kDim)
                    if (colors_ || dim == 0.0f) share(fitted, dim);
            if (metal_) share(kLeastMetal, 0.0f);
        }
    }

    // All levels, from where each of them is.
    void together()
    {
        const auto change = [&](const auto& set) {
            std::vector<Kept> levels = best_;
            for (Kept& kept : levels) set(kept);
            attempt(levels);
        };
        for (const float less : kLess) change([&](Kept& kept) { kept.fitted *= less; });
        for (const float less : kLess) change([&](Kept& kept) { kept.second *= less; });
        if (!colors_) return;
        for (const float more : {1.5f, 2.0f}) change([&](Kept& kept) { kept.dark *= more; });
        for (const float more : {0.01f, 0.02f}) change([&](Kept& kept) { kept.dim += more; });
    }

    // The coarsest first.
    void one_by_one()
    {
        for (std::size_t k = now_.size(); k-- > 1;) {
            if (!is_fitted(k)) continue;
            const auto change = [&](const auto& set) {
                std::vector<Kept> levels = best_;
                set(levels[k]);
                if (!(levels[k] == best_[k])) attempt(levels);
            };
            for (std::size_t fit = 0; fit < fits_.after.size(); ++fit)
                for (const float share : shares_)
                    change([&](Kept& kept) { kept.fit = fit, kept.fitted = share; });
            if (!chain_.metal_share.empty())
                for (const float share : shares_) change([&](Kept& kept) { kept.metal = share; });
            if (!guarded_) continue;
            for (const float second : kSecond) change([&](Kept& kept) { kept.second = second; });
            for (const float left : kLeft) change([&](Kept& kept) { kept.left = left; });
            if (!colors_) continue;
            for (const float dark : kDark) change([&](Kept& kept) { kept.dark = dark; });
            for (const float dim : kDim) change([&](Kept& kept) { kept.dim = dim; });
        }
    }

    const Fits& fits_;
    const bool metal_, guarded_, colors_;
    const std::span<const float> shares_;
    Prefiltered& chain_;
    const std::vector<Image> plain_;
    Judge judge_;
    std::vector<Kept> now_, best_;
    double best_cost_ = 0.0;
};

}  // namespace

void keep_of_fits(const PictureBench& bench, const Fits& fits, const PrefilterOptions& options,
                  Prefiltered& chain)
{
    if (options.surface == SurfaceClass::Metal || options.lobes != 2) {
        Search(bench, nullptr, fits, options, chain).run();
        return;
    }
    PictureOptions pictures = guard_pictures(options.surface);
    pictures.threads = options.threads;
    const PictureBench guard(bench, pictures);
    Search(bench, &guard, fits, options, chain).run();
}

void settle_fit(const PictureBench& bench, const PrefilterOptions& options, Prefiltered& chain)
{
    const std::size_t levels = chain.roughness.size();
    if (options.joint && options.base_colors && options.surface != SurfaceClass::Paint) {
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
    Fits fits{fitted_levels(chain), {}};
    const auto keep = [&] { fits.after.push_back(fitted_levels(chain)); };
    if (!fit_chain(bench.levels(), options, chain, keep)) return;
    keep();
    for (std::size_t k = 1; k < levels; ++k) {
        const auto parts = parts_of(chain);
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (!fits.before[k][i].empty()) (*parts[i])[k] = fits.before[k][i];
    }
    keep_of_fits(bench, fits, options, chain);
    if (options.lobes == 2 && options.surface != SurfaceClass::Metal) look_again(bench, options, chain);
}

}  // namespace petrichor::texproc::detail
