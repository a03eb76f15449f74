#include "texproc/prefilter/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petrichor::texproc {

namespace {

using namespace detail;

constexpr float kPi = 3.14159265f;

// What a lobe costs on one set of samples: mass + mass - 2 overlap, relative to the mass of the
// footprint, mean over the views. A lobe that wanders off the samples costs 2.
class Cost {
public:
    Cost(const CellsView& cells, const std::array<float, kViews>& mass, int samples,
         std::uint32_t seed, Samples& storage)
        : kernel_(lobe_kernel()), storage_(storage), mass_(mass)
    {
        draw(cells, samples, seed, storage_);
        kernel_.shade(cells, storage_.view());
        weigh(storage_);
    }

    // For lobes that share a normal.
    void operator()(const Direction& n, const float* alpha2s, int count, float* costs) const
    {
        float overlaps[kViews * 16];
        kernel_.overlaps(storage_.view(), {n.x, n.y, n.z, 0.0f}, alpha2s, count, overlaps);
        for (int k = 0; k < count; ++k) {
            float sum = 0.0f, mine[kViews];
            int views = 0;
            lobe_albedo_in_views(alpha2s[k], n, mine);
            for (int v = 0; v < kViews; ++v) {
                const float r = mass_[static_cast<std::size_t>(v)];
                if (!(r > 1e-6f)) continue;
                sum += std::min(2.0f, std::max(0.0f, (r + mine[v] - overlaps[v * count + k]) / r));
                ++views;
            }
            costs[k] = views ? sum / static_cast<float>(views) : 0.0f;
        }
    }

    float operator()(const Direction& n, float alpha2) const
    {
        float cost;
        (*this)(n, &alpha2, 1, &cost);
        return cost;
    }

    // Elliptic lobes have no table: their mass is that of the isotropic lobe of the same area.
    float operator()(const EllipticLobe& e) const
    {
        float overlaps[kViews];
        kernel_.elliptic_overlap(storage_.view(), e, overlaps);
        float sum = 0.0f;
        int views = 0;
        for (int v = 0; v < kViews; ++v) {
            const float r = mass_[static_cast<std::size_t>(v)];
            if (!(r > 1e-6f)) continue;
            const float* d = kViewDirections[v];
            const float nv = e.nx * d[0] + e.ny * d[1] + e.nz * d[2];
            const float tv = e.tx * d[0] + e.ty * d[1] + e.tz * d[2];
            const float bv = e.bx * d[0] + e.by * d[1] + e.bz * d[2];
            // The width that this view sees decides how much is shadowed.
            const float across = tv * tv + bv * bv;
            const float seen = across > 1e-6f
                                   ? (e.alpha2_x * tv * tv + e.alpha2_y * bv * bv) / across
                                   : std::sqrt(e.alpha2_x * e.alpha2_y);
            const float m = lobe_albedo(seen, nv);
            sum += std::min(2.0f, std::max(0.0f, (r + m - overlaps[v]) / r));
            ++views;
        }
        return views ? sum / static_cast<float>(views) : 0.0f;
    }

    // The brightest half-vector drawn and the narrow lobe that would be as bright there.
    void mode(Direction& normal, float& alpha2) const
    {
        const SamplesView s = storage_.view();
        int best = 0;
        for (int k = 1; k < kViews * s.per_view; ++k) {
            if (s.density[k] > s.density[best]) best = k;
        }
        normal = {s.hx[best], s.hy[best], s.hz[best]};
        alpha2 = 1.0f / (kPi * std::max(s.density[best], 1e-3f));
    }

private:
    const LobeKernel& kernel_;
    Samples& storage_;
    std::array<float, kViews> mass_;
};

// Nelder and Mead's simplex in N dimensions, at most `budget` evaluations.
template <std::size_t N, class Function>
std::pair<std::array<float, N>, float> simplex(const std::array<float, N>& start, float start_value,
                                               const std::array<float, N>& steps, int budget,
                                               float tolerance, const Function& f)
{
    using Point = std::array<float, N>;
    std::array<std::pair<float, Point>, N + 1> s;
    s[0] = {start_value, start};
    for (std::size_t i = 0; i < N; ++i) {
        Point p = start;
        p[i] += steps[i];
        s[i + 1] = {f(p), p};
        --budget;
    }
    const auto by_value = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::sort(s.begin(), s.end(), by_value);
    while (budget > 0 && s[N].first - s[0].first > tolerance) {
        Point centre{};
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t k = 0; k < N; ++k) centre[k] += s[i].second[k] / static_cast<float>(N);
        }
        const auto moved = [&](float factor) {
            Point p;
            for (std::size_t k = 0; k < N; ++k) {
                p[k] = centre[k] + factor * (s[N].second[k] - centre[k]);
            }
            return p;
        };
        const Point reflected = moved(-1.0f);
        const float value = f(reflected);
        --budget;
        if (value < s[0].first && budget > 0) {
            const Point further = moved(-2.0f);
            const float far_value = f(further);
            --budget;
            s[N] = far_value < value ? std::pair{far_value, further} : std::pair{value, reflected};
        } else if (value < s[N - 1].first) {
            s[N] = {value, reflected};
        } else {
            const Point inner = value < s[N].first ? moved(-0.5f) : moved(0.5f);
            const float inner_value = f(inner);
            --budget;
            if (inner_value < std::min(value, s[N].first)) {
                s[N] = {inner_value, inner};
            } else {
                for (std::size_t i = 1; i <= N; ++i) {
                    for (std::size_t k = 0; k < N; ++k) {
                        s[i].second[k] = 0.5f * (s[i].second[k] + s[0].second[k]);
                    }
                    s[i].first = f(s[i].second);
                    --budget;
                }
            }
        }
        std::sort(s.begin(), s.end(), by_value);
    }
    return {s[0].second, s[0].first};
}

