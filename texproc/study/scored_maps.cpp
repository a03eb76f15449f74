#include "texproc/study/scored_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "texproc/prefilter/detail/input.h"
#include "texproc/study/detail/made_surface.h"

namespace petrichor::texproc {

namespace {

using namespace detail;

// Flakes of 3 x 3 texels at random angles, half of the area, in a smooth lacquer.
MadeTexel glitter(int x, int y)
{
    const Place flake = place(x / 3, y / 3);
    if (flake.uniform(9) < 0.5f) return {0.0f, 0.0f, 0.35f};
    return {0.35f * flake.gaussian(0), 0.35f * flake.gaussian(1), 0.12f};
}

// Strokes along y: slopes across them only.
MadeTexel brushed(int x, int y)
{
    const Place stroke = place(x, 0), grain = place(x, y);
    return {0.3f * stroke.gaussian(0) + 0.03f * grain.gaussian(1), 0.01f * grain.gaussian(2),
            0.22f};
}

// Polished tiles with joints and some matt tiles among them.
MadeTexel two_gloss(int x, int y, int size)
{
    const int tile = size / 8;
    const bool joint = x % tile < 3 || y % tile < 3;
    const bool matt = place(x / tile, y / tile).uniform(5) < 0.3f;
    const Place grain = place(x, y);
    const float rough = joint ? 0.3f : matt ? 0.08f : 0.01f;
    return {rough * grain.gaussian(0), rough * grain.gaussian(1),
            joint  ? 0.9f
            : matt ? 0.6f
                   : 0.1f};
}

MadeTexel rough_noise(int x, int y)
{
    const Place grain = place(x, y);
    return {0.6f * grain.gaussian(0), 0.6f * grain.gaussian(1), 0.75f + 0.25f * grain.uniform(7)};
}

MadeTexel checker(int x, int y)
{
    const float sign = ((x / 2) + (y / 2)) % 2 ? 1.0f : -1.0f;
    const Place grain = place(x, y);
    return {0.45f * sign + 0.01f * grain.gaussian(0), 0.2f * sign + 0.01f * grain.gaussian(1),
            0.2f};
}

// A mirror (alpha 0.0036) crossed by fine scratches in many directions.
MadeTexel scratched(int x, int y, int size)
{
    for (std::uint32_t k = 0; k < 48; ++k) {
        const Place line = place(static_cast<int>(k), 77);
        const float angle = 3.14159265f * line.uniform(0);
        const float nx = std::cos(angle), ny = std::sin(angle);
        const float at = nx * static_cast<float>(x) + ny * static_cast<float>(y);
        const float off = at - static_cast<float>(size) * (1.4f * line.uniform(1) - 0.2f);
        if (std::abs(off) < 1.0f) return {0.4f * off * nx, 0.4f * off * ny, 0.3f};
    }
    return {0.0f, 0.0f, 0.06f};
}

}  // namespace

std::vector<ScoredMaps> hard_maps(int size)
{
    const auto sized = [size](auto surface) {
        return [size, surface](int x, int y) { return surface(x, y, size); };
    };
    return {made_material("glitter", size, size, glitter),
            made_material("brushed metal", size, size, brushed),
            made_material("two-gloss tile", size, size, sized(two_gloss)),
            made_material("rough noise", size, size, rough_noise),
            made_material("slope checker", size, size, checker),
            made_material("scratched mirror", size, size, sized(scratched))};
}

ScoredMaps scored_maps(std::string name, const RawImage& normal, const RawImage& map,
                       const PrefilterOptions& options)
{
    const detail::MapSurface surface =
        detail::make_surface(detail::ref(normal), detail::ref(map), options);
    Image n(surface.width, surface.height, 3, ColorSpace::Data);
    Image r(surface.width, surface.height, 1, ColorSpace::Data);
    detail::SurfaceRow row;
    for (int y = 0; y < surface.height; ++y) {
        detail::fetch(surface, y, row);
        float* to = &n.at(0, y, 0);
        for (std::size_t x = 0; x < row.nx.size(); ++x) {
            *to++ = 0.5f + 0.5f * row.nx[x];
            *to++ = 0.5f + 0.5f * row.ny[x];
            *to++ = 0.5f + 0.5f * row.nz[x];
        }
        std::copy(row.p.begin(), row.p.end(), &r.at(0, y, 0));
    }
    return {std::move(name), to_raw(n, PixelType::U16), to_raw(r, PixelType::U16)};
}

ScoredMaps with_puddles(const ScoredMaps& dry, const Image& height, float share)
{
    if (height.width != dry.normal.width || height.height != dry.normal.height ||
        height.channels != 1) {
        throw Error("puddles: the height map is " + std::to_string(height.width) + " x " +
                        std::to_string(height.height) + ", the material " +
                        std::to_string(dry.normal.width) + " x " +
                        std::to_string(dry.normal.height),
                    "Give the height map of the same material, one channel.");
    }
    constexpr float kWater = 0.08f;  // perceptual roughness of still water with some ripples
    std::vector<float> sorted = height.pixels;
    const std::size_t rank =
        static_cast<std::size_t>(share * static_cast<float>(sorted.size() - 1));
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank),
                     sorted.end());
    const float surface = sorted[rank];
    Image n = to_image(dry.normal, ColorSpace::Data), r = to_image(dry.roughness, ColorSpace::Data);
    for (std::size_t i = 0; i < height.pixels.size(); ++i) {
        float* normal = &n.pixels[3 * i];
        if (height.pixels[i] <= surface) {
            normal[0] = normal[1] = 0.5f;
            normal[2] = 1.0f;
            r.pixels[i] = kWater;
        } else {  // a film: half as rough, not smoother than water
            r.pixels[i] = std::max(kWater, 0.5f * r.pixels[i]);
        }
    }
    return {dry.name + " + puddles", to_raw(n, PixelType::U16), to_raw(r, PixelType::U16)};
}

RawImage rolled(const RawImage& image, int dx, int dy)
{
    RawImage out = image;
    const std::size_t texel = size_of(image.type) * static_cast<std::size_t>(image.channels);
    const std::size_t line = texel * static_cast<std::size_t>(image.width);
    const auto within = [](int v, int n) { return static_cast<std::size_t>(((v % n) + n) % n); };
    const std::size_t shift = texel * within(dx, image.width);
    for (int y = 0; y < image.height; ++y) {
        const std::byte* from = image.bytes.data() + line * static_cast<std::size_t>(y);
        std::byte* to = out.bytes.data() + line * within(y + dy, image.height);
        std::memcpy(to + shift, from, line - shift);
        std::memcpy(to, from + (line - shift), shift);
    }
    return out;
}

}  // namespace petrichor::texproc
