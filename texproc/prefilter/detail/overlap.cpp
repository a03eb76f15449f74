#include "texproc/prefilter/detail/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/portable_math.h"
#include "texproc/prefilter/detail/elliptic_fit.h"
#include "texproc/prefilter/detail/lobe_cost.h"
#include "texproc/prefilter/detail/simplex.h"

namespace petrichor::texproc {

namespace {

using namespace detail;

struct Effort {
    int samples;
    int guard;    // samples of the guard; 0: the candidates compete on the first set
    int ladder;   // alphas tried about the mean normal
    int rungs;    // and about each other start
    int line;     // evaluations of the search along alpha
    int joint;    // evaluations of the search over normal and alpha
    bool second;  // also from the best clearly different start
    int fit_rounds;
    int cells;  // the footprint is merged to so many
};

Effort effort_at(int level, bool quick)
{
    static constexpr int kSamples[] = {120, 120, 120, 160, 240, 320, 960, 1280};
    const int samples = level >= 9 ? 2560 : level >= 8 ? 1280 : kSamples[level];
    if (quick) {
        // The finest levels hold most texels: there the cheapest of the fits and of a few alphas.
        if (level <= 2) return {40, 0, 5, 0, level == 1 ? 0 : 6, 8, false, 3, 16};
        const int half = level >= 6 ? samples / 3 / 40 * 40 : std::max(80, samples / 2);
        if (level == 3) return {half, 0, 5, 3, 6, 12, false, 3, 24};
        return {half, half, 6, 3, 6, 20, false, 4, level <= 4 ? 64 : level <= 6 ? 160 : 256};
    }
    if (level <= 1) return {samples, 2 * samples, 5, 3, 8, 18, false, 4, 16};
    if (level == 2) return {samples, 2 * samples, 6, 3, 8, 24, false, 4, 64};
    if (level == 3) return {samples, samples, 8, 4, 10, 32, false, 5, 48};
    return {samples, samples, 10, 5, 10, 36, level >= 5, 5, level <= 4 ? 128 : 1024};
}

float clamped2(float alpha2)
{
    return std::clamp(alpha2, kMinAlpha2, 1.0f);
}

// Ten or so alphas, geometric between the bounds, about one normal.
Candidate climb(const LobeCost& cost, const Direction& normal, float low2, float high2, int count)
{
    if (count < 1) return {};
    float alpha2s[LobeCost::kMost], costs[LobeCost::kMost];
    const float ratio =
        count > 1 ? portable_exp(portable_log(high2 / low2) / static_cast<float>(count - 1)) : 1.0f;
    float a2 = low2;
    for (int k = 0; k < count; ++k, a2 *= ratio) alpha2s[k] = clamped2(a2);
    cost(normal, alpha2s, count, costs);
    const auto best = static_cast<std::size_t>(std::min_element(costs, costs + count) - costs);
    return {normal, alpha2s[best], costs[best]};
}

// Along log alpha about a fixed normal.
Candidate refine_line(const LobeCost& cost, const Candidate& from, float step, int budget)
{
    if (budget <= 0) return from;
    const auto f = [&](const std::array<float, 1>& x) {
        return cost(from.normal, clamped2(portable_exp(x[0])));
    };
    const auto [x, value] =
        simplex<1>({portable_log(from.alpha2)}, from.cost, {step}, budget, 1e-4f, f);
    if (!(value < from.cost)) return from;
    return {from.normal, clamped2(portable_exp(x[0])), value};
}

Candidate refine_joint(const LobeCost& cost, const Candidate& from, int budget)
{
    if (budget <= 0) return from;
    const Frame frame = frame_about(from.normal);
    const float alpha = std::sqrt(from.alpha2);
    const auto f = [&](const std::array<float, 3>& x) {
        const Direction n = leaned(frame, alpha * x[0], alpha * x[1]);
        if (n.z < 0.05f) return 2.0f;
        return cost(n, clamped2(portable_exp(x[2])));
    };
    const auto [x, value] = simplex<3>({0.0f, 0.0f, portable_log(from.alpha2)}, from.cost,
                                       {0.35f, 0.35f, 0.5f}, budget, 2e-4f, f);
    if (!(value < from.cost)) return from;
    return {leaned(frame, alpha * x[0], alpha * x[1]), clamped2(portable_exp(x[2])), value};
}

// Footprints of nearly one lobe, most texels of the finest levels, have a closed form: the
// geometric mean of alpha^2 and a share of the slope variance. The share, 0.88 and less where rough
// lobes lose light to shadowing, and the bounds were measured against the search with 2560 samples:
// within 0.001 of the best isotropic lobe, where the search with 80 is 0.001 to 0.01 above it and
// re-aiming the normal gains less than 0.003. A few steep texels among flat ones make a variance
// that says nothing of the rest: where the radius of the median rule is another one, there is more
// than one lobe. Returns alpha^2 without the light, or 0 for other footprints.
float nearly_one_lobe(const Cells& cells, const Direction& normal, float light2, float most_spread)
{
    const float variance = slope_variance(cells.view(), normal);
    const auto [narrow, wide] = std::minmax_element(cells.alpha2.begin(), cells.alpha2.end());
    const float least = *narrow + light2, most = *wide + light2;
    // Cheap tests first: no footprint passes that is far above its narrowest lobe.
    if (variance > 4.0f * most_spread * least || most > 4.0f * least) return 0.0f;
    const float middle = std::sqrt(least * most);
    float whole = 0.0f, mean = 0.0f, square = 0.0f;
    for (std::size_t i = 0; i < cells.alpha2.size(); ++i) {
        // log(a / middle), whose ratio is at most 2.
        const float a = cells.alpha2[i] + light2;
        const float s = (a - middle) / (a + middle), s2 = s * s;
        const float x =
            2.0f * s *
            (1.0f + s2 * (1.0f / 3.0f + s2 * (0.2f + s2 * (1.0f / 7.0f + s2 * (1.0f / 9.0f)))));
        const float w = cells.weight[i];
        whole += w;
        mean += w * x;
        square += w * x * x;
    }
    mean /= whole;
    const float spread = std::max(0.0f, square / whole - mean * mean);
    const float centre = middle * portable_exp(mean);
    if (spread > 0.06f || variance > most_spread * centre) return 0.0f;
    const float share = share_inside(cells.view(), normal, light2, centre + 0.92f * variance);
    if (!(std::abs(share - 0.5f) < 0.012f)) return 0.0f;
    const float rough = std::max(0.0f, std::sqrt(centre) - 0.4f);
    return std::clamp(centre + (0.88f - 2.9f * rough * rough) * variance - light2, kMinAlpha2,
                      1.0f);
}

// Several lobes far apart share little light with any one, and that little is what few samples tell
// badly: true where the narrowest lobe is lost among the slopes or beside the widest.
bool far_apart(const Cells& cells, const Direction& normal, float light2)
{
    const auto [least, most] = std::minmax_element(cells.alpha2.begin(), cells.alpha2.end());
    return *most + light2 > 8.0f * (*least + light2) ||
           slope_variance(cells.view(), normal) > 4.0f * (*least + light2);
}

// What a footprint is searched with.
struct Search {
    const OverlapOptions& options;
    const Effort effort;
    const LobeKernel& kernel;
    const CellsView cells;  // with the light
    const LobeCost cost;
    Candidate plain, median{};
    Candidate robust{}, mode{};  // other normals
    float low2 = 1.0f, high2 = 0.0f;

