#include "texproc/study/compare/detail/separable.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/parallel.h"

namespace petrichor::texproc::detail {

std::vector<float> gaussian_weights(double sigma, int radius)
{
    std::vector<double> exact;
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        exact.push_back(std::exp(-x * x / (2.0 * sigma * sigma)));
        sum += exact.back();
    }
    std::vector<float> weights;
    for (const double w : exact) weights.push_back(static_cast<float>(w / sum));
    return weights;
}

Image filtered(const Image& image, const std::vector<float>& along_x,
               const std::vector<float>& along_y, int threads)
{
    const int rx = static_cast<int>(along_x.size()) / 2, ry = static_cast<int>(along_y.size()) / 2;
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    Image rows(image.width, image.height, image.channels, image.space);
    Image out = rows;
    parallel_for(static_cast<std::size_t>(image.height), threads, [&](std::size_t y) {
        const float* from = &image.pixels[image.index(0, static_cast<int>(y), 0)];
        float* to = &rows.pixels[rows.index(0, static_cast<int>(y), 0)];
        for (int x = 0; x < image.width; ++x) {
            for (int k = -rx; k <= rx; ++k) {
                const std::size_t at =
                    static_cast<std::size_t>(std::clamp(x + k, 0, image.width - 1)) * channels;
                const float w = along_x[static_cast<std::size_t>(k + rx)];
                for (std::size_t c = 0; c < channels; ++c) {
                    to[static_cast<std::size_t>(x) * channels + c] += w * from[at + c];
                }
            }
        }
    });
    const std::size_t line = static_cast<std::size_t>(image.width) * channels;
    parallel_for(static_cast<std::size_t>(image.height), threads, [&](std::size_t y) {
        float* to = &out.pixels[out.index(0, static_cast<int>(y), 0)];
        for (int k = -ry; k <= ry; ++k) {
            const int from_y = std::clamp(static_cast<int>(y) + k, 0, image.height - 1);
            const float* from = &rows.pixels[rows.index(0, from_y, 0)];
            const float w = along_y[static_cast<std::size_t>(k + ry)];
            for (std::size_t i = 0; i < line; ++i) to[i] += w * from[i];
        }
    });
    return out;
}

void check_comparable(const Image& a, const Image& b)
{
    const auto shape = [](const Image& i) {
        return std::to_string(i.width) + " x " + std::to_string(i.height) + " with " +
               std::to_string(i.channels) + " channels";
    };
    if (a.empty() || b.empty() || a.width != b.width || a.height != b.height ||
        a.channels != b.channels) {
        throw Error("compare: one image is " + shape(a) + ", the other " + shape(b),
                    "Compare images of one size with the same channels.");
    }
}

}  // namespace petrichor::texproc::detail
