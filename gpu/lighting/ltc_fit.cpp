// Fits the matrices of linearly transformed cosines to our GGX (Heitz, Dupuy, Hill and Neubelt 2016) and
// prints gpu/lighting/ltc_table.inc:
//
//   cmake --build build/release --target petrichor-ltc-fit
//   build/release/gpu/petrichor-ltc-fit > gpu/lighting/ltc_table.inc
//
// Each matrix is found by Nelder and Mead's simplex, over the same points of both lobes each time: the
// same bits come out again.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "formulas/light/brdf.h"
#include "formulas/light/ltc.h"

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSide = LTC_TABLE_SIDE;
constexpr int kSamples = 32;

struct Vec {
    double x = 0.0, y = 0.0, z = 0.0;
};
Vec operator*(double s, const Vec& v)
{
    return {s * v.x, s * v.y, s * v.z};
}
Vec operator+(const Vec& a, const Vec& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
double dot(const Vec& a, const Vec& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec unit(const Vec& v)
{
    return (1.0 / std::sqrt(dot(v, v))) * v;
}

// GGX without Fresnel, times the cosine; and the density of light that is sampled by its normals.
struct Ggx {
    double alpha;
    Vec view;

    double value(const Vec& l, double& density) const
    {
        density = 0.0;
        if (l.z <= 0.0) return 0.0;
        const Vec h = unit(view + l);
        const double a2 = alpha * alpha;
        const double q = (h.z * a2 - h.z) * h.z + 1.0;
        const double d = a2 / (kPi * q * q);
        const double v = 0.5 / (l.z * std::sqrt(view.z * view.z * (1.0 - a2) + a2) +
                                view.z * std::sqrt(l.z * l.z * (1.0 - a2) + a2));
        density = d * h.z / (4.0 * dot(view, h));
        return d * v * l.z;
    }
    Vec sample(double u, double w) const
    {
        const double tangent2 = alpha * alpha * u / (1.0 - u);
        const double c = 1.0 / std::sqrt(1.0 + tangent2);
        const double s = std::sqrt(1.0 - c * c);
        const Vec h{s * std::cos(2.0 * kPi * w), s * std::sin(2.0 * kPi * w), c};
        return 2.0 * dot(h, view) * h + -1.0 * view;
    }
};

// A cosine seen through [x y z] times (m11 0 m13; 0 m22 0; 0 0 1).
struct Ltc {
    double amplitude = 1.0;
    double m11 = 1.0, m22 = 1.0, m13 = 0.0;
    Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    Vec through(const Vec& p) const
    {
        return (m11 * p.x + m13 * p.z) * x + (m22 * p.y) * y + p.z * z;
    }
    double determinant() const { return m11 * m22; }
    double value(const Vec& l, double& density) const
    {
        const double c = dot(l, z);
        const Vec before = unit({(dot(l, x) - m13 * c) / m11, dot(l, y) / m22, c});
        const Vec after = through(before);
        const double size = std::sqrt(dot(after, after));
        density = std::max(before.z, 0.0) / kPi * size * size * size / determinant();
        return amplitude * density;
    }
    Vec sample(double u, double w) const
    {
        const double c = std::sqrt(1.0 - u);
        const double s = std::sqrt(u);
        return unit(through({s * std::cos(2.0 * kPi * w), s * std::sin(2.0 * kPi * w), c}));
    }
};

double point(int i)
{
    return (i + 0.5) / kSamples;
}

double difference(const Ggx& ggx, const Ltc& ltc)
{
    double sum = 0.0;
    for (int i = 0; i < kSamples * kSamples; ++i) {
        const double u = point(i / kSamples), w = point(i % kSamples);
        for (const Vec& l : {ggx.sample(u, w), ltc.sample(u, w)}) {
            double a = 0.0, b = 0.0;
            const double apart = std::abs(ggx.value(l, a) - ltc.value(l, b));
            if (a + b > 0.0) sum += apart * apart * apart / (a + b);
        }
    }
    return sum;
}

using Point = std::array<double, 3>;

void set(Ltc& ltc, const Point& p, bool round)
{
    ltc.m11 = std::max(p[0], 1e-7);
    ltc.m22 = round ? ltc.m11 : std::max(p[1], 1e-7);
    ltc.m13 = round ? 0.0 : p[2];
}

// Nelder and Mead 1965.
template <class F>
Point smallest(const Point& start, double reach, const F& f)
{
    std::array<std::pair<double, Point>, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
        Point p = start;
        if (i > 0) p[i - 1] += reach;
        corners[i] = {f(p), p};
    }
    const auto towards = [](const Point& a, const Point& b, double t) {
        return Point{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
    };
    for (int turn = 0; turn < 120; ++turn) {
        std::sort(corners.begin(), corners.end());
        if (2.0 * (corners[3].first - corners[0].first) <
            1e-6 * (corners[3].first + corners[0].first + 1e-30)) {
            break;
        }
        Point middle{0.0, 0.0, 0.0};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) middle[k] += corners[i].second[k] / 3.0;
        }
        const auto tried = [&](double t) {
            const Point p = towards(middle, corners[3].second, t);
            return std::pair<double, Point>{f(p), p};
        };
        const auto mirrored = tried(-1.0);
        if (mirrored.first < corners[0].first) {
            const auto farther = tried(-2.0);
            corners[3] = farther.first < mirrored.first ? farther : mirrored;
        } else if (mirrored.first < corners[2].first) {
            corners[3] = mirrored;
        } else {
            const auto nearer = tried(mirrored.first < corners[3].first ? -0.5 : 0.5);
            if (nearer.first < std::min(mirrored.first, corners[3].first)) {
                corners[3] = nearer;
            } else {
                for (std::size_t i = 1; i < 4; ++i) {
                    corners[i].second = towards(corners[0].second, corners[i].second, 0.5);
                    corners[i].first = f(corners[i].second);
                }
            }
        }
    }
    std::sort(corners.begin(), corners.end());
    return corners[0].second;
}

