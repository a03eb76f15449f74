// LDR-FLIP. The numbers are those of: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and
// Fairchild 2020, FLIP: A Difference Evaluator for Alternating Images, HPG.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "texproc/image/raw_image.h"
#include "texproc/study/compare/detail/separable.h"
#include "texproc/study/compare/metrics.h"

namespace petrichor::texproc {

namespace {

struct Triple {
    double a = 0.0, b = 0.0, c = 0.0;
};

Triple xyz_of_linear(const Triple& rgb)
{
    return {0.4123907993 * rgb.a + 0.3575843394 * rgb.b + 0.1804807884 * rgb.c,
            0.2126390059 * rgb.a + 0.7151686788 * rgb.b + 0.0721923154 * rgb.c,
            0.0193308187 * rgb.a + 0.1191947798 * rgb.b + 0.9505321522 * rgb.c};
}

Triple linear_of_xyz(const Triple& xyz)
{
    return {3.2409699419 * xyz.a - 1.5373831776 * xyz.b - 0.4986107603 * xyz.c,
            -0.9692436363 * xyz.a + 1.8759675015 * xyz.b + 0.0415550574 * xyz.c,
            0.0556300797 * xyz.a - 0.2039769589 * xyz.b + 1.0569715142 * xyz.c};
}

Triple white()
{
    return xyz_of_linear({1.0, 1.0, 1.0});
}

// Linear opponent space: CIELAB without its cube roots, so that filtering adds light.
Triple opponent_of_linear(const Triple& rgb)
{
    const Triple xyz = xyz_of_linear(rgb), w = white();
    const double x = xyz.a / w.a, y = xyz.b / w.b, z = xyz.c / w.c;
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Triple linear_of_opponent(const Triple& o)
{
    const Triple w = white();
    const double y = (o.a + 16.0) / 116.0;
    return linear_of_xyz({w.a * (o.b / 500.0 + y), w.b * y, w.c * (y - o.c / 200.0)});
}

// CIELAB with chroma that fades with lightness (Hunt effect).
Triple hunt_lab(const Triple& rgb)
{
    const Triple xyz = xyz_of_linear(rgb), w = white();
    const auto f = [](double t) {
        constexpr double kDelta = 6.0 / 29.0;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                            : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const double x = f(xyz.a / w.a), y = f(xyz.b / w.b), z = f(xyz.c / w.c);
    const double lightness = 116.0 * y - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)};
}

// City-block in lightness, Euclidean in chroma.
double hyab(const Triple& u, const Triple& v)
{
    return std::abs(u.a - v.a) + std::hypot(u.b - v.b, u.c - v.c);
}

Image opponent_image(const Image& srgb)
{
    Image out(srgb.width, srgb.height, 3, ColorSpace::Data);
    for (std::size_t i = 0; i < out.pixels.size(); i += 3) {
        const auto linear = [&](std::size_t c) {
            return static_cast<double>(srgb_to_linear(std::clamp(srgb.pixels[i + c], 0.0f, 1.0f)));
        };
        const Triple o = opponent_of_linear({linear(0), linear(1), linear(2)});
        out.pixels[i] = static_cast<float>(o.a);
        out.pixels[i + 1] = static_cast<float>(o.b);
        out.pixels[i + 2] = static_cast<float>(o.c);
    }
    return out;
}

Image plane_of(const Image& image, int channel)
{
    Image out(image.width, image.height, 1, ColorSpace::Data);
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        out.pixels[i] = image.pixels[3 * i + static_cast<std::size_t>(channel)];
    }
    return out;
}

// One Gaussian of a contrast sensitivity function, a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees.
struct Bump {
    double a, b;
};

// The image of one channel after the eye: a sum of Gaussians, each separable, weights sum 1.
Image seen(const Image& plane, std::initializer_list<Bump> bumps, double pixels_per_degree,
           int threads)
{
    constexpr double kPi = 3.141592653589793;
    constexpr double kWidest = 0.04;  // of all channels: they share one radius
    const int radius = static_cast<int>(
        std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * pixels_per_degree));
    Image out(plane.width, plane.height, 1, ColorSpace::Data);
    const auto sigma_of = [&](const Bump& bump) {
        return std::sqrt(bump.b / (2.0 * kPi * kPi)) * pixels_per_degree;
    };
    std::vector<double> shares;
    double total = 0.0;
    for (const Bump& bump : bumps) {
        double line = 0.0;
        for (int x = -radius; x <= radius; ++x)
            line += std::exp(-x * x / (2.0 * sigma_of(bump) * sigma_of(bump)));
        shares.push_back(bump.a * std::sqrt(kPi / bump.b) * line * line);
        total += shares.back();
    }
    std::size_t k = 0;
    for (const Bump& bump : bumps) {
        const std::vector<float> weights = detail::gaussian_weights(sigma_of(bump), radius);
        const Image part = detail::filtered(plane, weights, weights, threads);
        const float share = static_cast<float>(shares[k++] / total);
        for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] += share * part.pixels[i];
    }
    return out;
}

