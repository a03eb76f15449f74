#include <algorithm>

#include "texproc/filter/area.h"
#include "texproc/filter/resample.h"

namespace petrichor::texproc {

namespace {

Image enlarged(const Image& image, int width, int height)
{
    Image to(width, height, image.channels, image.space);
    const auto place = [](int at, int size, int from) {
        const float x =
            (static_cast<float>(at) + 0.5f) * static_cast<float>(from) / static_cast<float>(size) -
            0.5f;
        return std::clamp(x, 0.0f, static_cast<float>(from - 1));
    };
    for (int y = 0; y < height; ++y) {
        const float v = place(y, height, image.height);
        const int y0 = static_cast<int>(v), y1 = std::min(y0 + 1, image.height - 1);
        const float fy = v - static_cast<float>(y0);
        for (int x = 0; x < width; ++x) {
            const float u = place(x, width, image.width);
            const int x0 = static_cast<int>(u), x1 = std::min(x0 + 1, image.width - 1);
            const float fx = u - static_cast<float>(x0);
            for (int c = 0; c < image.channels; ++c) {
                const float top = image.at(x0, y0, c) * (1 - fx) + image.at(x1, y0, c) * fx;
                const float low = image.at(x0, y1, c) * (1 - fx) + image.at(x1, y1, c) * fx;
                to.at(x, y, c) = top * (1 - fy) + low * fy;
            }
        }
    }
    return to;
}

}  // namespace

Image resized(const Image& image, int width, int height, int threads)
{
    if (image.width == width && image.height == height) return image;
    const int grown_width = std::max(width, image.width);
    const int grown_height = std::max(height, image.height);
    if (grown_width == image.width && grown_height == image.height)
        return area_reduced(image, width, height, threads);
    const Image large = enlarged(image, grown_width, grown_height);
    return area_reduced(large, width, height, threads);
}

}  // namespace petrichor::texproc
