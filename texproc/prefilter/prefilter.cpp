#include "texproc/prefilter/prefilter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "texproc/area.h"
#include "texproc/detail/input.h"
#include "texproc/prefilter/detail/walk.h"
#include "texproc/prefilter/lux.h"
#include "texproc/prefilter/overlap.h"
#include "texproc/prefilter/rules.h"

namespace petrichor::texproc {

namespace {

using namespace detail;

float perceptual(float alpha2) { return std::sqrt(std::sqrt(std::clamp(alpha2, 0.0f, 1.0f))); }

std::uint32_t seed_of(int level, int x, int y)
{
    std::uint32_t h = 2166136261u;
    for (const int v : {level, x, y}) h = (h ^ static_cast<std::uint32_t>(v)) * 16777619u;
    return h ^ (h >> 15);
}

// The lobe that a rule gives to a texel.
class Filter {
public:
    explicit Filter(const PrefilterOptions& options) : o_(options), kind_(rule_named(o_.rule).kind)
    {
        overlap_ = {o_.design_light, o_.joint, o_.anisotropic, o_.quick};
        if (o_.rule == "lux") plain_ = true;  // replaced by codes afterwards
    }

    bool needs_cells() const { return kind_ != RuleKind::Moments; }

    FittedLobe operator()(const MipTexel& t) const
    {
        const Means& m = t.means;
        const Direction mean = normalized({m.nx, m.ny, m.nz});
        if (kind_ == RuleKind::Search) {
            return fit_overlap(*t.cells, m, t.level, seed_of(t.level, t.x, t.y), overlap_);
        }
        FittedLobe lobe{mean, 0.0f, false, {}, 0.0f, 0.0f};
        if (kind_ == RuleKind::Moments) {
            const float length = std::sqrt(m.nx * m.nx + m.ny * m.ny + m.nz * m.nz);
            const float own = std::sqrt(m.vx * m.vx + m.vy * m.vy + m.vz * m.vz);
            const float p =
                rule_roughness(plain_ ? "none" : o_.rule, m.p, m.alpha2, length, own);
            lobe.alpha2 = (p * p) * (p * p);
            return lobe;
        }
        if (o_.rule == "lean") {
            lobe.alpha2 = m.alpha2 + slope_variance(t.cells->view(), mean);
            return lobe;
        }
        // median and student-t fit under the design light and take it off again.
        const float light2 = o_.design_light * o_.design_light;
        thread_local Cells lit;
        const Cells* cells = t.cells;
        float narrowest = 1.0f;
        for (const float a2 : cells->alpha2) narrowest = std::min(narrowest, a2);
        if (light2 > 0.0f) {
            lit = *cells;
            for (float& a2 : lit.alpha2) a2 += light2;
            cells = &lit;
        }
        const float median = median_alpha2(cells->view(), mean, lobe_kernel());
        lobe.alpha2 = median;
        if (o_.rule == "student-t") {
            const RobustFit fit =
                student_t(cells->view(), mean, median, 3, 12, false, lobe_kernel());
            lobe.normal = fit.normal;
            lobe.alpha2 = fit.alpha2;
        }
        if (light2 > 0.0f) lobe.alpha2 = std::max(narrowest, lobe.alpha2 - light2);
        return lobe;
    }

private:
    const PrefilterOptions& o_;
    RuleKind kind_;
    OverlapOptions overlap_;
    bool plain_ = false;
};

void store(const FittedLobe& lobe, const MipTexel& t, const PrefilterOptions& options, Prefiltered& out)
{
    const std::size_t k = static_cast<std::size_t>(t.level);
    float* n = &out.normal[k].at(t.x, t.y, 0);
    n[0] = 0.5f + 0.5f * lobe.normal.x;
    n[1] = 0.5f + 0.5f * (options.green_down ? -lobe.normal.y : lobe.normal.y);
    n[2] = 0.5f + 0.5f * lobe.normal.z;
    float alpha2 = lobe.elliptic ? std::min(lobe.alpha2_x, lobe.alpha2_y) : lobe.alpha2;
    float p = perceptual(alpha2);
    if (options.alpha) p *= p;
    out.roughness[k].at(t.x, t.y, 0) = options.smoothness ? 1.0f - p : p;
    if (!options.anisotropic) return;
    float* a = &out.anisotropy[k].at(t.x, t.y, 0);
    Direction d = lobe.tangent;
    if (lobe.elliptic && lobe.alpha2_x < lobe.alpha2_y) {  // the wide axis is the other one
        const Direction& z = lobe.normal;
        const Direction& x = lobe.tangent;
        d = {z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x};
    }
    const float length = std::max(1e-6f, std::sqrt(d.x * d.x + d.y * d.y));
    const float wide = std::sqrt(std::max(lobe.alpha2_x, lobe.alpha2_y));
    const float slim = std::sqrt(alpha2);
    const float strength =
        lobe.elliptic && slim < 1.0f
            ? std::sqrt(std::clamp((wide - slim) / (1.0f - slim), 0.0f, 1.0f))
            : 0.0f;
    a[0] = 0.5f + 0.5f * d.x / length;
    a[1] = 0.5f + 0.5f * (options.green_down ? -d.y : d.y) / length;
    a[2] = strength;
}

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
    const auto codes = [&](const Plane& plane) {
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

Prefiltered filtered(const MapSurface& surface, const PrefilterOptions& options)
{
    if (!(options.design_light >= 0.0f && options.design_light <= 1.0f)) {
        throw Error("prefilter: the design light must be in 0..1, got " +
                        std::to_string(options.design_light),
                    "Use 0 for the sun, 0.1 for a window.");
    }
    if (options.anisotropic && options.rule != "overlap") {
        throw Error("prefilter: the rule '" + options.rule + "' has no anisotropic output",
                    "Use the rule overlap, or leave --anisotropic out.");
    }
    const Filter filter(options);
    const std::vector<LevelSize> sizes = level_sizes(surface.width, surface.height);
    Prefiltered out;
    out.normal.resize(sizes.size());
    out.roughness.resize(sizes.size());
    if (options.anisotropic) out.anisotropy.resize(sizes.size());
    for (std::size_t k = 1; k < sizes.size(); ++k) {
        const auto [width, height] = sizes[k];
        out.normal[k] = Image(width, height, 3, ColorSpace::Data);
        out.roughness[k] = Image(width, height, 1, ColorSpace::Data);
        if (options.anisotropic) out.anisotropy[k] = Image(width, height, 3, ColorSpace::Data);
    }
    walk(surface, {filter.needs_cells(), options.rule == "vmf", options.threads, options.progress},
         [&](const MipTexel& texel) { store(filter(texel), texel, options, out); });
    if (options.rule == "lux") lux_roughness(surface, options, out);
    return out;
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

}  // namespace petrichor::texproc
