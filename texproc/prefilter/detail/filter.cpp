#include "texproc/prefilter/detail/filter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.h"

namespace petrichor::texproc::detail {

namespace {

StoredAs stored_as(const PrefilterOptions& o)
{
    return {o.bits, o.smoothness, o.alpha, o.green_down, o.rebuild_z};
}

std::uint32_t seed_of(int level, int x, int y)
{
    std::uint32_t h = 2166136261u;
    for (const int v : {level, x, y}) h = (h ^ static_cast<std::uint32_t>(v)) * 16777619u;
    return h ^ (h >> 15);
}

Direction mean_normal(const Means& m)
{
    return normalized({m.nx, m.ny, m.nz});
}

}  // namespace

Filter::Filter(const PrefilterOptions& options, const MapSurface& surface)
    : options_(options),
      kind_(rule_named(options.rule).kind),
      overlap_{options.design_light, options.joint, options.anisotropic, options.quick,
               stored_as(options)}
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
    if (kind_ != RuleKind::Picture) return;
    if (options.design_light > 0.0f) {
        throw Error("prefilter: the rule picture has no design light: it looks at suns and windows",
                    "Leave the design light out, or use the rule overlap.");
    }
    picture_ = std::make_shared<const PictureLobe>(
        surface, options.quick, !options.quick && options.surface == SurfaceClass::Metal);
}

FittedLobe Filter::operator()(const MipTexel& t) const
{
    if (kind_ == RuleKind::Moments) return from_moments(t.means);
    if (kind_ == RuleKind::Cells) return from_cells(t);
    if (kind_ == RuleKind::Picture) return (*picture_)(*t.cells, t.means);
    return fit_overlap(*t.cells, t.means, t.level, seed_of(t.level, t.x, t.y), overlap_);
}

FittedLobe Filter::from_moments(const Means& m) const
{
    const float length = std::sqrt(m.nx * m.nx + m.ny * m.ny + m.nz * m.nz);
    const float own = std::sqrt(m.vx * m.vx + m.vy * m.vy + m.vz * m.vz);
    // The compatible Lux rule starts from the plain mips; its codes replace them afterwards.
    const std::string rule = options_.rule == "lux" ? "none" : options_.rule;
    const float p = rule_roughness(rule, m.p, m.alpha2, length, own);
    return {.normal = mean_normal(m), .alpha2 = (p * p) * (p * p)};
}

FittedLobe Filter::from_cells(const MipTexel& t) const
{
    FittedLobe lobe{.normal = mean_normal(t.means)};
    const Direction mean = lobe.normal;
    if (options_.rule == "lean") {
        lobe.alpha2 = t.means.alpha2 + slope_variance(t.cells->view(), mean);
        return lobe;
    }
    // median and student-t fit under the design light and take it off again.
    const float light2 = options_.design_light * options_.design_light;
    thread_local Cells lit;
    const Cells* cells = t.cells;
    float narrowest = 1.0f;
    if (light2 > 0.0f) {
        lit = *cells;
        for (const float a2 : lit.alpha2) narrowest = std::min(narrowest, a2);
        for (float& a2 : lit.alpha2) a2 += light2;
        cells = &lit;
    }
    lobe.alpha2 = median_alpha2(cells->view(), mean, lobe_kernel());
    if (options_.rule == "student-t") {
        const RobustFit fit =
            student_t(cells->view(), mean, lobe.alpha2, 3, 12, false, lobe_kernel());
        lobe.normal = fit.normal;
        lobe.alpha2 = fit.alpha2;
    }
    if (light2 > 0.0f) lobe.alpha2 = std::max(narrowest, lobe.alpha2 - light2);
    return lobe;
}

Prefiltered empty_chain(const std::vector<LevelSize>& sizes, const PrefilterOptions& options)
{
    Prefiltered out;
    out.normal.resize(sizes.size());
    out.roughness.resize(sizes.size());
    if (options.anisotropic) out.anisotropy.resize(sizes.size());
    if (options.rule == "picture") out.base_share.resize(sizes.size());
    for (std::size_t k = 1; k < sizes.size(); ++k) {
        const auto [width, height] = sizes[k];
        out.normal[k] = Image(width, height, 3, ColorSpace::Data);
        out.roughness[k] = Image(width, height, 1, ColorSpace::Data);
        if (options.anisotropic) out.anisotropy[k] = Image(width, height, 3, ColorSpace::Data);
        if (options.rule == "picture")
            out.base_share[k] = Image(width, height, 1, ColorSpace::Data);
    }
    return out;
}

void store(const FittedLobe& lobe, const MipTexel& t, const PrefilterOptions& options,
           Prefiltered& out)
{
    const std::size_t k = static_cast<std::size_t>(t.level);
    const float alpha2 = lobe.elliptic ? std::min(lobe.alpha2_x, lobe.alpha2_y) : lobe.alpha2;
    StoredAs exact = stored_as(options);
    exact.bits = 0;
    const Codes codes = lobe.codes ? *lobe.codes : rounded(lobe.normal, alpha2, exact);
    std::copy(codes.normal.begin(), codes.normal.end(), &out.normal[k].at(t.x, t.y, 0));
    out.roughness[k].at(t.x, t.y, 0) = codes.rough;
    if (!out.base_share.empty()) {
        const Means& m = t.means;
        out.base_share[k].at(t.x, t.y, 0) =
            std::min(std::sqrt(m.nx * m.nx + m.ny * m.ny + m.nz * m.nz), 1.0f);
    }
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
    const float strength = lobe.elliptic && slim < 1.0f
                               ? std::sqrt(std::clamp((wide - slim) / (1.0f - slim), 0.0f, 1.0f))
                               : 0.0f;
    a[0] = 0.5f + 0.5f * d.x / length;
    a[1] = 0.5f + 0.5f * (options.green_down ? -d.y : d.y) / length;
    a[2] = strength;
}

}  // namespace petrichor::texproc::detail
