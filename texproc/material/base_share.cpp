#include "texproc/material/base_share.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "texproc/filter/area.h"
#include "texproc/filter/pixel_length.h"

namespace petrichor::texproc {

namespace {

// The shares over the texels of a level of this size; empty: nothing is lost there.
Image shares_for(const std::vector<Image>& shares, int width, int height)
{
    const Image* larger = nullptr;
    for (std::size_t k = 1; k < shares.size(); ++k) {
        const Image& level = shares[k];
        if (level.width == width && level.height == height) return level;
        if (level.width >= width && level.height >= height) larger = &level;
    }
    return larger ? area_reduced(*larger, width, height, 1) : Image{};
}

// Means of the unit normals over the texels of every level, level 0 (empty) to 1 x 1.
std::vector<Image> mean_normals(const Image& normals, int threads)
{
    Image unit(normals.width, normals.height, 3, ColorSpace::Data);
    for (std::size_t i = 0; i < unit.pixels.size(); i += 3) {
        float x = 2.0f * normals.pixels[i] - 1.0f, y = 2.0f * normals.pixels[i + 1] - 1.0f;
        const float flat = std::sqrt(x * x + y * y);
        if (flat > 1.0f) x /= flat, y /= flat;
        unit.pixels[i] = x;
        unit.pixels[i + 1] = y;
        unit.pixels[i + 2] = std::sqrt(std::max(1.0f - x * x - y * y, 0.0f));
    }
    std::vector<Image> levels{Image()};
    for (Image& mean : area_levels(unit, threads))
        if (!mean.empty()) levels.push_back(std::move(mean));
    return levels;
}

// Lengths of the vectors of a level; those become 0.5 + 0.5 n, of unit length.
Image taken_lengths(Image& vectors)
{
    Image lengths(vectors.width, vectors.height, 1, ColorSpace::Data);
    for (std::size_t i = 0; i < lengths.pixels.size(); ++i) {
        float* m = &vectors.pixels[3 * i];
        const float length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
        for (int c = 0; c < 3; ++c) m[c] = length > 0.0f ? 0.5f + 0.5f * m[c] / length : c < 2 ? 0.5f : 1.0f;
        lengths.pixels[i] = std::min(length, 1.0f);
    }
    return lengths;
}

std::vector<Image> shares_of(const Image& normals, bool pixels, int threads)
{
    std::vector<Image> shares{Image(normals.width, normals.height, 1, ColorSpace::Data, 1.0f)};
    std::vector<Image> means = mean_normals(normals, threads);
    for (std::size_t k = 1; k < means.size(); ++k) {
        shares.push_back(taken_lengths(means[k]));
        if (!pixels) continue;
        const Image more = pixel_lengths(means[k], threads);
        for (std::size_t i = 0; i < more.pixels.size(); ++i) shares[k].pixels[i] *= more.pixels[i];
    }
    return shares;
}

}  // namespace

std::vector<Image> base_shares(const Image& normals, int threads)
{
    return shares_of(normals, false, threads);
}

std::vector<Image> pixel_base_shares(const Image& normals, int threads)
{
    return shares_of(normals, true, threads);
}

void apply_base_shares(std::vector<Image>& color, const std::vector<Image>& shares,
                       const std::vector<Image>& metallic,
                       const std::vector<Image>& of_metal)
{
    for (std::size_t k = 1; k < color.size(); ++k) {
        Image& level = color[k];
        if (level.empty()) continue;
        const Image share = shares_for(shares, level.width, level.height);
        if (share.empty()) continue;
        const Image mirrored = shares_for(of_metal, level.width, level.height);
        const bool metal = k < metallic.size() && metallic[k].pixels.size() == share.pixels.size();
        const std::size_t step = static_cast<std::size_t>(level.channels);
        for (std::size_t i = 0; i < share.pixels.size(); ++i) {
            const float diffuse =
                metal ? 1.0f - std::clamp(metallic[k].pixels[i], 0.0f, 1.0f) : 1.0f;
            const float of_rest = mirrored.empty() ? 1.0f : mirrored.pixels[i];
            const float factor =
                1.0f - diffuse * (1.0f - share.pixels[i]) - (1.0f - diffuse) * (1.0f - of_rest);
            for (std::size_t c = 0; c < std::min<std::size_t>(step, 3); ++c)
                level.pixels[step * i + c] *= factor;
        }
    }
}

}  // namespace petrichor::texproc
