#include "texproc/filter/normal_codes.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace petrichor::texproc {

namespace {

// How far x and y are moved before they are rounded, in codes.
double shift_of(const Image& normal, const std::array<int, 2>& xy)
{
    constexpr double kMiddle = 127.75;  // between the flat of floats, 127.5, and that of 8 bits, 128
    const std::size_t step = static_cast<std::size_t>(normal.channels);
    double sum = 0.0;
    std::size_t near = 0, between = 0;
    for (std::size_t i = 0; i < normal.pixels.size(); i += step) {
        for (const int c : xy) {
            const double code = 255.0 * static_cast<double>(normal.pixels[i + static_cast<std::size_t>(c)]);
            between += std::abs(code - std::floor(code + 0.5)) > 0.01;
            if (!(std::abs(code - kMiddle) <= 2.0)) continue;
            sum += code - kMiddle;
            ++near;
        }
    }
    return between > 0 && near > 0 && sum < 0.0 ? 0.5 : 0.0;
}

}  // namespace

RawImage normals_in_8_bits(RawImage normals, int x, int y)
{
    if (normals.type == PixelType::U8) return normals;
    Image image = to_image(normals, ColorSpace::Data);
    const std::array<int, 2> xy{x, y};
    const float shift = static_cast<float>(shift_of(image, xy) / 255.0);
    const std::size_t step = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; shift > 0.0f && i < image.pixels.size(); i += step) {
        for (const int c : xy) image.pixels[i + static_cast<std::size_t>(c)] += shift;
    }
    return to_raw(image, PixelType::U8);
}

}  // namespace petrichor::texproc
