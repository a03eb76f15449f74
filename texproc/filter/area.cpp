#include "texproc/filter/area.h"

#include <algorithm>
#include <cassert>

#include "base/parallel.h"

namespace petrichor::texproc {

namespace {

// Two by two, by far the commonest case.
void halve_row(const Image& from, int y, Image& to)
{
    const int c = from.channels;
    const float* a = &from.pixels[from.index(0, 2 * y, 0)];
    const float* b = &from.pixels[from.index(0, 2 * y + 1, 0)];
    float* out = &to.pixels[to.index(0, y, 0)];
    for (int x = 0; x < to.width; ++x) {
        for (int k = 0; k < c; ++k) out[k] = ((a[k] + a[k + c]) + (b[k] + b[k + c])) * 0.25f;
        a += 2 * c;
        b += 2 * c;
        out += c;
    }
}

void reduce_row(const Image& from, const Footprint& rows, const std::vector<Footprint>& columns,
                int y, Image& to)
{
    const std::size_t channels = static_cast<std::size_t>(from.channels);
    const std::size_t line = static_cast<std::size_t>(from.width) * channels;
    std::vector<double> sum(line, 0.0);
    for (std::size_t r = 0; r < rows.weights.size(); ++r) {
        const float* row = &from.pixels[from.index(0, rows.first + static_cast<int>(r), 0)];
        const double weight = static_cast<double>(rows.weights[r]);
        for (std::size_t i = 0; i < line; ++i) sum[i] += weight * static_cast<double>(row[i]);
    }
    float* out = &to.pixels[to.index(0, y, 0)];
    for (const Footprint& column : columns) {
        for (std::size_t k = 0; k < channels; ++k) {
            double value = 0.0;
            const double* s = &sum[static_cast<std::size_t>(column.first) * channels + k];
            for (std::size_t i = 0; i < column.weights.size(); ++i) {
                value += static_cast<double>(column.weights[i]) * s[i * channels];
            }
            *out++ = static_cast<float>(value);
        }
    }
}

}  // namespace

std::vector<LevelSize> level_sizes(int width, int height)
{
    std::vector<LevelSize> sizes{{width, height}};
    while (sizes.back().width > 1 || sizes.back().height > 1) {
        sizes.push_back(
            {std::max(1, sizes.back().width / 2), std::max(1, sizes.back().height / 2)});
    }
    return sizes;
}

std::vector<Footprint> footprints(int base, int count)
{
    assert(count >= 1 && base >= count);
    std::vector<Footprint> all(static_cast<std::size_t>(count));
    const double scale = static_cast<double>(base) / count;
    // Edges in integers: texel i covers [i base, (i + 1) base) in units of 1 / count.
    for (std::int64_t i = 0; i < count; ++i) {
        const std::int64_t begin = i * base;
        const std::int64_t end = (i + 1) * base;
        Footprint& f = all[static_cast<std::size_t>(i)];
        f.first = static_cast<int>(begin / count);
        for (std::int64_t t = f.first; t * count < end; ++t) {
            const std::int64_t covered =
                std::min(end, (t + 1) * count) - std::max(begin, t * count);
            f.weights.push_back(static_cast<float>(static_cast<double>(covered) / count / scale));
        }
    }
    return all;
}

Image area_reduced(const Image& image, int width, int height, int threads)
{
    Image to(width, height, image.channels, image.space);
    if (image.width == 2 * width && image.height == 2 * height) {
        parallel_for(static_cast<std::size_t>(height), threads,
                     [&](std::size_t y) { halve_row(image, static_cast<int>(y), to); });
        return to;
    }
    const std::vector<Footprint> columns = footprints(image.width, width);
    const std::vector<Footprint> rows = footprints(image.height, height);
    parallel_for(static_cast<std::size_t>(height), threads, [&](std::size_t y) {
        reduce_row(image, rows[y], columns, static_cast<int>(y), to);
    });
    return to;
}

std::vector<Image> area_levels(const Image& image, int threads)
{
    const std::vector<LevelSize> sizes = level_sizes(image.width, image.height);
    std::vector<Image> levels;
    levels.reserve(sizes.size() - 1);
    for (std::size_t k = 1; k < sizes.size(); ++k) {
        const Image* from = &image;
        for (const Image& level : levels) {
            if (level.width % sizes[k].width == 0 && level.height % sizes[k].height == 0 &&
                image.width % level.width == 0 && image.height % level.height == 0) {
                from = &level;
            }
        }
        levels.push_back(area_reduced(*from, sizes[k].width, sizes[k].height, threads));
    }
    return levels;
}

}  // namespace petrichor::texproc
