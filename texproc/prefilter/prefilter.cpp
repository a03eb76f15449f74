#include "texproc/prefilter/prefilter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "texproc/filter/area.h"
#include "texproc/filter/pixel_length.h"
#include "texproc/prefilter/detail/filter.h"
#include "texproc/prefilter/detail/input.h"
#include "texproc/prefilter/detail/picture_settle.h"
#include "texproc/prefilter/detail/walk.h"
#include "texproc/prefilter/lux.h"

namespace petrichor::texproc {

namespace {

using namespace detail;

std::uint8_t code(float v)
{
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

// The compatible rule works on 8-bit codes and knows smoothness only.
void lux_roughness(const MapSurface& surface, const PrefilterOptions& options, Prefiltered& out)
{
    const int size = surface.width;
    if (surface.height != size) {
        throw Error("lux: the compatible rule needs square maps of a power of two, got " +
                        std::to_string(size) + " x " + std::to_string(surface.height),
                    "Use the rule lux-formula (same formula, exact footprints) or moments.");
    }
    if (options.alpha) {
        throw Error("lux: the compatible rule knows smoothness and perceptual roughness, not alpha",
                    "Use the rule lux-formula.");
    }
    const std::size_t texels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    const auto codes = [&](const MapPlane& plane) {
        std::vector<float> values(texels);
        plane_values(plane, 0, texels, values.data());
        std::vector<std::uint8_t> all(texels);
        std::transform(values.begin(), values.end(), all.begin(), code);
        return all;
    };
    const std::vector<std::uint8_t> x = codes(surface.x), y = codes(surface.y);
    std::vector<std::vector<std::uint8_t>> mips;
    for (std::size_t k = 1; k < out.roughness.size(); ++k) {
        std::vector<std::uint8_t>& level = mips.emplace_back();
        for (const float r : out.roughness[k].pixels) {
            level.push_back(code(options.smoothness ? r : 1.0f - r));
        }
    }
    const auto filtered = lux_smoothness_mips(x, y, mips, size);
    for (std::size_t k = 1; k < out.roughness.size(); ++k) {
        for (std::size_t i = 0; i < filtered[k - 1].size(); ++i) {
            const float s = static_cast<float>(filtered[k - 1][i]) / 255.0f;
            out.roughness[k].pixels[i] = options.smoothness ? s : 1.0f - s;
        }
    }
}

// What a pixel loses by blending normals, beside what its texels lost.
void widen_base_share(Prefiltered& chain, int threads)
{
    for (std::size_t k = 1; k < chain.base_share.size(); ++k) {
        const Image lengths = pixel_lengths(chain.normal[k], threads);
        for (std::size_t i = 0; i < lengths.pixels.size(); ++i)
            chain.base_share[k].pixels[i] *= lengths.pixels[i];
    }
}

using Wanted = std::function<bool(int, int, int)>;

// All variants in one walk; `wanted` empty: every texel.
std::vector<Prefiltered> filtered(const MapSurface& surface,
                                  const std::vector<PrefilterOptions>& variants,
                                  const Wanted& wanted)
{
    const std::vector<LevelSize> sizes = level_sizes(surface.width, surface.height);
    std::vector<Filter> filters;
    std::vector<Prefiltered> chains;
    WalkOptions walking;
    walking.wanted = wanted;
    for (const PrefilterOptions& o : variants) {
        filters.emplace_back(o, surface);
        chains.push_back(empty_chain(sizes, o));
        walking.cells |= filters.back().needs_cells();
        walking.own_lobes |= o.rule == "vmf";
        if (o.rule == "overlap" || o.rule == "picture") walking.apart = kApart;
    }
    walking.threads = variants.front().threads;
    walking.progress = variants.front().progress;
    walk(surface, walking, [&](const MipTexel& texel) {
        for (std::size_t i = 0; i < filters.size(); ++i) {
            store(filters[i](texel), texel, variants[i], chains[i]);
        }
    });
    for (std::size_t i = 0; i < variants.size(); ++i) {
        if (variants[i].rule == "lux") lux_roughness(surface, variants[i], chains[i]);
        if (variants[i].rule == "picture" && !wanted) {
            widen_base_share(chains[i], variants[i].threads);
            settle_picture(surface, variants[i], chains[i]);
        }
    }
    return chains;
}

Prefiltered filtered(const MapSurface& surface, const PrefilterOptions& options)
{
    if (options.lobes != 1 && options.lobes != 2) {
        throw Error("prefilter: lobes must be 1 or 2, got " + std::to_string(options.lobes),
                    "Ask for one or two lobes.");
    }
    if (options.lobes == 2 && (options.rule != "picture" || options.quick || !options.joint)) {
        throw Error("prefilter: a second lobe is made by the rule picture in full quality, with normals",
                    "Use that rule and write normals, or leave the second lobe out.");
    }
    return std::move(filtered(surface, std::vector{options}, {}).front());
}

}  // namespace

Prefiltered prefilter(const Image& normal, const Image& roughness, const PrefilterOptions& options)
{
    if (roughness.channels > 1 && options.channel == 0) {
        throw Error("prefilter: the roughness map has " + std::to_string(roughness.channels) +
                        " channels, 1 is needed",
                    "Choose the channel that holds it.");
    }
    const MapSurface surface = make_surface(ref(normal), ref(roughness), options);
    Prefiltered out = filtered(surface, options);
    out.roughness[0] = roughness;
    out.normal[0] = Image(normal.width, normal.height, 3, ColorSpace::Data);
    SurfaceRow row;
    for (int y = 0; y < normal.height; ++y) {
        fetch(surface, y, row);
        float* to = &out.normal[0].at(0, y, 0);
        for (std::size_t x = 0; x < row.nx.size(); ++x) {
            const float ny = options.green_down ? -row.ny[x] : row.ny[x];
            *to++ = 0.5f + 0.5f * row.nx[x];
            *to++ = 0.5f + 0.5f * ny;
            *to++ = 0.5f + 0.5f * row.nz[x];
        }
    }
    if (!out.base_share.empty())
        out.base_share[0] = Image(normal.width, normal.height, 1, ColorSpace::Data, 1.0f);
    if (options.anisotropic) {
        out.anisotropy[0] = Image(normal.width, normal.height, 3, ColorSpace::Data, 0.5f);
        for (std::size_t i = 0; i < out.anisotropy[0].pixels.size(); i += 3) {
            out.anisotropy[0].pixels[i] = 1.0f;
            out.anisotropy[0].pixels[i + 2] = 0.0f;
        }
    }
    return out;
}

Prefiltered prefilter_raw(const RawImage& normal, const RawImage& roughness,
                          const PrefilterOptions& options)
{
    return filtered(make_surface(ref(normal), ref(roughness), options), options);
}

std::vector<Prefiltered> prefilter_some(const RawImage& normal, const RawImage& roughness,
                                        const std::vector<PrefilterOptions>& variants,
                                        const Wanted& wanted)
{
    if (variants.empty()) return {};
    return filtered(make_surface(ref(normal), ref(roughness), variants.front()), variants, wanted);
}

}  // namespace petrichor::texproc
