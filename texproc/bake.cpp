#include "texproc/bake.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "texproc/detail/parallel.h"

namespace petrichor::texproc {

namespace {

int wrapped(int i, int size) { return (i % size + size) % size; }

void check(const Image& height, const BakeOptions& options)
{
    if (height.empty()) throw Error("bake: the height map is empty", "Pass a map with pixels.");
    if (!(options.depth > 0.0f && options.reach > 0.0f && options.reach <= 0.5f)) {
        throw Error("bake: depth must be above 0 and reach in (0, 0.5], got " +
                        std::to_string(options.depth) + " and " + std::to_string(options.reach),
                    "Use the defaults: 0.05 each.");
    }
}

template <class Value>
Image map_texels(const Image& like, int channels, int threads, const Value& value)
{
    Image out(like.width, like.height, channels, ColorSpace::Data);
    detail::parallel_for(static_cast<std::size_t>(like.height), threads, [&](std::size_t y) {
        for (int x = 0; x < like.width; ++x) {
            value(x, static_cast<int>(y), &out.pixels[out.index(x, static_cast<int>(y), 0)]);
        }
    });
    return out;
}

// Mean over a square of 2 radius + 1, wrapping, by running sums in double.
Image blurred(const Image& height, int radius)
{
    Image once(height.width, height.height, 1, ColorSpace::Data), twice = once;
    const int side = 2 * radius + 1;
    for (int y = 0; y < height.height; ++y) {
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k) {
            sum += static_cast<double>(height.at(wrapped(k, height.width), y, 0));
        }
        for (int x = 0; x < height.width; ++x) {
            once.at(x, y, 0) = static_cast<float>(sum / side);
            sum += static_cast<double>(height.at(wrapped(x + radius + 1, height.width), y, 0)) -
                   static_cast<double>(height.at(wrapped(x - radius, height.width), y, 0));
        }
    }
    for (int x = 0; x < height.width; ++x) {
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k) {
            sum += static_cast<double>(once.at(x, wrapped(k, height.height), 0));
        }
        for (int y = 0; y < height.height; ++y) {
            twice.at(x, y, 0) = static_cast<float>(sum / side);
            sum += static_cast<double>(once.at(x, wrapped(y + radius + 1, height.height), 0)) -
                   static_cast<double>(once.at(x, wrapped(y - radius, height.height), 0));
        }
    }
    return twice;
}

// Largest (sign 1) or smallest (sign -1) value within an octagon-like disc, built from square and
// diamond steps whose cost does not depend on the map.
Image dilated(const Image& image, int radius, float sign, int threads)
{
    Image from = image;
    for (int step = 0; step < radius; ++step) {
        const bool diamond = step % 2 == 1;
        from = map_texels(from, 1, threads, [&](int x, int y, float* to) {
            float best = sign * from.at(x, y, 0);
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    if (diamond && dx != 0 && dy != 0) continue;
                    best = std::max(best, sign * from.at(wrapped(x + dx, from.width),
                                                         wrapped(y + dy, from.height), 0));
                }
            }
            *to = sign * best;
        });
    }
    return from;
}

Hollows hollows(const Image& height, int radius, int threads)
{
    Image one = map_texels(height, 1, threads,
                           [&](int x, int y, float* to) { *to = height.at(x, y, 0); });
    const Image closed = dilated(dilated(one, radius, 1.0f, threads), radius, -1.0f, threads);
    Hollows out;
    out.depth = std::move(one);
    for (std::size_t i = 0; i < out.depth.pixels.size(); ++i) {
        out.depth.pixels[i] = std::max(0.0f, closed.pixels[i] - out.depth.pixels[i]);
        out.deepest = std::max(out.deepest, out.depth.pixels[i]);
    }
    if (out.deepest > 0.0f) {
        for (float& v : out.depth.pixels) v /= out.deepest;
    }
    std::vector<std::size_t> deeper(65, 0);
    for (const float v : out.depth.pixels) {
        if (v > 0.0f) ++deeper[static_cast<std::size_t>(std::min(64.0f, v * 64.0f))];
    }
    out.covered.resize(65);
    std::size_t sum = 0;
    for (std::size_t k = 65; k-- > 0;) {
        sum += deeper[k];
        out.covered[k] =
            static_cast<float>(sum) / static_cast<float>(out.depth.pixels.size());
    }
    return out;
}

int texels(float share, int width) { return std::max(1, static_cast<int>(share * static_cast<float>(width) + 0.5f)); }

}  // namespace

