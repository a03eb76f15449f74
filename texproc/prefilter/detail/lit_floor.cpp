#include "texproc/prefilter/detail/lit_floor.h"

#include <utility>

#include "texproc/filter/area.h"

namespace petrichor::texproc::detail {

Levels plain_levels(Level base)
{
    Levels levels;
    levels.push_back(std::move(base));
    const Level& first = levels.front();
    const std::vector<LevelSize> sizes = level_sizes(first.width, first.height);
    for (std::size_t k = 1; k < sizes.size(); ++k)
        levels.push_back({sizes[k].width, sizes[k].height,
                          std::vector<Texel>(static_cast<std::size_t>(sizes[k].width) *
                                             static_cast<std::size_t>(sizes[k].height))});
    for (int c = 0; c < 4; ++c) {  // one at a time: a large map is large
        Image plane(levels[0].width, levels[0].height, 1, ColorSpace::Data);
        for (std::size_t i = 0; i < plane.pixels.size(); ++i) {
            const Texel t = levels[0].at(i);
            plane.pixels[i] = c < 3 ? t.n[c] : t.stored;
        }
        const std::vector<Image> smaller = area_levels(plane);
        for (std::size_t k = 1; k < levels.size(); ++k)
            for (std::size_t i = 0; i < levels[k].texels.size(); ++i) {
                Texel& t = levels[k].texels[i];
                (c < 3 ? t.n[c] : t.stored) = smaller[k - 1].pixels[i];
            }
    }
    for (std::size_t k = 1; k < levels.size(); ++k) {
        for (Texel& t : levels[k].texels) {
            const float length = glm::length(t.n);
            t.n = length > 0.0f ? t.n / length : glm::vec3(0.0f, 0.0f, 1.0f);
        }
    }
    return levels;
}

Taps taps_of(const Levels& levels, const FloorPixel& pixel, int most_taps)
{
    const Level& base = levels.front();
    const double ax = pixel.across_u * base.width, ay = pixel.across_v * base.height;
    const double bx = pixel.along_u * base.width, by = pixel.along_v * base.height;
    double longer = std::hypot(ax, ay), shorter = std::hypot(bx, by);
    double du = pixel.across_u, dv = pixel.across_v;
    if (shorter > longer) {
        std::swap(longer, shorter);
        du = pixel.along_u, dv = pixel.along_v;
    }
    const int taps =
        std::clamp(static_cast<int>(std::ceil(longer / std::max(shorter, 1e-9))), 1, most_taps);
    const double top = static_cast<double>(levels.size() - 1);
    const double lod = std::clamp(std::log2(std::max(longer / taps, 1e-9)), 0.0, top);
    Taps to;
    to.count = taps;
    to.step_u = du / taps, to.step_v = dv / taps;
    to.u = pixel.u + (0.5 / taps - 0.5) * du, to.v = pixel.v + (0.5 / taps - 0.5) * dv;
    to.fine = std::min(static_cast<std::size_t>(lod), levels.size() - 1);
    to.coarse = std::min(to.fine + 1, levels.size() - 1);
    to.share = static_cast<float>(lod - static_cast<double>(to.fine));
    return to;
}

}  // namespace petrichor::texproc::detail
