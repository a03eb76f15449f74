#include "texproc/prefilter/detail/cells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace petrichor::texproc::detail {

void Cells::clear()
{
    for (auto* v : {&nx, &ny, &nz, &alpha2, &weight}) v->clear();
}

void Cells::add(float x, float y, float z, float a2, float w)
{
    nx.push_back(x);
    ny.push_back(y);
    nz.push_back(z);
    alpha2.push_back(a2);
    weight.push_back(w);
}

float lobe_length(float alpha2)
{
    const float sharpness = 2.0f / std::max(alpha2, kMinAlpha2);
    const float coth = sharpness < 10.0f ? 1.0f / std::tanh(sharpness) : 1.0f;
    return coth - 1.0f / sharpness;
}

void gather(const std::vector<SurfaceRow>& rows, std::size_t first_row, const Footprint& x,
            const Footprint& y, Cells& cells, Means& means)
{
    cells.clear();
    double sx = 0, sy = 0, sz = 0, sp = 0, sa = 0;
    for (std::size_t j = 0; j < y.weights.size(); ++j) {
        const SurfaceRow& row = rows[static_cast<std::size_t>(y.first) + j - first_row];
        for (std::size_t i = 0; i < x.weights.size(); ++i) {
            const std::size_t at = static_cast<std::size_t>(x.first) + i;
            const float w = x.weights[i] * y.weights[j];
            const float p = row.p[at];
            const float a2 = std::max((p * p) * (p * p), kMinAlpha2);
            cells.add(row.nx[at], row.ny[at], row.nz[at], a2, w);
            const double weight = static_cast<double>(w);
            sx += weight * static_cast<double>(row.nx[at]);
            sy += weight * static_cast<double>(row.ny[at]);
            sz += weight * static_cast<double>(row.nz[at]);
            sp += weight * static_cast<double>(p);
            sa += weight * static_cast<double>(a2);
        }
    }
    means = {static_cast<float>(sx), static_cast<float>(sy), static_cast<float>(sz),
             static_cast<float>(sp), static_cast<float>(sa), 0, 0, 0};
}

namespace {

std::uint64_t mixed(std::uint64_t v)
{
    v ^= v >> 31;
    v *= 0x9e3779b97f4a7c15ull;
    v ^= v >> 29;
    return v;
}

// One round with grid edges e (slopes) and ep (p). Cells keep the order of their first member, so
// that the result does not depend on addresses.
void merge_round(Cells& cells, float e, float ep)
{
    const std::size_t count = cells.nx.size();
    std::size_t slots = 64;
    while (slots < 2 * count) slots *= 2;
    std::vector<std::uint64_t> keys(slots);
    std::vector<std::int32_t> owner(slots, -1);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float p = std::sqrt(std::sqrt(cells.alpha2[i]));
        const auto gx = static_cast<std::int64_t>(std::floor(cells.nx[i] / e)) + (1 << 20);
        const auto gy = static_cast<std::int64_t>(std::floor(cells.ny[i] / e)) + (1 << 20);
        const auto gp = static_cast<std::int64_t>(p / ep);
        const std::uint64_t key = (static_cast<std::uint64_t>(gx) << 42) |
                                  (static_cast<std::uint64_t>(gy) << 16) |
                                  static_cast<std::uint64_t>(gp);
        std::size_t slot = mixed(key) & (slots - 1);
        while (owner[slot] >= 0 && keys[slot] != key) slot = (slot + 1) & (slots - 1);
        const float w = cells.weight[i];
        const float x = w * cells.nx[i], y = w * cells.ny[i], z = w * cells.nz[i];
        const float a2 = w * cells.alpha2[i];
        if (owner[slot] < 0) {
            owner[slot] = static_cast<std::int32_t>(kept);
            keys[slot] = key;
            cells.nx[kept] = x;
            cells.ny[kept] = y;
            cells.nz[kept] = z;
            cells.alpha2[kept] = a2;
            cells.weight[kept] = w;
            ++kept;
        } else {
            const std::size_t k = static_cast<std::size_t>(owner[slot]);
            cells.nx[k] += x;
            cells.ny[k] += y;
            cells.nz[k] += z;
            cells.alpha2[k] += a2;
            cells.weight[k] += w;
        }
    }
    for (auto* v : {&cells.nx, &cells.ny, &cells.nz, &cells.alpha2, &cells.weight}) v->resize(kept);
    for (std::size_t k = 0; k < kept; ++k) {
        const float length =
            std::sqrt(cells.nx[k] * cells.nx[k] + cells.ny[k] * cells.ny[k] +
                      cells.nz[k] * cells.nz[k]);
        const float scale = length > 0.0f ? 1.0f / length : 0.0f;
        cells.nx[k] *= scale;
        cells.ny[k] *= scale;
        cells.nz[k] = length > 0.0f ? cells.nz[k] * scale : 1.0f;
        // What the normals differ within the cell widens its lobe: E |d|^2 = 2 (1 - r). Without it
        // every round of merging would narrow the footprint by some per cent.
        const float lost = 2.0f * std::max(0.0f, 1.0f - length / cells.weight[k]);
        cells.alpha2[k] = cells.alpha2[k] / cells.weight[k] + lost;
    }
}

}  // namespace

void merge(Cells& cells, int limit)
{
    if (cells.count() <= limit) return;
    // Weightless cells (parts of a footprint that rounding left empty) have no mean.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < cells.nx.size(); ++i) {
        if (!(cells.weight[i] > 0.0f)) continue;
        cells.nx[kept] = cells.nx[i];
        cells.ny[kept] = cells.ny[i];
        cells.nz[kept] = cells.nz[i];
        cells.alpha2[kept] = cells.alpha2[i];
        cells.weight[kept++] = cells.weight[i];
    }
    for (auto* v : {&cells.nx, &cells.ny, &cells.nz, &cells.alpha2, &cells.weight}) v->resize(kept);
    const float narrowest = *std::min_element(cells.alpha2.begin(), cells.alpha2.end());
    float e = std::max(0.2f * std::sqrt(narrowest), 0.001f);
    float ep = 0.02f;
    while (cells.count() > limit) {
        merge_round(cells, e, ep);
        e *= 1.35f;
        if (e > 0.5f) ep *= 1.35f;  // all normals in a few cells: only the gloss keeps them apart
    }
}

}  // namespace petrichor::texproc::detail