    void bound(const Candidate& c)
    {
        low2 = std::min(low2, 0.49f * c.alpha2);
        high2 = std::min(1.0f, std::max(high2, 1.44f * c.alpha2));
    }
};

// The best alpha about the mean normal.
Candidate best_rough(const Search& s)
{
    const Direction& n = s.plain.normal;
    Candidate rough = climb(s.cost, n, s.low2, s.high2, s.effort.ladder);
    // Where many narrow lobes lie apart, little of their light is met by any lobe about their mean,
    // and a wide dim one misplaces least.
    if (s.high2 < 0.4f) {
        const Candidate wide = climb(s.cost, n, 0.45f, 0.9f, 2);
        if (wide.cost < rough.cost) rough = wide;
    }
    if (s.median.cost < rough.cost) rough = s.median;
    if (s.plain.cost <= rough.cost) rough = s.plain;
    const float rung =
        portable_log(s.high2 / s.low2) / static_cast<float>(std::max(1, s.effort.ladder - 1));
    return refine_line(s.cost, rough, 0.5f * rung, s.effort.line);
}

// A start about another normal: its own alpha, and some about it.
Candidate best_about(const Search& s, const Candidate& start)
{
    const bool all = s.effort.rungs == s.effort.ladder;
    const float low2 = all ? s.low2 : std::max(s.low2, 0.3f * start.alpha2);
    const float high2 = all ? s.high2 : std::min(s.high2, 3.0f * start.alpha2);
    const Candidate climbed = climb(s.cost, start.normal, low2, high2, s.effort.rungs);
    return start.cost < climbed.cost ? start : climbed;
}

// The best normal and alpha.
Candidate best_joint(const Search& s, const Candidate& rough)
{
    std::array<Candidate, 3> starts{rough, best_about(s, s.robust), best_about(s, s.mode)};
    std::sort(starts.begin(), starts.end(),
              [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    Candidate joint = refine_joint(s.cost, starts[0], s.effort.joint);
    if (!s.effort.second) return joint;
    for (std::size_t k = 1; k < starts.size(); ++k) {
        const float apart = 1.0f - dot(starts[k].normal, starts[0].normal);
        if (2.0f * apart < 0.1f * starts[0].alpha2) continue;  // the same lobe again
        const Candidate other = refine_joint(s.cost, starts[k], s.effort.joint);
        return other.cost < joint.cost ? other : joint;
    }
    return joint;
}

// The cheapest on samples that the search has not seen, simplest first: what makes "never worse
// than plain" hold up to the noise of sampling.
Candidate guarded(const LobeCost& judge, const Search& s, const Candidate& rough,
                  const Candidate& joint)
{
    Candidate chosen{s.plain.normal, s.plain.alpha2, judge(s.plain.normal, s.plain.alpha2)};
    for (const Candidate& c : {rough, joint}) {
        const float value = judge(c.normal, c.alpha2);
        if (value < chosen.cost - 1e-4f) chosen = {c.normal, c.alpha2, value};
    }
    return chosen;
}

Candidate cheapest(const Search& s, const Candidate& rough, const Candidate& joint)
{
    Candidate chosen = s.plain;
    for (const Candidate& c : {rough, joint}) {
        if (c.cost < chosen.cost - 1e-4f) chosen = c;
    }
    return chosen;
}

// Starts, searches and guard. `second`: where the guard's samples go.
Candidate searched(Search& s, const Whole& whole, float plain2, std::uint32_t seed, Samples& second)
{
    const Direction& mean = s.plain.normal;
    const auto started = [&](const Direction& n, float alpha2) {
        const Candidate c{n, clamped2(alpha2), s.cost(n, clamped2(alpha2))};
        s.bound(c);
        return c;
    };
    s.plain = started(mean, plain2);
    if (s.plain.cost < 0.01f) return s.plain;  // nothing to gain
    s.median = started(mean, median_alpha2(s.cells, mean, s.kernel));
    if (s.options.joint) {
        const RobustFit fit =
            student_t(s.cells, mean, s.median.alpha2, 2, s.effort.fit_rounds, false, s.kernel);
        s.robust = started(fit.normal, fit.alpha2);
    }
    const Candidate mode = s.cost.mode();
    s.mode = started(mode.normal.z < 0.05f ? mean : mode.normal, mode.alpha2);
    const Candidate rough = best_rough(s);
    const Candidate joint = s.options.joint ? best_joint(s, rough) : rough;
    if (s.effort.guard == 0) return cheapest(s, rough, joint);
    return guarded(LobeCost(s.cells, whole, s.effort.guard, 2 * seed + 1, second), s, rough, joint);
}

}  // namespace

FittedLobe fit_overlap(const Cells& cells, const Means& means, int level, std::uint32_t seed,
                       const OverlapOptions& options)
{
    const Direction mean_normal = normalized({means.nx, means.ny, means.nz});
    const float light2 = options.light * options.light;
    const float plain_alpha2 = std::max((means.p * means.p) * (means.p * means.p), kMinAlpha2);
    const auto lobe = [](const Direction& n, float a2) {
        return FittedLobe{n, a2, false, {}, a2, a2, {}};
    };

    float one = 0.0f;
    if (!options.anisotropic) {
        one = nearly_one_lobe(cells, mean_normal, light2, options.quick ? 0.5f : 0.25f);
        if (one > 0.0f && !coarse_codes(one + light2, options.stored))
            return lobe(mean_normal, one);
    }

    Effort effort = effort_at(level, options.quick);
    if (level <= 5 && far_apart(cells, mean_normal, light2)) {
        effort.samples *= 2;
        if (effort.guard > 0) effort.guard = std::max(effort.guard, effort.samples);
    }
    const float narrowest = *std::min_element(cells.alpha2.begin(), cells.alpha2.end());
    const auto unlit = [&](float a2) {
        // A lobe narrower than any of the footprint's own is possible only through the light.
        return light2 > 0.0f ? std::clamp(a2 - light2, narrowest, 1.0f) : a2;
    };
    thread_local Cells lit;
    thread_local Samples first_samples, second_samples;
    lit = cells;
    merge(lit, effort.cells, lit.count());
    for (float& a2 : lit.alpha2) a2 = clamped2(a2 + light2);
    const CellsView view = lit.view();
    const Whole whole = whole_of(view, means);
    const LobeKernel& kernel = lobe_kernel();
    Search s{options,
             effort,
             kernel,
             view,
             LobeCost(view, whole, effort.samples, 2 * seed, first_samples),
             {mean_normal, clamped2(plain_alpha2 + light2)}};
    FittedLobe out = lobe(mean_normal, one);
    Candidate chosen{mean_normal, one + light2};
    if (!(one > 0.0f)) {
        chosen = searched(s, whole, plain_alpha2 + light2, seed, second_samples);
        out = lobe(chosen.normal, unlit(chosen.alpha2));
    }

    if (options.anisotropic) {
        const RobustFit robust = student_t(view, mean_normal, chosen.alpha2, 2, 8, true, kernel);
        const EllipticLobe found = fit_elliptic(s.cost, chosen, robust, 90).first;
        // On fresh samples against the chosen lobe, as the guard does; the mass of an ellipse is
        // known to about a hundredth only.
        const LobeCost judge(view, whole, 2 * effort.samples, 2 * seed + 1, second_samples);
        if (judge(found) < judge(chosen.normal, chosen.alpha2) - 0.01f) {
            out = {{found.nx, found.ny, found.nz},
                   chosen.alpha2,
                   true,
                   {found.tx, found.ty, found.tz},
                   unlit(found.alpha2_x),
                   unlit(found.alpha2_y),
                   {}};
        }
    }
    if (!out.elliptic && coarse_codes(chosen.alpha2, options.stored)) {
        // Many codes compete: on more samples, and on others than the search has fitted.
        const LobeCost judge(view, whole, 2 * effort_at(level, false).samples, 2 * seed + 1,
                             second_samples);
        const Codes plain = rounded(mean_normal, plain_alpha2, options.stored);
        out.codes = cheapest_codes(judge, out.normal, out.alpha2, plain, light2, options.stored);
    }
    return out;
}

}  // namespace petrichor::texproc
