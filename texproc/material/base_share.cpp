#include "texproc/material/base_share.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "texproc/filter/area.h"

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

}  // namespace

std::vector<Image> base_shares(const Image& normals, int threads)
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
    std::vector<Image> shares{Image(normals.width, normals.height, 1, ColorSpace::Data, 1.0f)};
    for (const Image& mean : area_levels(unit, threads)) {
        if (mean.empty()) continue;
        Image& share = shares.emplace_back(mean.width, mean.height, 1, ColorSpace::Data);
        for (std::size_t i = 0; i < share.pixels.size(); ++i) {
            const float* m = &mean.pixels[3 * i];
            share.pixels[i] = std::min(std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]), 1.0f);
        }
    }
    return shares;
}

void apply_base_shares(std::vector<Image>& color, const std::vector<Image>& shares,
                       const std::vector<Image>& metallic)
{
    for (std::size_t k = 1; k < color.size(); ++k) {
        Image& level = color[k];
        if (level.empty()) continue;
        const Image share = shares_for(shares, level.width, level.height);
        if (share.empty()) continue;
        const bool metal = k < metallic.size() && metallic[k].pixels.size() == share.pixels.size();
        const std::size_t step = static_cast<std::size_t>(level.channels);
        for (std::size_t i = 0; i < share.pixels.size(); ++i) {
            const float diffuse =
                metal ? 1.0f - std::clamp(metallic[k].pixels[i], 0.0f, 1.0f) : 1.0f;
            const float factor = 1.0f - diffuse * (1.0f - share.pixels[i]);
            for (std::size_t c = 0; c < std::min<std::size_t>(step, 3); ++c)
                level.pixels[step * i + c] *= factor;
        }
    }
}

}  // namespace petrichor::texproc