// Albedo and mean direction of the lobe.
void average(const Ggx& ggx, double& albedo, Vec& mean)
{
    const int side = 64;
    albedo = 0.0;
    mean = {};
    for (int i = 0; i < side * side; ++i) {
        const Vec l = ggx.sample((i / side + 0.5) / side, (i % side + 0.5) / side);
        double density = 0.0;
        const double value = ggx.value(l, density);
        if (density <= 0.0) continue;
        albedo += value / density / (side * side);
        mean = mean + value / density * l;
    }
    mean.y = 0.0;
    mean = unit(mean);
}

std::array<double, 4> inverse(const Ltc& ltc)
{
    // Inverse of [x y z] m: its rows by the transposed frame; y apart, divided by its middle.
    const double s = ltc.m22;
    return {s / ltc.m11 * (ltc.x.x - ltc.m13 * ltc.z.x), s / ltc.m11 * (ltc.x.z - ltc.m13 * ltc.z.z),
            s * ltc.z.x, s * ltc.z.z};
}

}  // namespace

int main()
{
    std::vector<std::array<double, 4>> table(kSide * kSide);
    Ltc start;
    for (int row = kSide - 1; row >= 0; --row) {
        Ltc ltc = start;
        for (int column = 0; column < kSide; ++column) {
            const double t = static_cast<double>(column) / (kSide - 1);
            const double cosine = std::max(1.0 - t * t, 0.02);
            const double roughness = std::max(static_cast<double>(row) / (kSide - 1), 0.045);
            const Ggx ggx{roughness * roughness, {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}};
            Vec mean;
            average(ggx, ltc.amplitude, mean);
            const bool round = column == 0;
            if (round) mean = {0, 0, 1};
            ltc.z = mean;
            ltc.x = {mean.z, 0.0, -mean.x};
            const auto error = [&](const Point& p) {
                Ltc one = ltc;
                set(one, p, round);
                return difference(ggx, one);
            };
            Point best{ltc.m11, ltc.m22, ltc.m13};
            best = smallest(best, 0.05 * (best[0] + 1e-3), error);
            best = smallest(best, 0.01 * (best[0] + 1e-3), error);
            set(ltc, best, round);
            if (round) start = ltc;
            table[static_cast<std::size_t>(row * kSide + column)] = inverse(ltc);
        }
    }
    std::printf("// Made by petrichor-ltc-fit (gpu/lighting/ltc_fit.cpp): a row of angles for each roughness.\n");
    for (std::size_t i = 0; i < table.size(); ++i) {
        for (const double number : table[i]) std::printf("%.5g,", number);
        std::printf(i % 4 == 3 ? "\n" : " ");
    }
    return 0;
}
