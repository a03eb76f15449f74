#include "film/weather/tap_sites.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "scene/patches/lookup.h"

namespace petrichor::film {
namespace {

constexpr float kGroundUp = 0.5f;      // patches of the ground are steeper than this
constexpr float kGroundNear_m = 0.3f;  // and lie so near to its height field

// The neighbours of a cell that drain to the same place.
template <class Body>
void over_neighbours(const SceneGround& ground, std::size_t cell, const Body& body)
{
    const scene::HeightField& field = ground.field;
    const auto x0 = static_cast<std::ptrdiff_t>(cell % field.width);
    const auto z0 = static_cast<std::ptrdiff_t>(cell / field.width);
    for (std::ptrdiff_t z = z0 - 1; z <= z0 + 1; ++z) {
        for (std::ptrdiff_t x = x0 - 1; x <= x0 + 1; ++x) {
            if (x < 0 || z < 0 || x >= static_cast<std::ptrdiff_t>(field.width) ||
                z >= static_cast<std::ptrdiff_t>(field.depth))
                continue;
            const std::size_t other =
                field.cell_of(static_cast<std::size_t>(x), static_cast<std::size_t>(z));
            if (other == cell || ground.basins.label[other] != ground.basins.label[cell] ||
                !std::isfinite(field.height_m[other]))
                continue;
            body(other, (x != x0 && z != z0) ? std::sqrt(2.0f) : 1.0f);
        }
    }
}

// The next cell straight down, or the cell itself.
std::size_t steepest_from(const SceneGround& ground, std::size_t cell)
{
    std::size_t next = cell;
    float steepest = 0.0f;
    over_neighbours(ground, cell, [&](std::size_t other, float steps) {
        const float fall = (ground.field.height_m[cell] - ground.field.height_m[other]) / steps;
        if (fall > steepest) {
            steepest = fall;
            next = other;
        }
    });
    return next;
}

// Over level ground to the nearest cell from which it goes down; empty where there is none.
std::vector<std::size_t> across_the_flat(const SceneGround& ground, std::size_t start)
{
    std::vector<std::size_t> from(ground.field.cells(), ground.field.cells());
    from[start] = start;
    std::vector<std::size_t> queue{start};
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const std::size_t cell = queue[i];
        if (steepest_from(ground, cell) != cell) {
            std::vector<std::size_t> way;
            for (std::size_t at = cell; at != start; at = from[at]) way.push_back(at);
            std::reverse(way.begin(), way.end());
            return way;
        }
        over_neighbours(ground, cell, [&](std::size_t other, float) {
            if (ground.field.height_m[other] != ground.field.height_m[cell] ||
                from[other] < ground.field.cells())
                return;
            from[other] = cell;
            queue.push_back(other);
        });
    }
    return {};
}

}  // namespace

std::vector<std::size_t> way_of_water(const SceneGround& ground, std::size_t start)
{
    std::vector<std::size_t> way{start};
    for (;;) {
        const std::size_t next = steepest_from(ground, way.back());
        if (next != way.back()) {
            way.push_back(next);
            continue;
        }
        const std::vector<std::size_t> flat = across_the_flat(ground, way.back());
        if (flat.empty()) return way;
        way.insert(way.end(), flat.begin(), flat.end());
    }
}

std::vector<TapSite> tap_sites(const std::vector<ScenarioTap>& taps, const SceneGround& ground,
                               const scene::Patches& patches)
{
    const scene::HeightField& field = ground.field;
    std::vector<TapSite> sites;
    for (const ScenarioTap& one : taps) {
        const std::size_t cell = scene::cell_at(field, one.x_z_m.x, one.x_z_m.y);
        if (cell >= field.cells() || !std::isfinite(field.height_m[cell])) {
            const bool solid = cell < field.cells() && field.height_m[cell] == scene::kSolid_m;
            throw Error("[ground] tap: the one at x " + std::to_string(one.x_z_m.x) + ", z " +
                            std::to_string(one.x_z_m.y) +
                            (solid ? " stands in something solid" : " lies outside of the ground"),
                        "Put it on the ground that petrichor scene --map basins shows.");
        }
        TapSite site;
        site.from_s = one.from_s;
        site.to_s = one.to_s;
        site.tap.flow_kg_s = one.litres_per_min / 60.0;
        const std::uint32_t label = ground.basins.label[cell];
        if (label != scene::kOutside && label != scene::kNoLabel)
            site.tap.runs_to = weather::kToPond | (label - 1);
        for (const std::size_t at : way_of_water(ground, cell)) {
            const auto x = static_cast<double>(at % field.width) + 0.5;
            const auto z = static_cast<double>(at / field.width) + 0.5;
            const glm::vec3 point(static_cast<float>(field.corner_m.x + x * field.cell_m),
                                  field.height_m[at],
                                  static_cast<float>(field.corner_m.y + z * field.cell_m));
            const auto patch = scene::patch_at(patches, point, {0.0f, 1.0f, 0.0f});
            if (!patch || patches.normal[*patch].y <= kGroundUp ||
                std::abs(patches.position_m[*patch].y - point.y) > kGroundNear_m)
                continue;
            if (std::find(site.tap.way.begin(), site.tap.way.end(), *patch) == site.tap.way.end())
                site.tap.way.push_back(*patch);
        }
        sites.push_back(std::move(site));
    }
    return sites;
}

std::vector<weather::PatchTap> taps_of_run(
    const std::vector<TapSite>& sites, const std::function<std::int64_t(double time_s)>& utc_us)
{
    std::vector<weather::PatchTap> taps;
    for (const TapSite& site : sites) {
        taps.push_back(site.tap);
        if (site.from_s) taps.back().from_us = utc_us(*site.from_s);
        if (site.to_s) taps.back().to_us = utc_us(*site.to_s);
    }
    return taps;
}

}  // namespace petrichor::film