struct Effort {
    int samples;
    int guard;      // samples of the guard; 0: the candidates compete on the first set
    int ladder;     // alphas tried about each normal
    int line;       // evaluations of the search along alpha
    int joint;      // evaluations of the search over normal and alpha
    bool second;    // also from the best clearly different start
    int fit_rounds;
};

Effort effort_at(int level, bool quick)
{
    static constexpr int kSamples[] = {80, 80, 120, 160, 240, 320, 640, 640};
    const int samples = level >= 8 ? 1280 : kSamples[level];
    if (quick) {
        // The finest levels hold most texels: there the cheapest of the fits, without a search.
        if (level <= 2) return {40, 0, 0, 0, 0, false, 3};
        const int half = std::max(80, samples / 2);
        return {half, half, 6, 6, 24, false, 4};
    }
    if (level <= 1) return {samples, 2 * samples, 5, 5, 18, false, 4};
    if (level == 2) return {samples, 2 * samples, 8, 8, 32, false, 6};
    return {samples, samples, 10, 10, 36, level >= 5, 5};
}

struct Candidate {
    Direction normal;
    float alpha2 = 0.0f;  // with the light
    float cost = 2.0f;
};

// Ten or so alphas, geometric between the bounds, about one normal.
Candidate climb(const Cost& cost, const Direction& normal, float low2, float high2, int count)
{
    if (count < 1) return {};
    float alpha2s[16], costs[16];
    const float ratio = count > 1 ? std::pow(high2 / low2, 1.0f / static_cast<float>(count - 1)) : 1.0f;
    float a2 = low2;
    for (int k = 0; k < count; ++k, a2 *= ratio) alpha2s[k] = std::clamp(a2, kMinAlpha2, 1.0f);
    cost(normal, alpha2s, count, costs);
    const auto best = static_cast<std::size_t>(std::min_element(costs, costs + count) - costs);
    return {normal, alpha2s[best], costs[best]};
}

// Along log alpha about a fixed normal.
Candidate refine_line(const Cost& cost, const Candidate& from, float step, int budget)
{
    if (budget <= 0) return from;
    const auto f = [&](const std::array<float, 1>& x) {
        return cost(from.normal, std::clamp(std::exp(x[0]), kMinAlpha2, 1.0f));
    };
    const auto [x, value] =
        simplex<1>({std::log(from.alpha2)}, from.cost, {step}, budget, 1e-4f, f);
    if (!(value < from.cost)) return from;
    return {from.normal, std::clamp(std::exp(x[0]), kMinAlpha2, 1.0f), value};
}

Direction leaned(const Frame& frame, float u, float v)
{
    return normalized({frame.n.x + u * frame.t.x + v * frame.b.x,
                       frame.n.y + u * frame.t.y + v * frame.b.y,
                       frame.n.z + u * frame.t.z + v * frame.b.z});
}

Candidate refine_joint(const Cost& cost, const Candidate& from, int budget)
{
    if (budget <= 0) return from;
    const Frame frame = frame_about(from.normal);
    const float alpha = std::sqrt(from.alpha2);
    const auto f = [&](const std::array<float, 3>& x) {
        const Direction n = leaned(frame, alpha * x[0], alpha * x[1]);
        if (n.z < 0.05f) return 2.0f;
        return cost(n, std::clamp(std::exp(x[2]), kMinAlpha2, 1.0f));
    };
    const auto [x, value] = simplex<3>({0.0f, 0.0f, std::log(from.alpha2)}, from.cost,
                                       {0.35f, 0.35f, 0.5f}, budget, 2e-4f, f);
    if (!(value < from.cost)) return from;
    return {leaned(frame, alpha * x[0], alpha * x[1]),
            std::clamp(std::exp(x[2]), kMinAlpha2, 1.0f), value};
}

