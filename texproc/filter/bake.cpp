#include "texproc/filter/bake.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/portable_math.h"
#include "texproc/filter/detail/morphology.h"

namespace petrichor::texproc {

namespace {

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
    parallel_for(static_cast<std::size_t>(like.height), threads, [&](std::size_t y) {
        for (int x = 0; x < like.width; ++x) {
            value(x, static_cast<int>(y), &out.pixels[out.index(x, static_cast<int>(y), 0)]);
        }
    });
    return out;
}

Image first_channel(const Image& image, int threads)
{
    return map_texels(image, 1, threads, [&](int x, int y, float* to) { *to = image.at(x, y, 0); });
}

// Mean over a square of 2 radius + 1, past the edges as the options say, by running sums in double:
// along the rows, then all columns side by side in bands, so that memory is read in order.
Image blurred(const Image& height, int radius, const BakeOptions& options)
{
    const int threads = options.threads;
    const int w = height.width, h = height.height, side = 2 * radius + 1;
    Image once(w, h, 1, ColorSpace::Data), twice = once;
    parallel_for(static_cast<std::size_t>(h), threads, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k)
            sum += static_cast<double>(height.at(edge_index(k, w, options.edge_u), y, 0));
        for (int x = 0; x < w; ++x) {
            once.at(x, y, 0) = static_cast<float>(sum / side);
            sum += static_cast<double>(
                       height.at(edge_index(x + radius + 1, w, options.edge_u), y, 0)) -
                   static_cast<double>(height.at(edge_index(x - radius, w, options.edge_u), y, 0));
        }
    });
    constexpr int kBand = 64;
    parallel_for(static_cast<std::size_t>((w + kBand - 1) / kBand), threads, [&](std::size_t band) {
        const int first = static_cast<int>(band) * kBand, last = std::min(w, first + kBand);
        double sums[kBand] = {};
        const auto add = [&](int y, double sign) {
            const float* row = &once.pixels[once.index(0, edge_index(y, h, options.edge_v), 0)];
            for (int x = first; x < last; ++x)
                sums[x - first] += sign * static_cast<double>(row[x]);
        };
        for (int k = -radius; k <= radius; ++k) add(k, 1.0);
        for (int y = 0; y < h; ++y) {
            for (int x = first; x < last; ++x)
                twice.at(x, y, 0) = static_cast<float>(sums[x - first] / side);
            add(y + radius + 1, 1.0);
            add(y - radius, -1.0);
        }
    });
    return twice;
}

// The depth that one wet texel in two hundred exceeds: a few spikes of a scan must not make all the
// rest look dry.
float usual_deepest(const std::vector<float>& depths)
{
    std::vector<float> wet;
    for (const float d : depths) {
        if (d > 0.0f) wet.push_back(d);
    }
    if (wet.empty()) return 0.0f;
    const auto at = wet.begin() + static_cast<std::ptrdiff_t>((wet.size() - 1) * 995 / 1000);
    std::nth_element(wet.begin(), at, wet.end());
    return *at;
}

// The closing by an octagon. The sliding windows run round and round, so axes that do not wrap get
// a border wider than both steps look.
Image closing(const Image& one, int radius, const BakeOptions& options)
{
    const int border_u = options.edge_u == Edge::Wrap ? 0 : 2 * radius + 2;
    const int border_v = options.edge_v == Edge::Wrap ? 0 : 2 * radius + 2;
    const auto at = [&](const Image& from, int x, int y) {
        return from.at(edge_index(x, from.width, options.edge_u),
                       edge_index(y, from.height, options.edge_v), 0);
    };
    const Image wide =
        map_texels(Image(one.width + 2 * border_u, one.height + 2 * border_v, 1, ColorSpace::Data),
                   1, options.threads,
                   [&](int x, int y, float* to) { *to = at(one, x - border_u, y - border_v); });
    const Image closed =
        detail::extreme_within(detail::extreme_within(wide, radius, 1.0f, options.threads), radius,
                               -1.0f, options.threads);
    return map_texels(one, 1, options.threads, [&](int x, int y, float* to) {
        *to = closed.at(x + border_u, y + border_v, 0);
    });
}

Hollows hollows(const Image& height, int radius, const BakeOptions& options)
{
    Image one = first_channel(height, options.threads);
    const Image closed = closing(one, radius, options);
    Hollows out;
    out.depth = std::move(one);
    for (std::size_t i = 0; i < out.depth.pixels.size(); ++i) {
        out.depth.pixels[i] = std::max(0.0f, closed.pixels[i] - out.depth.pixels[i]);
    }
    out.deepest = usual_deepest(out.depth.pixels);
    if (out.deepest > 0.0f) {
        for (float& v : out.depth.pixels) v = std::min(1.0f, v / out.deepest);
    }
    std::vector<std::size_t> deeper(65, 0);
    for (const float v : out.depth.pixels) {
        if (v > 0.0f) ++deeper[static_cast<std::size_t>(std::min(64.0f, v * 64.0f))];
    }
    out.covered.resize(65);
    std::size_t sum = 0;
    for (std::size_t k = 65; k-- > 0;) {
        sum += deeper[k];
        out.covered[k] = static_cast<float>(sum) / static_cast<float>(out.depth.pixels.size());
    }
    return out;
}

int texels(float share, int width)
{
    return std::max(1, static_cast<int>(share * static_cast<float>(width) + 0.5f));
}

}  // namespace