Image ambient_occlusion(const Image& height, const BakeOptions& options)
{
    check(height, options);
    constexpr int kDirections = 16, kSteps = 12;
    const float reach = std::max(1.0f, options.reach * static_cast<float>(height.width));
    const float rise = options.depth * static_cast<float>(height.width);
    return map_texels(height, 1, options.threads, [&](int x, int y, float* to) {
        const float here = height.at(x, y, 0);
        float open = 0.0f;
        for (int d = 0; d < kDirections; ++d) {
            const float angle = 6.2831853f * static_cast<float>(d) / kDirections;
            const float cx = std::cos(angle), cy = std::sin(angle);
            float steepest = 0.0f;  // tangent of the horizon
            for (int s = 1; s <= kSteps; ++s) {
                // Steps grow with the distance: near texels matter most.
                const float share = static_cast<float>(s) / kSteps;
                const float r = std::max(static_cast<float>(s), reach * share * share);
                if (r > std::max(reach, 1.0f)) break;
                const int u = wrapped(x + static_cast<int>(std::lround(r * cx)), height.width);
                const int v = wrapped(y + static_cast<int>(std::lround(r * cy)), height.height);
                steepest = std::max(steepest, (height.at(u, v, 0) - here) * rise / r);
            }
            open += 1.0f / (1.0f + steepest * steepest);  // cos^2 of the horizon
        }
        *to = open / kDirections;
    });
}

Image cavity(const Image& height, const BakeOptions& options)
{
    check(height, options);
    const int radius = std::min(texels(options.reach, height.width),
                                (std::min(height.width, height.height) - 1) / 2);
    const Image mean = blurred(height, std::max(0, radius));
    double square = 0.0;
    for (int y = 0; y < height.height; ++y) {
        for (int x = 0; x < height.width; ++x) {
            const double d = static_cast<double>(height.at(x, y, 0) - mean.at(x, y, 0));
            square += d * d;
        }
    }
    const float spread = static_cast<float>(
        std::sqrt(square / static_cast<double>(mean.pixels.size())));
    return map_texels(height, 1, options.threads, [&](int x, int y, float* to) {
        const float d = height.at(x, y, 0) - mean.at(x, y, 0);
        *to = spread > 1e-6f ? std::clamp(0.5f + 0.2f * d / spread, 0.0f, 1.0f) : 0.5f;
    });
}

Image curvature(const Image& height, const BakeOptions& options)
{
    check(height, options);
    const float rise = options.depth * static_cast<float>(height.width);
    return map_texels(height, 1, options.threads, [&](int x, int y, float* to) {
        const auto at = [&](int dx, int dy) {
            return height.at(wrapped(x + dx, height.width), wrapped(y + dy, height.height), 0);
        };
        const float round = 4.0f * at(0, 0) - at(1, 0) - at(-1, 0) - at(0, 1) - at(0, -1);
        *to = std::clamp(0.5f + 0.25f * rise * round, 0.0f, 1.0f);
    });
}

Hollows puddles(const Image& height, const BakeOptions& options)
{
    check(height, options);
    return hollows(height, texels(options.reach, height.width), options.threads);
}

Hollows cracks(const Image& height, const BakeOptions& options)
{
    check(height, options);
    return hollows(height, texels(0.2f * options.reach, height.width), options.threads);
}

Image flow_direction(const Image& height, const BakeOptions& options)
{
    check(height, options);
    const int radius = std::min(std::max(1, texels(0.1f * options.reach, height.width)),
                                (std::min(height.width, height.height) - 1) / 2);
    const Image smooth = blurred(height, std::max(0, radius));
    const float rise = options.depth * static_cast<float>(height.width) * 0.5f;
    return map_texels(height, 3, options.threads, [&](int x, int y, float* to) {
        const float du = -rise * (smooth.at(wrapped(x + 1, smooth.width), y, 0) -
                                  smooth.at(wrapped(x - 1, smooth.width), y, 0));
        const float dv = -rise * (smooth.at(x, wrapped(y + 1, smooth.height), 0) -
                                  smooth.at(x, wrapped(y - 1, smooth.height), 0));
        const float slope = std::sqrt(du * du + dv * dv);
        to[0] = slope > 1e-6f ? 0.5f + 0.5f * du / slope : 0.5f;
        to[1] = slope > 1e-6f ? 0.5f + 0.5f * dv / slope : 0.5f;
        to[2] = std::min(1.0f, slope);
    });
}

Image porosity(const Image& roughness, const Image& metallic)
{
    if (roughness.empty()) throw Error("bake: the roughness map is empty", "Pass a map with pixels.");
    if (!metallic.empty() &&
        (metallic.width != roughness.width || metallic.height != roughness.height)) {
        throw Error("bake: roughness and metallic have different sizes", "Resample one of them.");
    }
    return map_texels(roughness, 1, 0, [&](int x, int y, float* to) {
        const float metal = metallic.empty() ? 0.0f : metallic.at(x, y, 0);
        *to = std::clamp((roughness.at(x, y, 0) - 0.5f) / 0.4f, 0.0f, 1.0f) * (1.0f - metal);
    });
}

}  // namespace petrichor::texproc
