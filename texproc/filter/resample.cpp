#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/filter/area.h"
#include "texproc/filter/mips.h"

namespace petrichor::texproc {

namespace {

constexpr double kPi = 3.141592653589793;

double sinc(double x)
{
    return std::abs(x) < 1e-9 ? 1.0 : std::sin(kPi * x) / (kPi * x);
}

double bessel0(double x)
{
    double sum = 1.0, term = 1.0;
    for (int k = 1; k < 40; ++k) {
        term *= (x / (2.0 * k)) * (x / (2.0 * k));
        sum += term;
    }
    return sum;
}

double radius_of(MipFilter filter)
{
    return filter == MipFilter::Mitchell ? 2.0 : 3.0;
}

double value_of(MipFilter filter, double x)
{
    x = std::abs(x);
    if (x >= radius_of(filter)) return 0.0;
    if (filter == MipFilter::Lanczos3) return sinc(x) * sinc(x / 3.0);
    if (filter == MipFilter::Kaiser) {
        const double t = x / 3.0;
        return sinc(x) * bessel0(4.0 * std::sqrt(1.0 - t * t)) / bessel0(4.0);
    }
    // Mitchell and Netravali 1988, B = C = 1/3.
    if (x < 1.0) return (7.0 * x * x * x - 12.0 * x * x + 16.0 / 3.0) / 6.0;
    return (-7.0 / 3.0 * x * x * x + 12.0 * x * x - 20.0 * x + 32.0 / 3.0) / 6.0;
}

int at_edge(std::int64_t i, int size, Edge edge)
{
    if (edge == Edge::Clamp) return static_cast<int>(std::clamp<std::int64_t>(i, 0, size - 1));
    const std::int64_t period = edge == Edge::Wrap ? size : 2 * size;
    const std::int64_t m = ((i % period) + period) % period;
    return static_cast<int>(m < size ? m : period - 1 - m);
}

struct Taps {
    std::vector<int> index;
    std::vector<double> weight;
};

// The centre of texel i lies at (2 i + 1) base / (2 count); weights depend only on its phase, which
// is kept in integers: texels of one phase have the same weights to the last bit.
std::vector<Taps> taps_of(int base, int count, MipFilter filter, Edge edge)
{
    std::vector<Taps> all(static_cast<std::size_t>(count));
    const double scale = static_cast<double>(base) / count;
    const double reach = radius_of(filter) * scale;
    for (std::int64_t i = 0; i < count; ++i) {
        const std::int64_t numerator = (2 * i + 1) * base;
        const std::int64_t whole = numerator / (2 * count);
        const double phase = static_cast<double>(numerator % (2 * count)) / (2.0 * count);
        Taps& taps = all[static_cast<std::size_t>(i)];
        double sum = 0.0;
        for (std::int64_t k = -static_cast<std::int64_t>(reach) - 1;
             k <= static_cast<std::int64_t>(reach) + 1; ++k) {
            const double w = value_of(filter, (static_cast<double>(k) + 0.5 - phase) / scale);
            if (w == 0.0) continue;
            taps.index.push_back(at_edge(whole + k, base, edge));
            taps.weight.push_back(w);
            sum += w;
        }
        for (double& w : taps.weight) w /= sum;
    }
    return all;
}

}  // namespace

Image resampled(const Image& image, int width, int height, MipFilter filter, Edge edge_u,
                Edge edge_v, int threads)
{
    if (width < 1 || height < 1 || width > image.width || height > image.height) {
        throw Error("mips: cannot reduce " + std::to_string(image.width) + " x " +
                        std::to_string(image.height) + " to " + std::to_string(width) + " x " +
                        std::to_string(height),
                    "Ask for a size between 1 x 1 and that of the image.");
    }
    if (filter == MipFilter::Box) return area_reduced(image, width, height, threads);
    const std::vector<Taps> columns = taps_of(image.width, width, filter, edge_u);
    const std::vector<Taps> rows = taps_of(image.height, height, filter, edge_v);
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    const std::size_t line = static_cast<std::size_t>(image.width) * channels;
    Image to(width, height, image.channels, image.space);
    parallel_for(static_cast<std::size_t>(height), threads, [&](std::size_t y) {
        std::vector<double> sum(line, 0.0);
        for (std::size_t t = 0; t < rows[y].index.size(); ++t) {
            const float* row = &image.pixels[image.index(0, rows[y].index[t], 0)];
            const double w = rows[y].weight[t];
            for (std::size_t i = 0; i < line; ++i) sum[i] += w * static_cast<double>(row[i]);
        }
        float* out = &to.pixels[to.index(0, static_cast<int>(y), 0)];
        for (const Taps& taps : columns) {
            for (std::size_t c = 0; c < channels; ++c) {
                double value = 0.0;
                for (std::size_t t = 0; t < taps.index.size(); ++t) {
                    value += taps.weight[t] *
                             sum[static_cast<std::size_t>(taps.index[t]) * channels + c];
                }
                *out++ = static_cast<float>(value);
            }
        }
    });
    return to;
}

}  // namespace petrichor::texproc
