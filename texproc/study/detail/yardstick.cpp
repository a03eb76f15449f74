#include "texproc/study/detail/yardstick.h"

#include <algorithm>
#include <cmath>

namespace petrichor::texproc::detail {

namespace {

double halton(int index, int base)
{
    double value = 0.0, share = 1.0 / base;
    for (int i = index + 1; i > 0; i /= base, share /= base) value += share * (i % base);
    return value;
}

}  // namespace

double lobe_density(double alpha2, const Direction& n, double hx, double hy, double hz)
{
    const double c = static_cast<double>(n.x) * hx + static_cast<double>(n.y) * hy +
                     static_cast<double>(n.z) * hz;
    if (c <= 0.0) return 0.0;
    const double sx = static_cast<double>(n.y) * hz - static_cast<double>(n.z) * hy;
    const double sy = static_cast<double>(n.z) * hx - static_cast<double>(n.x) * hz;
    const double sz = static_cast<double>(n.x) * hy - static_cast<double>(n.y) * hx;
    const double t = sx * sx + sy * sy + sz * sz + alpha2 * c * c;
    return c * alpha2 / (3.141592653589793 * t * t);
}

std::vector<float> widths_between(float narrow2, float wide2)
{
    const float ratio = std::sqrt(wide2 / narrow2);
    const int steps = std::max(1, static_cast<int>(std::ceil(std::log(ratio) / std::log(4.0f))));
    std::vector<float> widths;
    for (int i = 0; i <= steps; ++i) {
        widths.push_back(
            narrow2 * std::pow(wide2 / narrow2, static_cast<float>(i) / static_cast<float>(steps)));
    }
    return widths;
}

void place_points(const Cells& cells, const Direction& mean, const std::vector<float>& widths,
                  int points, Random& random, Samples& samples)
{
    const int n = (points + kLanes - 1) / kLanes * kLanes;
    samples.resize(n);
    const SamplesView s = samples.view();
    const double shift[3] = {random(), random(), random()};
    std::vector<float> cumulated(cells.weight.size());
    float whole = 0.0f;
    for (std::size_t i = 0; i < cumulated.size(); ++i) cumulated[i] = whole += cells.weight[i];
    const auto moved = [&](int index, int base, int which) {
        const double v = halton(index, base) + shift[which];
        return v - std::floor(v);
    };
    for (int k = 0; k < n; ++k) {
        Direction normal = mean;
        float alpha2 = widths[static_cast<std::size_t>(k / 2) % widths.size()];
        // Each kind of point counts its own lattice: taking every other point of one sequence
        // would take one half of the square.
        int index = k / 2 / static_cast<int>(widths.size());
        if (k % 2 == 0) {
            index = k / 2;
            const float target = static_cast<float>(moved(index, 5, 2)) * whole;
            const auto found = std::upper_bound(cumulated.begin(), cumulated.end(), target);
            const std::size_t cell =
                std::min(cumulated.size() - 1, static_cast<std::size_t>(found - cumulated.begin()));
            normal = {cells.nx[cell], cells.ny[cell], cells.nz[cell]};
            alpha2 = cells.alpha2[cell];
        }
        const double u = std::min(0.999999, moved(index, 2, 0));
        const double phi = 6.283185307179586 * moved(index, 3, 1);
        const double tan2 = static_cast<double>(alpha2) * u / (1.0 - u);
        const float c = static_cast<float>(1.0 / std::sqrt(1.0 + tan2));
        const float r = static_cast<float>(std::sqrt(tan2)) * c;
        const float x = r * static_cast<float>(std::cos(phi));
        const float y = r * static_cast<float>(std::sin(phi));
        const Frame f = frame_about(normal);
        s.hx[k] = f.t.x * x + f.b.x * y + f.n.x * c;
        s.hy[k] = f.t.y * x + f.b.y * y + f.n.y * c;
        s.hz[k] = f.t.z * x + f.b.z * y + f.n.z * c;
    }
    for (int v = 0; v < kViews; ++v) {
        const float* view = kViewDirections[v];
        for (int k = 0; k < n; ++k) {
            const int at = v * n + k;
            s.hx[at] = s.hx[k];
            s.hy[at] = s.hy[k];
            s.hz[at] = s.hz[k];
            const float vh = view[0] * s.hx[k] + view[1] * s.hy[k] + view[2] * s.hz[k];
            s.vh2[at] = 2.0f * vh;
            s.weight[at] = vh > 0.0f && s.vh2[at] * s.hz[k] > view[2] ? 4.0f * vh : 0.0f;
        }
    }
    lobe_kernel().shade(cells.view(), s);
    for (int at = 0; at < kViews * n; ++at) {
        const double hx = static_cast<double>(s.hx[at]), hy = static_cast<double>(s.hy[at]),
                     hz = static_cast<double>(s.hz[at]);
        double density = 0.5 * static_cast<double>(s.density[at]);
        for (const float width : widths) {
            density += 0.5 / static_cast<double>(widths.size()) *
                       lobe_density(static_cast<double>(width), mean, hx, hy, hz);
        }
        s.weight[at] = density > 0.0
                           ? static_cast<float>(static_cast<double>(s.weight[at]) / (density * n))
                           : 0.0f;
    }
}

std::array<double, kViews> reference_mass(Samples& samples)
{
    const SamplesView s = samples.view();
    std::array<double, kViews> mass{};
    for (int v = 0; v < kViews; ++v) {
        for (int k = v * s.per_view; k < (v + 1) * s.per_view; ++k) {
            mass[static_cast<std::size_t>(v)] +=
                static_cast<double>(s.weight[k]) * static_cast<double>(s.radiance[k]);
        }
    }
    return mass;
}

EllipticLobe round_lobe(const Direction& n, float alpha2)
{
    const Frame f = frame_about(n);
    return {n.x, n.y, n.z, f.t.x, f.t.y, f.t.z, f.b.x, f.b.y, f.b.z, alpha2, alpha2};
}

Measure measure(Samples& samples, const std::array<double, kViews>& mass, const EllipticLobe& lobe)
{
    float difference[kViews], energy[kViews];
    lobe_kernel().differences(samples.view(), lobe, difference, energy);
    Measure m;
    int views = 0;
    for (std::size_t v = 0; v < kViews; ++v) {
        if (!(mass[v] > 1e-6)) continue;
        m.error += std::min(2.0, static_cast<double>(difference[v]) / mass[v]);
        m.energy += static_cast<double>(energy[v]) / mass[v] - 1.0;
        ++views;
    }
    if (views) {
        m.error /= views;
        m.energy /= views;
    }
    return m;
}

double best_error(Samples& samples, const std::array<double, kViews>& mass, const Direction& mean,
                  double plain_error, double narrowest)
{
    const auto error = [&](double log_alpha) {
        const double a = std::exp(log_alpha);
        return measure(samples, mass, round_lobe(mean, static_cast<float>(a * a))).error;
    };
    const double low = std::log(std::max(1e-3, 0.7 * narrowest)), high = 0.0;
    constexpr int kSteps = 24;
    double best = 3.0, at = low;
    for (int i = 0; i <= kSteps; ++i) {
        const double x = low + (high - low) * i / kSteps;
        const double e = error(x);
        if (e < best) best = e, at = x;
    }
    double a = at - (high - low) / kSteps, b = std::min(high, at + (high - low) / kSteps);
    const double ratio = 0.6180339887498949;
    double c = b - ratio * (b - a), d = a + ratio * (b - a);
    double ec = error(c), ed = error(d);
    for (int i = 0; i < 14; ++i) {
        if (ec < ed) {
            b = d, d = c, ed = ec;
            c = b - ratio * (b - a);
            ec = error(c);
        } else {
            a = c, c = d, ec = ed;
            d = a + ratio * (b - a);
            ed = error(d);
        }
    }
    return std::min({best, ec, ed, plain_error});
}

}  // namespace petrichor::texproc::detail
