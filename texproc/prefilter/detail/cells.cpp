#include "texproc/prefilter/detail/cells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "texproc/detail/portable_math.h"

namespace petrichor::texproc::detail {

void Cells::clear()
{
    for (auto* v : {&nx, &ny, &nz, &alpha2, &weight}) v->clear();
}

void Cells::resize(std::size_t count)
{
    for (auto* v : {&nx, &ny, &nz, &alpha2, &weight}) v->resize(count);
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
    if (sharpness >= 10.0f) return 1.0f - 1.0f / sharpness;
    const float e = portable_exp(2.0f * sharpness);
    return (e + 1.0f) / (e - 1.0f) - 1.0f / sharpness;
}

void gather(const std::vector<SurfaceRow>& rows, std::size_t first_row, const Footprint& x,
            const Footprint& y, Cells& cells, Means& means)
{
    cells.resize(x.weights.size() * y.weights.size());
    std::size_t to = 0;
    double sx = 0, sy = 0, sz = 0, sp = 0, sa = 0;
    for (std::size_t j = 0; j < y.weights.size(); ++j) {
        const SurfaceRow& row = rows[static_cast<std::size_t>(y.first) + j - first_row];
        for (std::size_t i = 0; i < x.weights.size(); ++i, ++to) {
            const std::size_t at = static_cast<std::size_t>(x.first) + i;
            const float w = x.weights[i] * y.weights[j];
            const float p = row.p[at];
            const float a2 = std::max((p * p) * (p * p), kMinAlpha2);
            cells.nx[to] = row.nx[at];
            cells.ny[to] = row.ny[at];
            cells.nz[to] = row.nz[at];
            cells.alpha2[to] = a2;
            cells.weight[to] = w;
            const double weight = static_cast<double>(w);
            sx += weight * static_cast<double>(row.nx[at]);
            sy += weight * static_cast<double>(row.ny[at]);
            sz += weight * static_cast<double>(row.nz[at]);
            sp += weight * static_cast<double>(p);
            sa += weight * static_cast<double>(a2);
        }
    }
    means = {static_cast<float>(sx),
             static_cast<float>(sy),
             static_cast<float>(sz),
             static_cast<float>(sp),
             static_cast<float>(sa),
             0,
             0,
             0};
}

namespace {

std::uint64_t mixed(std::uint64_t v)
{
    v ^= v >> 31;
    v *= 0x9e3779b97f4a7c15ull;
    v ^= v >> 29;
    return v;
}

// The place of every cell in the grid of merge_round(); plain loops, which compilers vectorise.
void find_places(const Cells& cells, float share, float ep, std::vector<std::int32_t>& places)
{
    const std::size_t count = cells.nx.size();
    places.resize(3 * count);
    std::int32_t* gx = places.data();
    std::int32_t* gy = gx + count;
    std::int32_t* gp = gy + count;
    const float per_ep = 1.0f / ep;
    const float* nx = cells.nx.data();
    const float* ny = cells.ny.data();
    const float* alpha2 = cells.alpha2.data();
    for (std::size_t i = 0; i < count; ++i) {
        const float p = std::sqrt(std::sqrt(alpha2[i]));
        gp[i] = static_cast<std::int32_t>(p * per_ep);
        const float middle = (static_cast<float>(gp[i]) + 0.5f) * ep;
        const float edge = share * middle * middle;
        const float per_e = 1.0f / (edge > 0.001f ? edge : 0.001f);
        gx[i] = static_cast<std::int32_t>((nx[i] + 1.0f) * per_e);
        gy[i] = static_cast<std::int32_t>((ny[i] + 1.0f) * per_e);
    }
}

// One round with grid edges of ep in p and, in the normals, of `share` of the alpha there: what
// narrow lobes must keep apart is nothing to wide ones. Cells keep the order of their first member,
// so that the result does not depend on addresses.
void merge_round(Cells& cells, float share, float ep)
{
    const std::size_t count = cells.nx.size();
    std::size_t slots = 64;
    while (slots < 2 * count) slots *= 2;
    thread_local std::vector<std::uint64_t> keys;
    thread_local std::vector<std::int32_t> owner, places;
    find_places(cells, share, ep, places);
    const std::int32_t* gx = places.data();
    const std::int32_t* gy = gx + count;
    const std::int32_t* gp = gy + count;
    keys.resize(slots);
    owner.assign(slots, -1);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t key = (static_cast<std::uint64_t>(gx[i]) << 42) |
                                  (static_cast<std::uint64_t>(gy[i]) << 16) |
                                  static_cast<std::uint64_t>(gp[i]);
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
    cells.resize(kept);
    for (std::size_t k = 0; k < kept; ++k) {
        const float length = std::sqrt(cells.nx[k] * cells.nx[k] + cells.ny[k] * cells.ny[k] +
                                       cells.nz[k] * cells.nz[k]);
        const float scale = length > 0.0f ? 1.0f / length : 0.0f;
        cells.nx[k] *= scale;
        cells.ny[k] *= scale;
        cells.nz[k] = length > 0.0f ? cells.nz[k] * scale : 1.0f;
        // What the normals differ within the cell widens its lobe: E |d|^2 = 2 (1 - r). Without it
        // every round of merging would narrow the footprint by some per cent.
        const float lost = 1.76f * std::max(0.0f, 1.0f - length / cells.weight[k]);
        cells.alpha2[k] = cells.alpha2[k] / cells.weight[k] + lost;
    }
}

// Where Gaussian slopes of this spread would still fill more than twice `limit` cells of a grid:
// finer grids are a waste.
float useful_edge(const Cells& cells, int limit)
{
    float w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for (std::size_t i = 0; i < cells.nx.size(); ++i) {
        const float wi = cells.weight[i], nx = cells.nx[i], ny = cells.ny[i];
        w += wi;
        x += wi * nx;
        y += wi * ny;
        xx += wi * nx * nx;
        xy += wi * nx * ny;
        yy += wi * ny * ny;
    }
    x /= w;
    y /= w;
    const float sxx = xx / w - x * x, sxy = xy / w - x * y, syy = yy / w - y * y;
    const float area = std::sqrt(std::max(0.0f, sxx * syy - sxy * sxy));
    return std::sqrt(6.0f * area / static_cast<float>(limit));
}

// Lobes further apart than this share of their alpha are two: one in their place, as wide as both,
// shares light with everything between them.
constexpr float kFaithful = 0.7f;

}  // namespace

void merge(Cells& cells, int limit, int most)
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
    cells.resize(kept);
    const float widest = std::sqrt(*std::max_element(cells.alpha2.begin(), cells.alpha2.end()));
    most = std::max(limit, most);
    float share = std::max(0.2f, useful_edge(cells, limit) / widest);
    if (share > kFaithful) {
        const float useful = cells.count() > most ? useful_edge(cells, most) / widest : 0.0f;
        share = std::max(kFaithful, useful);
    }
    float ep = 0.02f;
    while (cells.count() > limit && !(share > kFaithful && cells.count() <= most)) {
        merge_round(cells, share, ep);
        // Far from the limit in larger steps, but not past it: cells that are lost blur the lobe.
        const float over = static_cast<float>(cells.count()) / static_cast<float>(limit);
        const float growth = std::clamp(std::sqrt(std::sqrt(over)), 1.2f, 2.0f);
        share *= growth;
        ep *= std::sqrt(std::sqrt(growth));
    }
}

}  // namespace petrichor::texproc::detail
