#include "weather/patches/patches.h"

#include <cmath>

#include "base/error.h"

namespace petrichor::weather {

namespace {

[[noreturn]] void refuse(const std::string& what, double found, const std::string& accepted)
{
    throw Error("patches: " + what + " must be " + accepted + ", got " + std::to_string(found),
                "Give numbers in the accepted range.");
}

void check_rows(const std::vector<std::uint32_t>& begin, const std::vector<std::uint32_t>& rows,
                std::size_t patches, const char* name)
{
    const auto number = [](std::size_t n) { return static_cast<double>(n); };
    if (begin.size() != patches + 1)
        refuse(std::string("rows of ") + name, number(begin.size()), "one more than patches");
    for (std::size_t i = 0; i < patches; ++i)
        if (begin[i] > begin[i + 1])
            refuse(std::string("row ") + std::to_string(i) + " of " + name, number(begin[i]),
                   "before the next");
    if (begin.back() != rows.size())
        refuse(std::string("the end of ") + name, number(begin.back()), "their number");
    for (const std::uint32_t to : rows)
        if (to >= patches) refuse(name, number(to), "numbers of patches");
}

}  // namespace

void check_patches(const PatchSet& set)
{
    if (set.patches.empty()) refuse("their number", 0.0, "1 or more");
    if (set.patches.size() >= kToPond) refuse("their number", 2147483648.0, "below 2^31");
    if (set.kinds.empty()) refuse("kinds", 0.0, "1 or more");
    for (const PatchKind& kind : set.kinds) {
        check_surface(kind.surface);
        if (!(kind.splash >= 0.0 && kind.splash <= 1.0))
            refuse(kind.surface.name + " splash", kind.splash, "in 0..1");
        if (!(kind.slides_above_deg >= 0.0 && kind.slides_above_deg <= 90.0))
            refuse(kind.surface.name + " slides_above_deg", kind.slides_above_deg, "in 0..90");
    }
    for (std::size_t i = 0; i < set.patches.size(); ++i) {
        const WeatherPatch& p = set.patches[i];
        const auto require = [&](bool good, const char* name, double found, const char* accepted) {
            if (!good) refuse("patch " + std::to_string(i) + " " + name, found, accepted);
        };
        const double length2 = dot(p.normal, p.normal);
        require(std::abs(length2 - 1.0) < 1e-3, "normal (squared)", length2, "of unit length");
        require(p.area_m2 > 0.0 && std::isfinite(p.area_m2), "area_m2", p.area_m2, "above 0");
        require(std::isfinite(p.height_m), "height_m", p.height_m, "finite");
        require(p.kind < set.kinds.size(), "kind", p.kind, "one of kinds");
        require(p.sky_share <= 1.0, "sky_share", p.sky_share, "at most 1");
        require(p.patch_share >= 0.0 && p.patch_share <= 1.0, "patch_share", p.patch_share,
                "in 0..1");
        require(p.wall_factor >= 0.0 && p.wall_factor <= 10.0, "wall_factor", p.wall_factor,
                "in 0..10");
        require(p.gutter_share >= 0.0 && p.gutter_share <= 1.0, "gutter_share", p.gutter_share,
                "in 0..1");
        require(std::isfinite(p.foot_height_m), "foot_height_m", p.foot_height_m, "finite");
        require(p.foot == kNoPatch || (p.foot < set.patches.size() && p.foot != i), "foot", p.foot,
                "another patch");
        const bool to_patch = p.runs_to < set.patches.size() && p.runs_to != i;
        const bool to_pond = p.runs_to != kRunsOut && (p.runs_to & kToPond) != 0 &&
                             (p.runs_to & ~kToPond) < set.ponds;
        require(p.runs_to == kRunsOut || to_patch || to_pond, "runs_to", p.runs_to,
                "another patch, a pond or kRunsOut");
    }
    check_rows(set.link_begin, set.links, set.patches.size(), "links");
    if (!set.beside_begin.empty()) {
        check_rows(set.beside_begin, set.beside, set.patches.size(), "neighbours");
        if (set.beside_m.size() != set.beside.size())
            refuse("distances of neighbours", static_cast<double>(set.beside_m.size()),
                   "as many as neighbours");
        for (const float d : set.beside_m)
            if (!(d > 0.0f)) refuse("distance of neighbours", static_cast<double>(d), "above 0");
    }
    if (!set.upwind.empty() && set.upwind.size() != set.patches.size())
        refuse("what stands upwind", static_cast<double>(set.upwind.size()), "one a patch, or none");
    for (const auto& around : set.upwind) {
        for (const Upwind& one : around) {
            if (!(one.distance_m >= 0.0f))
                refuse("upwind distance_m", static_cast<double>(one.distance_m), "0 or more");
            if (!(one.height_m >= 0.0f && std::isfinite(one.height_m)))
                refuse("upwind height_m", static_cast<double>(one.height_m), "0 or more");
        }
    }
    for (const double soaks : set.pond_soaks_mm_h)
        if (!(soaks >= 0.0)) refuse("pond_soaks_mm_h", soaks, "0 or more");
}

}  // namespace petrichor::weather