Image ambient_occlusion(const Image& height, const BakeOptions& options)
{
    check(height, options);
    constexpr int kDirections = 16, kSteps = 12;
    const float reach = std::max(1.0f, options.reach * static_cast<float>(height.width));
    const float rise = options.depth * static_cast<float>(height.width);
    // Where a direction looks: steps grow with the distance, since near texels matter most.
    struct Sample {
        int x, y;
        float per_texel;  // height to tangent
    };
    std::vector<Sample> samples[kDirections];
    for (int d = 0; d < kDirections; ++d) {
        const float angle = 6.2831853f * static_cast<float>(d) / kDirections;
        for (int s = 1; s <= kSteps; ++s) {
            const float share = static_cast<float>(s) / kSteps;
            const float r = std::max(static_cast<float>(s), reach * share * share);
            if (r > reach) break;
            samples[d].push_back({static_cast<int>(std::lround(r * portable_cos(angle))),
                                  static_cast<int>(std::lround(r * portable_sin(angle))),
                                  rise / r});
        }
    }
    const int w = height.width, h = height.height;
    const std::vector<float> plane = first_channel(height, options.threads).pixels;
    const int far = static_cast<int>(reach) + 1;
    return map_texels(height, 1, options.threads, [&](int x, int y, float* to) {
        const float here = plane[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                                 static_cast<std::size_t>(x)];
        const bool inside = x >= far && y >= far && x + far < w && y + far < h;
        float open = 0.0f;
        for (const std::vector<Sample>& direction : samples) {
            float steepest = 0.0f;  // tangent of the horizon
            for (const Sample& s : direction) {
                const int u = inside ? x + s.x : edge_index(x + s.x, w, options.edge_u),
                          v = inside ? y + s.y : edge_index(y + s.y, h, options.edge_v);
                const float there =
                    plane[static_cast<std::size_t>(v) * static_cast<std::size_t>(w) +
                          static_cast<std::size_t>(u)];
                steepest = std::max(steepest, (there - here) * s.per_texel);
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
    const Image mean = blurred(height, std::max(0, radius), options);
    double square = 0.0;
    for (int y = 0; y < height.height; ++y) {
        for (int x = 0; x < height.width; ++x) {
            const double d = static_cast<double>(height.at(x, y, 0) - mean.at(x, y, 0));
            square += d * d;
        }
    }
    const float spread =
        static_cast<float>(std::sqrt(square / static_cast<double>(mean.pixels.size())));
    return map_texels(height, 1, options.threads, [&](int x, int y, float* to) {
        const float d = height.at(x, y, 0) - mean.at(x, y, 0);
        *to = spread > 1e-6f ? std::clamp(0.5f + 0.2f * d / spread, 0.0f, 1.0f) : 0.5f;
    });
}

Image curvature(const Image& height, const BakeOptions& options)
{
    check(height, options);
    const float rise = options.depth * static_cast<float>(height.width);
    const int most = (std::min(height.width, height.height) - 1) / 2;
    Image out(height.width, height.height, 1, ColorSpace::Data, 0.5f);
    // A bend of one radius lies sixfold above the mean around it; three widths of edges are seen,
    // from a texel of a map of 1024 on.
    for (const int scale : {1, 2, 4}) {
        const int radius = std::min(most, std::max(scale, scale * height.width / 1024));
        if (radius < 1) continue;
        const Image mean = blurred(height, radius, options);
        const float strength = rise / static_cast<float>(radius);
        for (int y = 0; y < out.height; ++y) {
            for (int x = 0; x < out.width; ++x) {
                const float bend = strength * (height.at(x, y, 0) - mean.at(x, y, 0));
                out.at(x, y, 0) += bend / (3.0f * (1.0f + std::abs(bend)));
            }
        }
    }
    for (float& v : out.pixels) v = std::clamp(v, 0.0f, 1.0f);
    return out;
}

Hollows puddles(const Image& height, const BakeOptions& options)
{
    check(height, options);
    return hollows(height, texels(options.reach, height.width), options);
}

Hollows cracks(const Image& height, const BakeOptions& options)
{
    check(height, options);
    return hollows(height, texels(0.2f * options.reach, height.width), options);
}

Image flow_direction(const Image& height, const BakeOptions& options)
{
    check(height, options);
    const int radius = std::min(std::max(1, texels(0.1f * options.reach, height.width)),
                                (std::min(height.width, height.height) - 1) / 2);
    const Image smooth = blurred(height, std::max(0, radius), options);
    const float rise = options.depth * static_cast<float>(height.width) * 0.5f;
    return map_texels(height, 3, options.threads, [&](int x, int y, float* to) {
        const auto at = [&](int u, int v) {
            return smooth.at(edge_index(u, smooth.width, options.edge_u),
                             edge_index(v, smooth.height, options.edge_v), 0);
        };
        const float du = -rise * (at(x + 1, y) - at(x - 1, y));
        const float dv = -rise * (at(x, y + 1) - at(x, y - 1));
        const float slope = std::sqrt(du * du + dv * dv);
        to[0] = slope > 1e-6f ? 0.5f + 0.5f * du / slope : 0.5f;
        to[1] = slope > 1e-6f ? 0.5f + 0.5f * dv / slope : 0.5f;
        to[2] = std::min(1.0f, slope);
    });
}

Image porosity(const Image& roughness, const Image& metallic)
{
    if (roughness.empty())
        throw Error("bake: the roughness map is empty", "Pass a map with pixels.");
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
