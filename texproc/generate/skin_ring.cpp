// The lookup of skin: the light that a ring of skin sends out, by how far it is turned from the light
// and by how bent it is (Penner 2011, "Pre-integrated skin shading").
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "formulas/light/skin.h"
#include "texproc/filter/bake.h"

namespace petrichor::texproc {

namespace {

constexpr double kPi = 3.14159265358979323846;

constexpr double kStep_mm = 0.06;  // finer than the narrowest Gaussian of the profile

// Points of the ring from which light comes through the skin, and the share of each, in all 1.
struct Point {
    double cosine = 1.0, sine = 0.0;  // of the angle to it
    std::array<double, 3> share{};
};

std::vector<Point> ring_of(double curvature)
{
    const double radius_mm = static_cast<double>(shared::kSkinRadius_mm) / curvature;
    const double half = std::min(0.5 * kPi, static_cast<double>(shared::kSkinReach_mm) / radius_mm);
    const int steps = static_cast<int>(std::ceil(2.0 * half * radius_mm / kStep_mm));
    std::vector<Point> ring(static_cast<std::size_t>(steps));
    std::array<double, 3> sum{};
    for (int i = 0; i < steps; ++i) {
        Point& point = ring[static_cast<std::size_t>(i)];
        const double angle = half * (2.0 * (i + 0.5) / steps - 1.0);
        const double distance = 2.0 * radius_mm * std::sin(0.5 * angle);
        point.cosine = std::cos(angle);
        point.sine = std::sin(angle);
        const glm::vec3 weight = shared::skin_profile(static_cast<float>(distance * distance));
        for (int c = 0; c < 3; ++c) {
            point.share[static_cast<std::size_t>(c)] = static_cast<double>(weight[c]);
            sum[static_cast<std::size_t>(c)] += static_cast<double>(weight[c]);
        }
    }
    for (Point& point : ring) {
        for (std::size_t c = 0; c < 3; ++c) point.share[c] /= sum[c];
    }
    return ring;
}

}  // namespace

Image skin_ring(int size)
{
    if (size < 16 || size > 8192) {
        throw Error("skin ring: the size must be in 16..8192, got " + std::to_string(size),
                    "Use 256.");
    }
    Image out(size, size, 3, ColorSpace::Data);
    for (int y = 0; y < size; ++y) {
        const std::vector<Point> ring = ring_of((y + 0.5) / size);
        for (int x = 0; x < size; ++x) {
            const double cosine = 2.0 * (x + 0.5) / size - 1.0;
            const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
            std::array<double, 3> lit{};
            for (const Point& point : ring) {
                const double facing = cosine * point.cosine - sine * point.sine;
                if (facing <= 0.0) continue;
                for (std::size_t c = 0; c < 3; ++c) lit[c] += facing * point.share[c];
            }
            for (int c = 0; c < 3; ++c)
                out.at(x, y, c) = static_cast<float>(lit[static_cast<std::size_t>(c)]);
        }
    }
    return out;
}

}  // namespace petrichor::texproc
