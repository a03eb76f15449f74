#include "texproc/filter/pixel_length.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/parallel.h"

namespace petrichor::texproc {

namespace {

// The neighbour of i on either side; at an edge the one inside stands for the other.
int before(int i, int size)
{
    return i > 0 ? i - 1 : std::min(1, size - 1);
}
int after(int i, int size)
{
    return i + 1 < size ? i + 1 : std::max(size - 2, 0);
}

}  // namespace

Image pixel_lengths(const Image& normals, int threads)
{
    const int width = normals.width, height = normals.height;
    Image lengths(width, height, 1, ColorSpace::Data);
    parallel_for(static_cast<std::size_t>(height), threads, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const int rows[] = {before(y, height), y, after(y, height)};
        for (int x = 0; x < width; ++x) {
            const int columns[] = {before(x, width), x, after(x, width)};
            float sum[3] = {};
            for (int j = 0; j < 3; ++j) {
                for (int i = 0; i < 3; ++i) {
                    const float weight = (i == 1 ? 0.5f : 0.25f) * (j == 1 ? 0.5f : 0.25f);
                    const float* n = &normals.pixels[normals.index(columns[i], rows[j], 0)];
                    for (int c = 0; c < 3; ++c) sum[c] += weight * (2.0f * n[c] - 1.0f);
                }
            }
            lengths.at(x, y, 0) =
                std::min(std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]), 1.0f);
        }
    });
    return lengths;
}

}  // namespace petrichor::texproc
