#include "texproc/prefilter/detail/lobe_cost.h"

#include <algorithm>
#include <cmath>

namespace petrichor::texproc::detail {

namespace {

// How much diffuse light counts beside mirrored light: a normal half a radian off costs a sixth
// of the lobe.
constexpr float kDiffuseShare = 0.7f;

}  // namespace

Whole whole_of(const CellsView& cells, const Means& means)
{
    Whole whole{{}, {means.nx, means.ny, means.nz}};
    for (int i = 0; i < cells.count; ++i) {
        float mine[kViews];
        lobe_albedo_in_views(cells.alpha2[i], {cells.nx[i], cells.ny[i], cells.nz[i]}, mine);
        for (std::size_t v = 0; v < kViews; ++v) whole.mass[v] += cells.weight[i] * mine[v];
    }
    return whole;
}

LobeCost::LobeCost(const CellsView& cells, const Whole& whole, int samples, std::uint32_t seed,
                   Samples& storage)
    : kernel_(lobe_kernel()),
      storage_(storage),
      whole_(whole),
      length_(std::sqrt(dot(whole.mean, whole.mean)))
{
    storage_.draw(cells, samples, seed, kernel_);
}

// |n - mean|^2 - (1 - length)^2 of a unit normal.
float LobeCost::diffuse(const Direction& n) const
{
    return kDiffuseShare * std::max(0.0f, 2.0f * (length_ - dot(n, whole_.mean)));
}

void LobeCost::operator()(const Direction& n, const float* alpha2s, int count, float* costs) const
{
    const float turned = diffuse(n);
    float overlaps[kViews * kMost];
    kernel_.overlaps(storage_.view(), {n.x, n.y, n.z, 0.0f}, alpha2s, count, overlaps);
    for (int k = 0; k < count; ++k) {
        float sum = 0.0f, mine[kViews];
        int views = 0;
        lobe_albedo_in_views(alpha2s[k], n, mine);
        for (int v = 0; v < kViews; ++v) {
            const float r = whole_.mass[static_cast<std::size_t>(v)];
            if (!(r > 1e-6f)) continue;
            sum += std::min(2.0f, std::max(0.0f, (r + mine[v] - overlaps[v * count + k]) / r));
            ++views;
        }
        costs[k] = turned + (views ? sum / static_cast<float>(views) : 0.0f);
    }
}

float LobeCost::operator()(const Direction& n, float alpha2) const
{
    float cost;
    (*this)(n, &alpha2, 1, &cost);
    return cost;
}

float LobeCost::operator()(const EllipticLobe& e) const
{
    float overlaps[kViews];
    kernel_.elliptic_overlap(storage_.view(), e, overlaps);
    float sum = 0.0f;
    int views = 0;
    for (int v = 0; v < kViews; ++v) {
        const float r = whole_.mass[static_cast<std::size_t>(v)];
        if (!(r > 1e-6f)) continue;
        const float* d = kViewDirections[v];
        const float nv = e.nx * d[0] + e.ny * d[1] + e.nz * d[2];
        const float tv = e.tx * d[0] + e.ty * d[1] + e.tz * d[2];
        const float bv = e.bx * d[0] + e.by * d[1] + e.bz * d[2];
        // The width that this view sees decides how much is shadowed.
        const float across = tv * tv + bv * bv;
        const float seen = across > 1e-6f ? (e.alpha2_x * tv * tv + e.alpha2_y * bv * bv) / across
                                          : std::sqrt(e.alpha2_x * e.alpha2_y);
        const float m = lobe_albedo(seen, nv);
        sum += std::min(2.0f, std::max(0.0f, (r + m - overlaps[v]) / r));
        ++views;
    }
    return diffuse({e.nx, e.ny, e.nz}) + (views ? sum / static_cast<float>(views) : 0.0f);
}

Candidate LobeCost::mode() const
{
    const SamplesView s = storage_.view();
    int best = 0;
    for (int k = 1; k < kViews * s.per_view; ++k) {
        if (s.density[k] > s.density[best]) best = k;
    }
    const float alpha2 = 1.0f / (3.14159265f * std::max(s.density[best], 1e-3f));
    return {{s.hx[best], s.hy[best], s.hz[best]}, std::clamp(alpha2, kMinAlpha2, 1.0f)};
}

Direction leaned(const Frame& frame, float u, float v)
{
    return normalized({frame.n.x + u * frame.t.x + v * frame.b.x,
                       frame.n.y + u * frame.t.y + v * frame.b.y,
                       frame.n.z + u * frame.t.z + v * frame.b.z});
}

}  // namespace petrichor::texproc::detail
