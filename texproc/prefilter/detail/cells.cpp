#include "texproc/prefilter/detail/cells.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/portable_math.h"

namespace petrichor::texproc::detail {

void Cells::clear()
{
    for (auto* v : {&nx, &ny, &nz, &alpha2, &weight}) v->clear();
}

void Cells::resize(std::size_t count)
{
    if (count == nx.size()) return;  // as for most footprints
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

namespace {

// Four texels, and their terms in the exact sums.
using Four = float __attribute__((vector_size(16)));
using FourSums = double __attribute__((vector_size(32)));

Four load(const float* from)
{
    Four v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
void store(float* to, const Four& v)
{
    std::memcpy(to, &v, sizeof v);
}

// Weighted sums over a footprint: of n_x, n_y, n_z, p, alpha^2.
using Sums = std::array<double, 5>;

// A row of texels to its place among the cells, and to the sums; x_weights has `count`.
struct RowOfCells {
    const float *nx, *ny, *nz, *p, *alpha2;  // from
    float *to_nx, *to_ny, *to_nz, *to_alpha2, *to_weight;
};

// The row of a texel of level 1.
void add_two(const RowOfCells& r, const float* x_weights, float y_weight, Sums& sums)
{
    const float w0 = x_weights[0] * y_weight, w1 = x_weights[1] * y_weight;
    const auto pair = [](const float* from, float* to) {
        to[0] = from[0];
        to[1] = from[1];
    };
    pair(r.nx, r.to_nx);
    pair(r.ny, r.to_ny);
    pair(r.nz, r.to_nz);
    pair(r.alpha2, r.to_alpha2);
    r.to_weight[0] = w0;
    r.to_weight[1] = w1;
    const double d0 = static_cast<double>(w0), d1 = static_cast<double>(w1);
    const auto sum = [&](const float* v) {
        return d0 * static_cast<double>(v[0]) + d1 * static_cast<double>(v[1]);
    };
    sums[0] += sum(r.nx);
    sums[1] += sum(r.ny);
    sums[2] += sum(r.nz);
    sums[3] += sum(r.p);
    sums[4] += sum(r.alpha2);
}

void add_row(const RowOfCells& r, const float* x_weights, float y_weight, std::size_t count,
             Sums& sums)
{
    if (count == 2) return add_two(r, x_weights, y_weight, sums);
    FourSums lanes[5] = {};
    std::size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        const Four weight = load(x_weights + i) * y_weight;
        const Four nx = load(r.nx + i), ny = load(r.ny + i), nz = load(r.nz + i);
        const Four p = load(r.p + i), alpha2 = load(r.alpha2 + i);
        store(r.to_nx + i, nx);
        store(r.to_ny + i, ny);
        store(r.to_nz + i, nz);
        store(r.to_alpha2 + i, alpha2);
        store(r.to_weight + i, weight);
        const FourSums w = __builtin_convertvector(weight, FourSums);
        lanes[0] += w * __builtin_convertvector(nx, FourSums);
        lanes[1] += w * __builtin_convertvector(ny, FourSums);
        lanes[2] += w * __builtin_convertvector(nz, FourSums);
        lanes[3] += w * __builtin_convertvector(p, FourSums);
        lanes[4] += w * __builtin_convertvector(alpha2, FourSums);
    }
    for (; i < count; ++i) {
        const float weight = x_weights[i] * y_weight;
        r.to_nx[i] = r.nx[i];
        r.to_ny[i] = r.ny[i];
        r.to_nz[i] = r.nz[i];
        r.to_alpha2[i] = r.alpha2[i];
        r.to_weight[i] = weight;
        const float* const values[5] = {r.nx, r.ny, r.nz, r.p, r.alpha2};
        for (std::size_t k = 0; k < 5; ++k) {
            lanes[k][0] += static_cast<double>(weight) * static_cast<double>(values[k][i]);
        }
    }
    for (std::size_t k = 0; k < 5; ++k) {
        sums[k] += (lanes[k][0] + lanes[k][2]) + (lanes[k][1] + lanes[k][3]);
    }
}

}  // namespace

void gather(const std::vector<SurfaceRow>& rows, std::size_t first_row, const Footprint& x,
            const Footprint& y, Cells& cells, Means& means)
{
    const std::size_t width = x.weights.size();
    const std::size_t at = static_cast<std::size_t>(x.first);
    cells.resize(width * y.weights.size());
    Sums sums{};
    for (std::size_t j = 0; j < y.weights.size(); ++j) {
        const SurfaceRow& row = rows[static_cast<std::size_t>(y.first) + j - first_row];
        const std::size_t to = j * width;
        add_row({&row.nx[at], &row.ny[at], &row.nz[at], &row.p[at], &row.alpha2[at], &cells.nx[to],
                 &cells.ny[to], &cells.nz[to], &cells.alpha2[to], &cells.weight[to]},
                x.weights.data(), y.weights[j], width, sums);
    }
    const auto mean = [&](std::size_t k) { return static_cast<float>(sums[k]); };
    means = {mean(0), mean(1), mean(2), mean(3), mean(4), 0, 0, 0};
}

namespace {

// The place of every cell in the grid of merge_round(), as one number: edges are at least 0.001 and
// 0.02, so that 11, 11 and 6 bits hold it. A plain loop, which compilers vectorise.
void find_places(const Cells& cells, float share, float ep, std::vector<std::uint32_t>& places)
{
    const std::size_t count = cells.nx.size();
    places.resize(count);
    const float per_ep = 1.0f / ep;
    const float* nx = cells.nx.data();
    const float* ny = cells.ny.data();
    const float* alpha2 = cells.alpha2.data();
    for (std::size_t i = 0; i < count; ++i) {
        const float p = std::sqrt(std::sqrt(alpha2[i]));
        const std::int32_t gp = static_cast<std::int32_t>(p * per_ep);
        const float middle = (static_cast<float>(gp) + 0.5f) * ep;
        const float edge = share * middle * middle;
        const float per_e = 1.0f / (edge > 0.001f ? edge : 0.001f);
        const std::int32_t gx = static_cast<std::int32_t>((nx[i] + 1.0f) * per_e);
        const std::int32_t gy = static_cast<std::int32_t>((ny[i] + 1.0f) * per_e);
        places[i] = static_cast<std::uint32_t>(gx << 17 | gy << 6 | gp);
    }
}

// Which cells share a place: numbers in the order of their first member.
struct Slot {
    std::uint32_t place;
    std::int32_t number;  // -1: free
};

// A cell that grows: sums of weight times normal, alpha^2 and weight itself.
struct Sum {
    float nx, ny, nz, alpha2, weight;
};

// Sums of cells become their means; another plain loop.
void to_means(Cells& cells)
{
    for (std::size_t k = 0; k < cells.nx.size(); ++k) {
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

// One round with grid edges of ep in p and, in the normals, of `share` of the alpha there: what
// narrow lobes must keep apart is nothing to wide ones. Cells keep the order of their first member,
// so that the result does not depend on addresses.
void merge_round(Cells& cells, float share, float ep)
{
    thread_local std::vector<std::uint32_t> places;
    thread_local std::vector<Slot> slots;
    thread_local std::vector<Sum> sums;
    const std::size_t count = cells.nx.size();
    find_places(cells, share, ep, places);
    std::size_t size = 64;
    while (size < 2 * count) size *= 2;
    const int shift = 32 - std::countr_zero(size);
    slots.assign(size, {0, -1});
    sums.resize(count);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t place = places[i];
        std::size_t at = (place * 2654435769u) >> shift;
        while (slots[at].number >= 0 && slots[at].place != place) at = (at + 1) & (size - 1);
        const float w = cells.weight[i];
        const Sum now{w * cells.nx[i], w * cells.ny[i], w * cells.nz[i], w * cells.alpha2[i], w};
        if (slots[at].number < 0) {
            slots[at] = {place, static_cast<std::int32_t>(kept)};
            sums[kept++] = now;
            continue;
        }
        Sum& sum = sums[static_cast<std::size_t>(slots[at].number)];
        sum.nx += now.nx;
        sum.ny += now.ny;
        sum.nz += now.nz;
        sum.alpha2 += now.alpha2;
        sum.weight += now.weight;
    }
    cells.resize(kept);
    for (std::size_t k = 0; k < kept; ++k) {
        const Sum& s = sums[k];
        cells.nx[k] = s.nx;
        cells.ny[k] = s.ny;
        cells.nz[k] = s.nz;
        cells.alpha2[k] = s.alpha2;
        cells.weight[k] = s.weight;
    }
    to_means(cells);
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
    const bool large_steps = most == 0;
    most = std::max(limit, most);
    float share = std::max(large_steps ? 0.3f : 0.2f, useful_edge(cells, limit) / widest);
    if (share > kFaithful) {
        const float useful = cells.count() > most ? useful_edge(cells, most) / widest : 0.0f;
        share = std::max(kFaithful, useful);
    }
    float ep = 0.02f;
    while (cells.count() > limit && !(share > kFaithful && cells.count() <= most)) {
        merge_round(cells, share, ep);
        // Far from the limit in larger steps, but not far past it: cells that are lost blur the
        // lobe. Twice the edge leaves about half the cells of a real map.
        const float over = static_cast<float>(cells.count()) / static_cast<float>(limit);
        const float root = std::sqrt(over), fourth = std::sqrt(root);
        const float growth = large_steps ? std::clamp(1.2f * root * fourth, 1.2f, 4.0f)
                                         : std::clamp(fourth, 1.2f, 2.0f);
        share *= growth;
        ep *= std::sqrt(std::sqrt(growth));
    }
}

}  // namespace petrichor::texproc::detail
