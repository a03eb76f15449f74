#include "texproc/filter/detail/alpha.h"

#include <algorithm>
#include <cassert>

namespace petrichor::texproc::detail {

namespace {

constexpr float kHole = 1.0f / 4096.0f;  // less alpha rounds to 0 in 8 bits, and holds no colour

// The colour of what surrounds a hole: the sum of premultiplied neighbours over that of their
// alpha.
void fill_hole(const Image& filtered, int x, int y, bool wrap_u, bool wrap_v, float* color)
{
    const int alpha = alpha_channel(filtered.channels);
    const auto inside = [](int i, int size, bool wrap) {
        return wrap ? (i + size) % size : std::clamp(i, 0, size - 1);
    };
    float sum[3] = {}, weight = 0.0f;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const float* texel =
                &filtered.pixels[filtered.index(inside(x + dx, filtered.width, wrap_u),
                                                inside(y + dy, filtered.height, wrap_v), 0)];
            if (!(texel[alpha] > kHole)) continue;
            for (int c = 0; c < std::min(3, alpha); ++c) sum[c] += texel[c];
            weight += texel[alpha];
        }
    }
    if (!(weight > 0.0f)) return;
    for (int c = 0; c < std::min(3, alpha); ++c) color[c] = sum[c] / weight;
}

}  // namespace

int alpha_channel(int channels)
{
    return channels == 2 ? 1 : channels >= 4 ? 3 : -1;
}

bool has_holes(const Image& image)
{
    const int alpha = alpha_channel(image.channels);
    if (alpha < 0) return false;
    const std::size_t step = static_cast<std::size_t>(image.channels);
    for (std::size_t i = static_cast<std::size_t>(alpha); i < image.pixels.size(); i += step) {
        if (image.pixels[i] < 1.0f) return true;
    }
    return false;
}

Image premultiplied(const Image& image)
{
    const int alpha = alpha_channel(image.channels);
    assert(alpha > 0);
    Image to = image;
    for (std::size_t i = 0; i < to.pixels.size(); i += static_cast<std::size_t>(to.channels)) {
        float* texel = &to.pixels[i];
        for (int c = 0; c < std::min(3, alpha); ++c) texel[c] *= texel[alpha];
    }
    return to;
}

Image straight(const Image& filtered, const Image& plain, bool wrap_u, bool wrap_v)
{
    const int alpha = alpha_channel(filtered.channels);
    assert(alpha > 0 && plain.pixels.size() == filtered.pixels.size());
    Image to = plain;
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            const float* from = &filtered.pixels[filtered.index(x, y, 0)];
            float* texel = &to.pixels[to.index(x, y, 0)];
            if (!(from[alpha] > kHole)) {
                fill_hole(filtered, x, y, wrap_u, wrap_v, texel);
            } else {
                for (int c = 0; c < std::min(3, alpha); ++c) texel[c] = from[c] / from[alpha];
            }
        }
    }
    return to;
}

}  // namespace petrichor::texproc::detail
