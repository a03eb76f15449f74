#include "texproc/image/zero_rows.h"

#include <algorithm>
#include <cstddef>

namespace petrichor::texproc {

std::string zero_rows(const RawImage& image)
{
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    const std::size_t colors = channels == 2 || channels == 4 ? channels - 1 : channels;
    const std::size_t size = size_of(image.type), width = static_cast<std::size_t>(image.width);
    const auto is_zero = [&](int y) {
        const std::byte* row = &image.bytes[static_cast<std::size_t>(y) * width * channels * size];
        for (std::size_t x = 0; x < width; ++x, row += channels * size)
            if (std::any_of(row, row + colors * size, [](std::byte b) { return b != std::byte{}; }))
                return false;
        return true;
    };
    int first = 0, last = image.height;  // rows that hold something
    while (first < image.height && is_zero(first)) ++first;
    if (first == image.height) return "it is zero all over";
    while (is_zero(last - 1)) --last;
    const int few = std::max(image.height / 16, 1);
    const auto rows = [&](int from, int to) {
        return "rows " + std::to_string(from) + " to " + std::to_string(to - 1) + " of " +
               std::to_string(image.height) + " are zero";
    };
    if (image.height - last > few) return rows(last, image.height);
    if (first > few) return rows(0, first);
    return "";
}

}  // namespace petrichor::texproc