EllipticLobe elliptic(const Frame& frame, const std::array<float, 5>& x)
{
    const Direction n = leaned(frame, x[0], x[1]);
    const Frame about = frame_about(n);
    const float c = std::cos(x[4]), s = std::sin(x[4]);
    const auto clamped = [](float log2) { return std::clamp(std::exp(log2), kMinAlpha2, 1.0f); };
    return {n.x, n.y, n.z,
            c * about.t.x + s * about.b.x, c * about.t.y + s * about.b.y, c * about.t.z + s * about.b.z,
            c * about.b.x - s * about.t.x, c * about.b.y - s * about.t.y, c * about.b.z - s * about.t.z,
            clamped(x[2]), clamped(x[3])};
}

// Five parameters, from the elliptic robust fit and from the isotropic result.
std::pair<EllipticLobe, float> fit_elliptic(const Cost& cost, const Candidate& from,
                                            const RobustFit& robust, int budget)
{
    const float mean = 0.5f * (robust.a_xx + robust.a_yy);
    const float half = std::sqrt(std::max(
        0.0f, 0.25f * (robust.a_xx - robust.a_yy) * (robust.a_xx - robust.a_yy) +
                  robust.a_xy * robust.a_xy));
    const float angle = 0.5f * std::atan2(2.0f * robust.a_xy, robust.a_xx - robust.a_yy);
    const float wide = std::clamp(mean + half, kMinAlpha2, 1.0f);
    const float slim = std::clamp(mean - half, kMinAlpha2, 1.0f);
    std::pair<EllipticLobe, float> best{{}, 3.0f};
    const float mine = std::log(from.alpha2);
    const float lean = 0.35f * std::sqrt(from.alpha2);
    const std::array<std::pair<Direction, std::array<float, 5>>, 2> starts{{
        {robust.normal, {0.0f, 0.0f, std::log(wide), std::log(slim), angle}},
        {from.normal, {0.0f, 0.0f, mine + 0.3f, mine - 0.3f, angle}},
    }};
    for (const auto& [normal, start] : starts) {
        const Frame frame = frame_about(normal);
        const auto f = [&](const std::array<float, 5>& x) {
            const EllipticLobe e = elliptic(frame, x);
            return e.nz < 0.05f ? 2.0f : cost(e);
        };
        const auto [x, value] = simplex<5>(start, f(start), {lean, lean, 0.4f, -0.4f, 0.3f},
                                           budget, 2e-4f, f);
        if (value < best.second) best = {elliptic(frame, x), value};
    }
    return best;
}

}  // namespace

