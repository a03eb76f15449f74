#include "texproc/filter/mips.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "base/error.h"
#include "texproc/filter/area.h"
#include "texproc/filter/detail/alpha.h"

namespace petrichor::texproc {

namespace {

double coverage(const Image& image, float cutoff)
{
    std::size_t over = 0;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) over += image.pixels[i] > cutoff;
    return static_cast<double>(over) / (static_cast<double>(image.pixels.size()) / 4.0);
}

// Scales alpha so that as many texels as `wanted` asks for lie above the cutoff: the value that
// must come to lie just above it is found by order, not by search.
void keep_coverage(Image& level, float cutoff, double wanted)
{
    std::vector<float> alpha;
    for (std::size_t i = 3; i < level.pixels.size(); i += 4) alpha.push_back(level.pixels[i]);
    const std::size_t above =
        std::min(alpha.size(),
                 static_cast<std::size_t>(std::lround(wanted * static_cast<double>(alpha.size()))));
    std::sort(alpha.begin(), alpha.end(), std::greater<>());
    // Between the last texel that counts and the first that does not.
    const float in = above > 0 ? alpha[above - 1] : 2.0f * std::max(alpha.front(), cutoff);
    const float out = above < alpha.size() ? alpha[above] : 0.0f;
    const float edge = 0.5f * (in + out);
    if (!(edge > 0.0f)) return;
    const float scale = cutoff / edge;
    for (std::size_t i = 3; i < level.pixels.size(); i += 4) {
        level.pixels[i] = std::min(1.0f, level.pixels[i] * scale);
    }
}

// Vectors of unit length; where there is no direction (a zero normal) it is straight up.
void normalize_texels(Image& image)
{
    const std::size_t step = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.pixels.size(); i += step) {
        float* p = &image.pixels[i];
        const float x = 2.0f * p[0] - 1.0f, y = 2.0f * p[1] - 1.0f, z = 2.0f * p[2] - 1.0f;
        const float length = std::sqrt(x * x + y * y + z * z);
        const bool fine = length > 0.01f;  // a zero in 8 bits is not exactly zero
        p[0] = fine ? 0.5f + 0.5f * (x / length) : 0.5f;
        p[1] = fine ? 0.5f + 0.5f * (y / length) : 0.5f;
        p[2] = fine ? 0.5f + 0.5f * (z / length) : 1.0f;
    }
}

std::vector<Image> smaller_levels(const Image& image, const MipOptions& options)
{
    if (options.filter == MipFilter::Box) return area_levels(image, options.threads);
    const Edge u = options.mirror_u ? Edge::Mirror : options.wrap_u ? Edge::Wrap : Edge::Clamp;
    const Edge v = options.mirror_v ? Edge::Mirror : options.wrap_v ? Edge::Wrap : Edge::Clamp;
    std::vector<Image> chain;
    const std::vector<LevelSize> sizes = level_sizes(image.width, image.height);
    for (std::size_t k = 1; k < sizes.size(); ++k) {
        chain.push_back(resampled(chain.empty() ? image : chain.back(), sizes[k].width,
                                  sizes[k].height, options.filter, u, v, options.threads));
    }
    return chain;
}

// Where the image is opaque the plain levels are right, to the bit.
std::vector<Image> color_levels(const Image& image, const MipOptions& options)
{
    std::vector<Image> chain = smaller_levels(image, options);
    const bool weighted = options.alpha_weighted && image.space == ColorSpace::Linear;
    if (!weighted || !detail::has_holes(image)) return chain;
    const std::vector<Image> covered = smaller_levels(detail::premultiplied(image), options);
    for (std::size_t k = 0; k < chain.size(); ++k) {
        chain[k] = detail::straight(covered[k], chain[k], options.wrap_u, options.wrap_v);
    }
    return chain;
}

}  // namespace

std::vector<Image> mip_chain(Image image, const MipOptions& options)
{
    if (image.empty()) throw Error("mips: the image is empty", "Pass an image with pixels.");
    if (options.normals && image.channels < 3) {
        throw Error("mips: a normal map needs 3 channels, got " + std::to_string(image.channels),
                    "Rebuild z first, or filter it as plain data.");
    }
    const bool cut = options.alpha_cutoff >= 0.0f;
    if (cut && image.channels != 4) {
        throw Error("mips: alpha coverage needs 4 channels, got " + std::to_string(image.channels),
                    "Leave alpha_cutoff negative for an image without alpha.");
    }
    std::vector<Image> chain;
    if (options.normals) {
        Image unit = options.drop_first && !cut ? std::move(image) : image;
        normalize_texels(unit);  // a vector that is too long must not count for more
        chain = smaller_levels(unit, options);
        if (!options.keep_length) {
            for (Image& level : chain) normalize_texels(level);
        }
    } else {
        chain = color_levels(image, options);
    }
    if (cut) {
        const double wanted = coverage(image, options.alpha_cutoff);
        for (Image& level : chain) keep_coverage(level, options.alpha_cutoff, wanted);
    }
    chain.insert(chain.begin(), options.drop_first ? Image() : std::move(image));
    return chain;
}

}  // namespace petrichor::texproc
