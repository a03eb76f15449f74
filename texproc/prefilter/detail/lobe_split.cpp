#include "texproc/prefilter/detail/lobe_split.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/portable_math.h"

namespace petrichor::texproc::detail {

namespace {

constexpr int kRounds = 5;
constexpr float kNarrowest2 = 4e-6f;  // alpha^2, as lit_floor.h has it

float own2(float p)
{
    return std::max(p * p * p * p, kNarrowest2);
}

}  // namespace

float width2(const SplitLobe& lobe)
{
    return own2(lobe.p) + lobe.spread;
}

namespace {

struct Parts {
    std::array<SplitLobe, 2> lobes;
    std::array<float, 2> share;
    float cost;  // - log likelihood of a sample, less what is the same for all
};

// Of samples and the part that each is in; an empty part costs infinity.
Parts parts_of(std::span<const SplitSample> samples, const std::vector<char>& in_second)
{
    Parts to{{}, {}, 0.0f};
    std::array<float, 2> count{}, square{}, p_square{};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t c = in_second[i] ? 1 : 0;
        const SplitSample& s = samples[i];
        SplitLobe& lobe = to.lobes[c];
        count[c] += 1.0f;
        lobe.x += s.x, lobe.y += s.y, lobe.p += s.p;
        square[c] += s.x * s.x + s.y * s.y;
        p_square[c] += own2(s.p);
    }
    for (std::size_t c = 0; c < 2; ++c) {
        if (!(count[c] > 0.0f)) {
            to.cost = INFINITY;
            return to;
        }
        SplitLobe& lobe = to.lobes[c];
        lobe.x /= count[c], lobe.y /= count[c], lobe.p /= count[c];
        lobe.spread = std::max(square[c] / count[c] - lobe.x * lobe.x - lobe.y * lobe.y, 0.0f);
        to.share[c] = count[c] / static_cast<float>(samples.size());
        to.cost += to.share[c] * (portable_log(p_square[c] / count[c] + lobe.spread) - portable_log(to.share[c]));
    }
    return to;
}

// Each sample to the lobe that is likelier for it, a few times over.
Parts settled(std::span<const SplitSample> samples, std::vector<char>& in_second)
{
    Parts parts = parts_of(samples, in_second);
    for (int round = 0; round < kRounds && parts.cost < INFINITY; ++round) {
        std::array<float, 2> constant, inverse;
        for (std::size_t c = 0; c < 2; ++c) {
            const float a2 = width2(parts.lobes[c]);
            inverse[c] = 1.0f / a2;
            constant[c] = portable_log(a2) - portable_log(parts.share[c]);
        }
        bool moved = false;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            std::array<float, 2> cost;
            for (std::size_t c = 0; c < 2; ++c) {
                const float dx = samples[i].x - parts.lobes[c].x, dy = samples[i].y - parts.lobes[c].y;
                cost[c] = constant[c] + (dx * dx + dy * dy + own2(samples[i].p)) * inverse[c];
            }
            const char second = cost[1] < cost[0];
            moved |= second != in_second[i];
            in_second[i] = second;
        }
        if (!moved) break;
        parts = parts_of(samples, in_second);
    }
    return parts;
}

}  // namespace

LobeSplit split_lobes(std::span<const SplitSample> samples)
{
    const std::size_t n = samples.size();
    std::vector<char> in_second(n, 0);
    SplitLobe all{};
    float xx = 0.0f, xy = 0.0f, yy = 0.0f, alpha2 = 0.0f;
    for (const SplitSample& s : samples) {
        all.x += s.x, all.y += s.y, all.p += s.p;
        xx += s.x * s.x, xy += s.x * s.y, yy += s.y * s.y;
        alpha2 += own2(s.p);
    }
    const float each = 1.0f / static_cast<float>(n);
    all.x *= each, all.y *= each, all.p *= each;
    xx = xx * each - all.x * all.x, xy = xy * each - all.x * all.y, yy = yy * each - all.y * all.y;
    all.spread = std::max(xx + yy, 0.0f);
    const float of_one = portable_log(alpha2 * each + all.spread);
    // Along the axis of the normals, of which x is positive, that neighbours agree on the sides.
    const float half = 0.5f * (xx - yy), root = std::sqrt(half * half + xy * xy);
    const float ax = half + root > 1e-9f ? half + root : 0.0f, ay = ax > 0.0f ? xy : 1.0f;
    Parts best{{all, all}, {0.5f, 0.5f}, of_one};
    const auto attempt = [&](const auto& side) {
        for (std::size_t i = 0; i < n; ++i) in_second[i] = side(samples[i]) > 0.0f;
        const Parts parts = settled(samples, in_second);
        if (parts.cost < best.cost) best = parts;
    };
    attempt([&](const SplitSample& s) { return (s.x - all.x) * ax + (s.y - all.y) * ay; });
    attempt([&](const SplitSample& s) { return s.p - all.p; });
    attempt([&](const SplitSample& s) {
        const float dx = s.x - all.x, dy = s.y - all.y;
        return dx * dx + dy * dy - all.spread;
    });
    LobeSplit split{best.lobes, best.share[1], std::max(of_one - best.cost, 0.0f)};
    if (width2(split.lobes[1]) < width2(split.lobes[0])) {
        std::swap(split.lobes[0], split.lobes[1]);
        split.second = 1.0f - split.second;
    }
    return split;
}

float lobe_distance(const SplitLobe& a, const SplitLobe& b)
{
    const float wide_a = width2(a), wide_b = width2(b), dx = a.x - b.x, dy = a.y - b.y;
    const float ratio = portable_log(wide_a / wide_b);
    return 2.0f * (dx * dx + dy * dy) / (wide_a + wide_b) + 0.25f * ratio * ratio;
}

}  // namespace petrichor::texproc::detail
