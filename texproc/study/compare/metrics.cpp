#include "texproc/study/compare/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "texproc/study/compare/detail/separable.h"

namespace petrichor::texproc {

std::vector<double> psnr(const Image& a, const Image& b)
{
    detail::check_comparable(a, b);
    const std::size_t channels = static_cast<std::size_t>(a.channels);
    std::vector<double> sums(channels + 1, 0.0);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
        sums[i % channels] += d * d;
    }
    const double texels = static_cast<double>(a.pixels.size() / channels);
    for (std::size_t c = 0; c < channels; ++c) {
        sums[channels] += sums[c] / static_cast<double>(channels);
    }
    for (double& sum : sums) {
        sum =
            sum > 0.0 ? -10.0 * std::log10(sum / texels) : std::numeric_limits<double>::infinity();
    }
    return sums;
}

double largest_difference(const Image& a, const Image& b)
{
    detail::check_comparable(a, b);
    double largest = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        largest = std::max(
            largest, std::abs(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i])));
    }
    return largest;
}

double ssim(const Image& a, const Image& b, int threads)
{
    detail::check_comparable(a, b);
    const std::vector<float> window = detail::gaussian_weights(1.5, 5);
    const auto mean = [&](const Image& image) {
        return detail::filtered(image, window, window, threads);
    };
    const auto product = [](const Image& x, const Image& y) {
        Image out = x;
        for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] *= y.pixels[i];
        return out;
    };
    const Image ma = mean(a), mb = mean(b);
    const Image aa = mean(product(a, a)), bb = mean(product(b, b)), ab = mean(product(a, b));
    constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double x = static_cast<double>(ma.pixels[i]), y = static_cast<double>(mb.pixels[i]);
        const double vx = static_cast<double>(aa.pixels[i]) - x * x;
        const double vy = static_cast<double>(bb.pixels[i]) - y * y;
        const double cov = static_cast<double>(ab.pixels[i]) - x * y;
        sum += (2.0 * x * y + kC1) * (2.0 * cov + kC2) / ((x * x + y * y + kC1) * (vx + vy + kC2));
    }
    return sum / static_cast<double>(a.pixels.size());
}

AngularError angular_error(const Image& a, const Image& b)
{
    detail::check_comparable(a, b);
    if (a.channels != 3) {
        throw Error(
            "compare: normal maps have 3 channels, these have " + std::to_string(a.channels),
            "Unpack them first: petrichor texture normal --from-layout.");
    }
    AngularError out;
    out.degrees = Image(a.width, a.height, 1, ColorSpace::Data);
    double sum = 0.0;
    for (std::size_t i = 0; i < out.degrees.pixels.size(); ++i) {
        double dot = 0.0, la = 0.0, lb = 0.0, cross2 = 0.0;
        std::array<double, 3> u{}, v{};
        for (std::size_t c = 0; c < 3; ++c) {
            u[c] = 2.0 * static_cast<double>(a.pixels[3 * i + c]) - 1.0;
            v[c] = 2.0 * static_cast<double>(b.pixels[3 * i + c]) - 1.0;
            dot += u[c] * v[c];
            la += u[c] * u[c];
            lb += v[c] * v[c];
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t p = (c + 1) % 3, q = (c + 2) % 3;
            const double x = u[p] * v[q] - u[q] * v[p];
            cross2 += x * x;
        }
        // atan2 keeps small angles exact where acos loses them.
        const double angle =
            la > 0.0 && lb > 0.0 ? std::atan2(std::sqrt(cross2), dot) * 57.29577951308232 : 0.0;
        out.degrees.pixels[i] = static_cast<float>(angle);
        sum += angle;
        out.max_degrees = std::max(out.max_degrees, angle);
    }
    std::vector<float> sorted = out.degrees.pixels;
    const std::size_t p95 = std::min(
        sorted.size() - 1, static_cast<std::size_t>(0.95 * static_cast<double>(sorted.size())));
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(p95),
                     sorted.end());
    out.p95_degrees = static_cast<double>(sorted[p95]);
    out.mean_degrees = sum / static_cast<double>(sorted.size());
    return out;
}

Image error_colors(const Image& error)
{
    // Stops of lightness that rises evenly, so that the map also reads in grey.
    static constexpr float kStops[5][3] = {{0.0f, 0.0f, 0.02f},
                                           {0.30f, 0.07f, 0.48f},
                                           {0.71f, 0.21f, 0.47f},
                                           {0.98f, 0.53f, 0.37f},
                                           {0.99f, 0.98f, 0.75f}};
    Image out(error.width, error.height, 3, ColorSpace::Data);
    for (std::size_t i = 0;
         i < static_cast<std::size_t>(error.width) * static_cast<std::size_t>(error.height); ++i) {
        const float v = error.pixels[i * static_cast<std::size_t>(error.channels)];
        const float t = 4.0f * std::clamp(v, 0.0f, 1.0f);
        const int k = std::min(3, static_cast<int>(t));
        const float f = t - static_cast<float>(k);
        for (std::size_t c = 0; c < 3; ++c) {
            out.pixels[3 * i + c] = kStops[k][c] + f * (kStops[k + 1][c] - kStops[k][c]);
        }
    }
    return out;
}

}  // namespace petrichor::texproc