FittedLobe fit_overlap(const Cells& cells, const Means& means, int level, std::uint32_t seed,
                       const OverlapOptions& options)
{
    const Direction mean_normal = normalized({means.nx, means.ny, means.nz});
    const float light2 = options.light * options.light;
    const float plain_alpha2 = std::max((means.p * means.p) * (means.p * means.p), kMinAlpha2);

    // Footprints of nearly one lobe: the moments are right and the search would only add noise.
    float narrowest = 1.0f, widest = 0.0f;
    for (const float a2 : cells.alpha2) {
        narrowest = std::min(narrowest, a2);
        widest = std::max(widest, a2);
    }
    const float variance = slope_variance(cells.view(), mean_normal);
    FittedLobe out{mean_normal, plain_alpha2, false, {}, plain_alpha2, plain_alpha2};
    if (variance < 0.01f * (means.alpha2 + light2) &&
        widest - narrowest < 0.1f * (means.alpha2 + light2)) {
        out.alpha2 = out.alpha2_x = out.alpha2_y = std::min(1.0f, means.alpha2 + variance);
        return out;
    }

    thread_local Cells lit;
    thread_local Samples first_samples, second_samples;
    lit = cells;
    for (float& a2 : lit.alpha2) a2 = std::clamp(a2 + light2, kMinAlpha2, 1.0f);
    const CellsView view = lit.view();
    std::array<float, kViews> mass{};
    for (int i = 0; i < view.count; ++i) {
        float mine[kViews];
        lobe_albedo_in_views(view.alpha2[i], {view.nx[i], view.ny[i], view.nz[i]}, mine);
        for (std::size_t v = 0; v < kViews; ++v) mass[v] += view.weight[i] * mine[v];
    }

    const Effort effort = effort_at(level, options.quick);
    const LobeKernel& kernel = lobe_kernel();
    const Cost cost(view, mass, effort.samples, 2 * seed, first_samples);
    const float plain2 = std::clamp(plain_alpha2 + light2, kMinAlpha2, 1.0f);
    const float median2 = std::clamp(median_alpha2(view, mean_normal, kernel), kMinAlpha2, 1.0f);

    Direction robust_normal = mean_normal, mode_normal = mean_normal;
    float robust2 = median2, mode2 = plain2;
    cost.mode(mode_normal, mode2);
    mode2 = std::clamp(mode2, kMinAlpha2, 1.0f);
    if (mode_normal.z < 0.05f) mode_normal = mean_normal;
    if (options.joint) {
        const RobustFit robust = student_t(view, mean_normal, median2, 2, effort.fit_rounds, false, kernel);
        robust_normal = robust.normal;
        robust2 = std::clamp(robust.alpha2, kMinAlpha2, 1.0f);
    }
    const float low2 = 0.49f * std::min({plain2, median2, robust2, mode2});
    const float high2 = std::min(1.0f, 1.44f * std::max({plain2, median2, robust2, mode2}));
    const float rung = std::log(high2 / low2) / static_cast<float>(std::max(1, effort.ladder - 1));

    Candidate plain{mean_normal, plain2, cost(mean_normal, plain2)};
    Candidate rough = climb(cost, mean_normal, low2, high2, effort.ladder);
    const Candidate median{mean_normal, median2, cost(mean_normal, median2)};
    if (median.cost < rough.cost) rough = median;
    if (plain.cost <= rough.cost) rough = plain;
    rough = refine_line(cost, rough, 0.5f * rung, effort.line);

    Candidate joint = rough;
    if (options.joint) {
        Candidate starts[3] = {
            rough, climb(cost, robust_normal, low2, high2, effort.ladder),
            climb(cost, mode_normal, low2, high2, effort.ladder)};
        const Candidate robust{robust_normal, robust2, cost(robust_normal, robust2)};
        if (robust.cost < starts[1].cost) starts[1] = robust;
        std::sort(starts, starts + 3,
                  [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
        joint = refine_joint(cost, starts[0], effort.joint);
        if (effort.second) {
            for (int k = 1; k < 3; ++k) {
                const float apart = 1.0f - dot(starts[k].normal, starts[0].normal);
                if (2.0f * apart < 0.1f * starts[0].alpha2) continue;  // the same lobe again
                const Candidate other = refine_joint(cost, starts[k], effort.joint);
                if (other.cost < joint.cost) joint = other;
                break;
            }
        }
    }

    // The guard: the cheapest on samples that the search has not seen, simplest first.
    Candidate chosen = plain;
    if (effort.guard > 0) {
        const Cost judge(view, mass, effort.guard, 2 * seed + 1, second_samples);
        chosen.cost = judge(plain.normal, plain.alpha2);
        for (const Candidate& c : {rough, joint}) {
            const float value = judge(c.normal, c.alpha2);
            if (value < chosen.cost - 1e-4f) chosen = {c.normal, c.alpha2, value};
        }
    } else {
        for (const Candidate& c : {rough, joint}) {
            if (c.cost < chosen.cost - 1e-4f) chosen = c;
        }
    }
    const auto unlit = [&](float a2) { return std::clamp(a2 - light2, narrowest, 1.0f); };
    out.normal = chosen.normal;
    // A lobe narrower than any of the footprint's own is possible only through the light.
    out.alpha2 = light2 > 0.0f ? unlit(chosen.alpha2) : chosen.alpha2;
    out.alpha2_x = out.alpha2_y = out.alpha2;

    if (options.anisotropic) {
        const RobustFit robust = student_t(view, mean_normal, median2, 2, 8, true, kernel);
        const auto [lobe, found] = fit_elliptic(cost, chosen, robust, 90);
        (void)found;
        // On fresh samples against the chosen lobe, as the guard does.
        const Cost judge(view, mass, 2 * effort.samples, 2 * seed + 1, second_samples);
        if (judge(lobe) < judge(chosen.normal, chosen.alpha2) - 1e-4f) {
            out.elliptic = true;
            out.normal = {lobe.nx, lobe.ny, lobe.nz};
            out.tangent = {lobe.tx, lobe.ty, lobe.tz};
            out.alpha2_x = light2 > 0.0f ? unlit(lobe.alpha2_x) : lobe.alpha2_x;
            out.alpha2_y = light2 > 0.0f ? unlit(lobe.alpha2_y) : lobe.alpha2_y;
        }
    }
    return out;
}

}  // namespace petrichor::texproc