// What is seen of an opponent image, as Hunt-adjusted CIELAB.
std::vector<Triple> perceived(const Image& opponent, double pixels_per_degree, int threads)
{
    const Image y = seen(plane_of(opponent, 0), {{1.0, 0.0047}}, pixels_per_degree, threads);
    const Image x = seen(plane_of(opponent, 1), {{1.0, 0.0053}}, pixels_per_degree, threads);
    const Image z =
        seen(plane_of(opponent, 2), {{34.1, 0.04}, {13.5, 0.025}}, pixels_per_degree, threads);
    std::vector<Triple> out(y.pixels.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        Triple rgb =
            linear_of_opponent({static_cast<double>(y.pixels[i]), static_cast<double>(x.pixels[i]),
                                static_cast<double>(z.pixels[i])});
        for (double* v : {&rgb.a, &rgb.b, &rgb.c}) *v = std::clamp(*v, 0.0, 1.0);
        out[i] = hunt_lab(rgb);
    }
    return out;
}

// Positive weights sum to 1, negative ones to -1.
std::vector<float> balanced(const std::vector<double>& weights)
{
    double up = 0.0, down = 0.0;
    for (const double w : weights) (w > 0.0 ? up : down) += std::abs(w);
    std::vector<float> out;
    for (const double w : weights) out.push_back(static_cast<float>(w / (w > 0.0 ? up : down)));
    return out;
}

// Strength of edges and of points (lines, dots) in luminance.
struct Features {
    std::vector<double> edges, points;
};

Features features_of(const Image& opponent, double pixels_per_degree, int threads)
{
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<double> edge, point;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-x * x / (2.0 * sigma * sigma));
        edge.push_back(-x * g);
        point.push_back((x * x / (sigma * sigma) - 1.0) * g);
    }
    Image luminance = plane_of(opponent, 0);
    for (float& v : luminance.pixels) v = (v + 16.0f) / 116.0f;
    const std::vector<float> smooth = detail::gaussian_weights(sigma, radius);
    const auto strength = [&](const std::vector<double>& kernel) {
        const std::vector<float> k = balanced(kernel);
        const Image u = detail::filtered(luminance, k, smooth, threads);
        const Image v = detail::filtered(luminance, smooth, k, threads);
        std::vector<double> out(u.pixels.size());
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = std::hypot(static_cast<double>(u.pixels[i]), static_cast<double>(v.pixels[i]));
        }
        return out;
    };
    return {strength(edge), strength(point)};
}

// The largest colour difference there is maps to 1; small ones keep most of the range.
double redistributed(double difference)
{
    constexpr double kExponent = 0.7, kBreak = 0.4, kTarget = 0.95;
    static const double kLargest =
        std::pow(hyab(hunt_lab({0.0, 1.0, 0.0}), hunt_lab({0.0, 0.0, 1.0})), kExponent);
    const double power = std::pow(difference, kExponent), knee = kBreak * kLargest;
    if (power < knee) return kTarget / knee * power;
    return std::min(1.0, kTarget + (power - knee) / (kLargest - knee) * (1.0 - kTarget));
}

}  // namespace

Flip flip(const Image& reference, const Image& test, double pixels_per_degree, int threads)
{
    detail::check_comparable(reference, test);
    if (reference.channels != 3) {
        throw Error(
            "compare: FLIP takes 3 channels, these have " + std::to_string(reference.channels),
            "Give RGB images, or repeat the grey channel.");
    }
    if (!(pixels_per_degree >= 5.0 && pixels_per_degree <= 300.0)) {
        throw Error("compare: pixels per degree must be in 5..300, got " +
                        std::to_string(pixels_per_degree),
                    "Use 67 for a monitor on a desk.");
    }
    const Image a = opponent_image(reference), b = opponent_image(test);
    const std::vector<Triple> seen_a = perceived(a, pixels_per_degree, threads);
    const std::vector<Triple> seen_b = perceived(b, pixels_per_degree, threads);
    const Features fa = features_of(a, pixels_per_degree, threads),
                   fb = features_of(b, pixels_per_degree, threads);
    Flip out;
    out.error = Image(reference.width, reference.height, 1, ColorSpace::Data);
    double sum = 0.0;
    for (std::size_t i = 0; i < seen_a.size(); ++i) {
        const double color = redistributed(hyab(seen_a[i], seen_b[i]));
        const double feature = std::sqrt(
            std::max(std::abs(fa.edges[i] - fb.edges[i]), std::abs(fa.points[i] - fb.points[i])) /
            std::sqrt(2.0));
        const double error = std::pow(color, 1.0 - std::min(feature, 1.0));
        out.error.pixels[i] = static_cast<float>(error);
        sum += error;
        out.max = std::max(out.max, error);
    }
    std::vector<float> sorted = out.error.pixels;
    const std::size_t p95 = std::min(
        sorted.size() - 1, static_cast<std::size_t>(0.95 * static_cast<double>(sorted.size())));
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(p95),
                     sorted.end());
    out.p95 = static_cast<double>(sorted[p95]);
    out.mean = sum / static_cast<double>(sorted.size());
    return out;
}

}  // namespace petrichor::texproc
