#include "texproc/prefilter/detail/lobe_tools.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/portable_math.h"

namespace petrichor::texproc::detail {

Direction normalized(Direction d)
{
    const float length = std::sqrt(dot(d, d));
    if (!(length > 1e-12f)) return {};
    return {d.x / length, d.y / length, d.z / length};
}

Frame frame_about(const Direction& n)
{
    const float sign = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {
        n, {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

namespace {

constexpr int kTable = 33;

// Each entry by a lattice of half-vectors drawn from the lobe: the mean of G2 (v.h) / (n.v)(n.h).
std::array<float, kTable * kTable> make_albedo_table()
{
    std::array<float, kTable * kTable> table{};
    constexpr int kPoints = 512;
    for (int i = 0; i < kTable; ++i) {
        const double p = static_cast<double>(i) / (kTable - 1);
        const double a2 = std::max(p * p * p * p, 1e-6);
        for (int j = 0; j < kTable; ++j) {
            const double mu = std::max(static_cast<double>(j) / (kTable - 1), 1e-3);
            const double vx = std::sqrt(1.0 - mu * mu);
            double sum = 0.0;
            for (int k = 0; k < kPoints; ++k) {
                const double u = (k + 0.5) / kPoints;
                const double turn = k * 0.6180339887498949;
                const double phi = 6.283185307179586 * (turn - std::floor(turn));
                const double tan2 = a2 * u / (1.0 - u);
                const double hz = 1.0 / std::sqrt(1.0 + tan2);
                const double hx = std::sqrt(tan2) * hz * portable_sin_cos(phi).cosine;
                const double vh = vx * hx + mu * hz;
                const double nl = 2.0 * vh * hz - mu;
                if (vh <= 0.0 || nl <= 0.0) continue;
                const double sv = std::sqrt(mu * mu * (1.0 - a2) + a2);
                const double sl = std::sqrt(nl * nl * (1.0 - a2) + a2);
                const double visibility = 0.5 / (nl * sv + mu * sl);
                sum += visibility * nl * 4.0 * vh / hz;
            }
            table[static_cast<std::size_t>(i * kTable + j)] = static_cast<float>(sum / kPoints);
        }
    }
    return table;
}

}  // namespace

namespace {

// The table as bilinear patches: c0 + c1 y + x (c2 + c3 y), one load each.
struct Patch {
    float c0, c1, c2, c3;
};
constexpr int kPatches = kTable - 1;

std::array<Patch, kPatches * kPatches> make_patches()
{
    const auto table = make_albedo_table();
    std::array<Patch, kPatches * kPatches> patches;
    for (std::size_t i = 0; i < kPatches; ++i) {
        for (std::size_t j = 0; j < kPatches; ++j) {
            const float* t = &table[i * kTable + j];
            patches[i * kPatches + j] = {t[0], t[1] - t[0], t[kTable] - t[0],
                                         (t[kTable + 1] - t[kTable]) - (t[1] - t[0])};
        }
    }
    return patches;
}

const Patch* patches()
{
    static const std::array<Patch, kPatches* kPatches> all = make_patches();
    return all.data();
}

// Row of the table for a width, and how far towards the next.
struct Row {
    const Patch* row;
    float share;
};
Row albedo_row(float alpha2)
{
    const float x = std::sqrt(std::sqrt(alpha2)) * kPatches;
    const int i = std::min(kPatches - 1, static_cast<int>(x));
    return {patches() + i * kPatches, std::min(1.0f, x - static_cast<float>(i))};
}

float albedo_at(const Row& r, float mu)
{
    const float y = std::max(0.0f, mu) * kPatches;
    const int j = std::min(kPatches - 1, static_cast<int>(y));
    const float fy = y - static_cast<float>(j);
    const Patch& p = r.row[j];
    const float value = (p.c0 + fy * p.c1) + r.share * (p.c2 + fy * p.c3);
    return mu > 0.0f ? value : 0.0f;
}

}  // namespace

float lobe_albedo(float alpha2, float mu)
{
    return albedo_at(albedo_row(alpha2), mu);
}

void lobe_albedo_in_views(float alpha2, const Direction& n, float* out)
{
    const Row row = albedo_row(alpha2);
    for (int v = 0; v < kViews; ++v) {
        const float* d = kViewDirections[v];
        out[v] = albedo_at(row, n.x * d[0] + n.y * d[1] + n.z * d[2]);
    }
}

void Samples::resize(int per_view)
{
    assert(per_view % kLanes == 0);
    per_view_ = per_view;
    data_.resize(static_cast<std::size_t>(9 * kViews * per_view));
    cell_.resize(static_cast<std::size_t>(kViews * per_view));
}

SamplesView Samples::view()
{
    const std::size_t n = static_cast<std::size_t>(kViews * per_view_);
    float* d = data_.data();
    return {per_view_, d,         d + n,     d + 2 * n, d + 3 * n,
            d + 4 * n, d + 5 * n, d + 6 * n, d + 7 * n, d + 8 * n};
}

namespace {

constexpr int kMostSamples = 2560;

// Sample j of the rank-1 lattice serves view j mod kViews.
struct Lattice {
    static constexpr int kPerView = kMostSamples / kViews;
    std::array<float, kMostSamples> u, cosine, sine;
    Lattice()
    {
        for (int j = 0; j < kMostSamples; ++j) {
            const auto k = static_cast<std::size_t>(j % kViews * kPerView + j / kViews);
            const double a = 0.7548776662466927 * j, b = 0.5698402909980532 * j;
            u[k] = static_cast<float>(a - std::floor(a));
            const double phi = 6.283185307179586 * (b - std::floor(b));
            cosine[k] = static_cast<float>(portable_sin_cos(phi).cosine);
            sine[k] = static_cast<float>(portable_sin_cos(phi).sine);
        }
    }
};
LatticeView lattice()
{
    static const Lattice points;
    return {Lattice::kPerView, points.u.data(), points.cosine.data(), points.sine.data()};
}

float unit_float(std::uint32_t& state)
{
    state ^= state >> 16;
    state *= 0x7feb352du;
    state ^= state >> 15;
    state *= 0x846ca68bu;
    state ^= state >> 16;
    return static_cast<float>(state >> 8) / 16777216.0f;
}

}  // namespace

void Samples::draw(const CellsView& cells, int total, std::uint32_t seed, const LobeKernel& kernel)
{
    assert(total % (kViews * kLanes) == 0 && total <= kMostSamples);
    resize(total / kViews);
    std::uint32_t state = seed * 0x9e3779b9u + 0x85ebca6bu;
    const float shift = unit_float(state);
    const float shift_u = unit_float(state);
    const float angle = 6.2831853f * unit_float(state);
    // Systematic choice of the cells by cumulated weight.
    float whole = 0.0f;
    for (int i = 0; i < cells.count; ++i) whole += cells.weight[i];
    const float step = whole / static_cast<float>(total);
    int cell = 0;
    float reached = cells.weight[0];
    for (int j = 0, i = 0; i < per_view_; ++i) {
        for (int v = 0; v < kViews; ++v, ++j) {
            const float target = (static_cast<float>(j) + shift) * step;
            while (reached <= target && cell + 1 < cells.count) reached += cells.weight[++cell];
            cell_[static_cast<std::size_t>(v * per_view_ + i)] = cell;
        }
    }
    kernel.place(cells, {shift_u, portable_cos(angle), portable_sin(angle)}, lattice(),
                 cell_.data(), view());
    kernel.shade(cells, view());
    kernel.weigh(view());
}

namespace {

// Squared slope distance of a cell from `normal`; a normal that turns away counts as very far.
float slope2(const Direction& normal, float x, float y, float z)
{
    const float c = std::max(1e-2f, normal.x * x + normal.y * y + normal.z * z);
    const float sx = normal.y * z - normal.z * y;
    const float sy = normal.z * x - normal.x * z;
    const float sz = normal.x * y - normal.y * x;
    return (sx * sx + sy * sy + sz * sz) / (c * c);
}

int padded(int count)
{
    return (count + kLanes - 1) / kLanes * kLanes;
}

}  // namespace

float median_alpha2(const CellsView& cells, const Direction& normal, const LobeKernel& kernel)
{
    constexpr int kSmall = 256;
    float small_s[kSmall], small_w[kSmall];
    std::vector<float> large;
    const int count = padded(cells.count);
    float* s = small_s;
    float* w = small_w;
    if (count > kSmall) {
        large.resize(2 * static_cast<std::size_t>(count));
        s = large.data();
        w = s + count;
    }
    return kernel.median(cells, normal.x, normal.y, normal.z, s, w);
}

float share_inside(const CellsView& cells, const Direction& normal, float light2, float alpha2)
{
    float share = 0.0f, whole = 0.0f;
    for (int i = 0; i < cells.count; ++i) {
        const float s =
            cells.alpha2[i] + light2 + slope2(normal, cells.nx[i], cells.ny[i], cells.nz[i]);
        share += cells.weight[i] * alpha2 / (alpha2 + s);
        whole += cells.weight[i];
    }
    return share / whole;
}

float slope_variance(const CellsView& cells, const Direction& normal)
{
    const Frame f = frame_about(normal);
    float whole = 0, mx = 0, my = 0, m2 = 0;
    for (int i = 0; i < cells.count; ++i) {
        const Direction n{cells.nx[i], cells.ny[i], cells.nz[i]};
        const float c = std::max(1e-2f, dot(f.n, n));
        const float x = dot(f.t, n) / c, y = dot(f.b, n) / c;
        const float w = cells.weight[i];
        whole += w;
        mx += w * x;
        my += w * y;
        m2 += w * (x * x + y * y);
    }
    mx /= whole;
    my /= whole;
    return std::max(0.0f, m2 / whole - mx * mx - my * my);
}

RobustFit student_t(const CellsView& cells, const Direction& start, float start_alpha2, int frames,
                    int rounds, bool elliptic, const LobeKernel& kernel)
{
    static constexpr float kRing[4] = {0.37796447f, 0.77459667f, 1.29099445f, 2.64575131f};
    static constexpr float kTurn[4][2] = {{0.92387953f, 0.38268343f},
                                          {0.70710678f, 0.70710678f},
                                          {0.38268343f, 0.92387953f},
                                          {1.0f, 0.0f}};
    const int count = 16 * cells.count;  // a multiple of kLanes
    std::vector<float> points(3 * static_cast<std::size_t>(count));
    float* sx = points.data();
    float* sy = sx + count;
    float* sw = sy + count;
    RobustFit fit{start, start_alpha2, start_alpha2, 0.0f, start_alpha2};
    for (int f = 0; f < frames; ++f) {
        const Frame frame = frame_about(fit.normal);
        for (int i = 0; i < cells.count; ++i) {
            const Direction n{cells.nx[i], cells.ny[i], cells.nz[i]};
            const float c = std::max(5e-2f, dot(frame.n, n));
            const float x = dot(frame.t, n) / c, y = dot(frame.b, n) / c;
            const float alpha = std::sqrt(cells.alpha2[i]);
            for (int k = 0; k < 16; ++k) {
                const int ring = k / 4;
                const float r = alpha * kRing[ring];
                float ux = kTurn[ring][0], uy = kTurn[ring][1];
                if (k & 1) std::swap(ux, uy), ux = -ux;
                if (k & 2) ux = -ux, uy = -uy;
                const int at = 16 * i + k;
                sx[at] = x + r * ux;
                sy[at] = y + r * uy;
                sw[at] = cells.weight[i] / 16.0f;
            }
        }
        const SlopesView slopes{sx, sy, sw, count};
        float cx = 0.0f, cy = 0.0f;
        float xx = fit.alpha2, xy = 0.0f, yy = fit.alpha2;
        for (int round = 0; round < rounds; ++round) {
            const float det = std::max(xx * yy - xy * xy, 1e-18f);
            const SlopeSums s = kernel.reweighted(slopes, cx, cy, yy / det, -xy / det, xx / det);
            // The spread is about the old centre; about the new one it is less by its move.
            const float nx = s.x / s.w, ny = s.y / s.w;
            const float dx = nx - cx, dy = ny - cy;
            xx = 4.0f * (s.xx - s.w * dx * dx);
            xy = 4.0f * (s.xy - s.w * dx * dy);
            yy = 4.0f * (s.yy - s.w * dy * dy);
            if (!elliptic) {
                xx = yy = 0.5f * (xx + yy);
                xy = 0.0f;
            }
            xx = std::max(xx, kMinAlpha2);
            yy = std::max(yy, kMinAlpha2);
            cx = nx;
            cy = ny;
        }
        fit.normal = normalized({frame.n.x + cx * frame.t.x + cy * frame.b.x,
                                 frame.n.y + cx * frame.t.y + cy * frame.b.y,
                                 frame.n.z + cx * frame.t.z + cy * frame.b.z});
        fit.alpha2 = 0.5f * (xx + yy);
        fit.a_xx = xx;
        fit.a_xy = xy;
        fit.a_yy = yy;
        if (fit.normal.z < 0.05f) {  // tipped over: no such lobe can be stored
            fit.normal = start;
            return fit;
        }
    }
    return fit;
}

}  // namespace petrichor::texproc::detail
