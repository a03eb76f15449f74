#include "film/weather/tap_sites.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "base/error.h"
#include "scene/patches/lookup.h"
#include "weather/physics/constants.h"

namespace petrichor::film {
namespace {

constexpr float kGroundUp = 0.5f;      // patches of the ground are steeper than this
constexpr float kGroundNear_m = 0.3f;  // and lie so near to its height field
constexpr double kBrim_m = 0.005;      // so far below its brim a hollow is full: an hour's loss

// Water on a field of heights.
struct Slopes {
    const SceneGround& ground;
    std::span<const float> height_m;
    bool stays;  // in its hollow

    template <class Body>
    void over_neighbours(std::size_t cell, const Body& body) const
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
                const std::vector<std::uint32_t>& label = ground.basins.label;
                if (other == cell || !std::isfinite(height_m[other]) ||
                    (stays && label[other] != label[cell]))
                    continue;
                body(other, (x != x0 && z != z0) ? std::sqrt(2.0f) : 1.0f);
            }
        }
    }
    // The next cell straight down, or the cell itself.
    std::size_t steepest_from(std::size_t cell) const
    {
        std::size_t next = cell;
        float steepest = 0.0f;
        over_neighbours(cell, [&](std::size_t other, float steps) {
            const float fall = (height_m[cell] - height_m[other]) / steps;
            if (fall > steepest) {
                steepest = fall;
                next = other;
            }
        });
        return next;
    }
    // Over level ground to the nearest cell from which it goes down; empty where there is none.
    std::vector<std::size_t> across_the_flat(std::size_t start) const
    {
        std::unordered_map<std::size_t, std::size_t> from{{start, start}};
        std::vector<std::size_t> queue{start};
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const std::size_t cell = queue[i];
            if (steepest_from(cell) != cell) {
                std::vector<std::size_t> way;
                for (std::size_t at = cell; at != start; at = from[at]) way.push_back(at);
                std::reverse(way.begin(), way.end());
                return way;
            }
            over_neighbours(cell, [&](std::size_t other, float) {
                if (height_m[other] == height_m[cell] && from.emplace(other, cell).second)
                    queue.push_back(other);
            });
        }
        return {};
    }
};

// Patches of the ground below cells, each once.
std::vector<std::uint32_t> patches_below(const std::vector<std::size_t>& cells,
                                         const scene::HeightField& field,
                                         const scene::Patches& patches)
{
    std::vector<std::uint32_t> found;
    for (const std::size_t at : cells) {
        const auto x = static_cast<double>(at % field.width) + 0.5;
        const auto z = static_cast<double>(at / field.width) + 0.5;
        const glm::vec3 point(static_cast<float>(field.corner_m.x + x * field.cell_m),
                              field.height_m[at],
                              static_cast<float>(field.corner_m.y + z * field.cell_m));
        const auto patch = scene::patch_at(patches, point, {0.0f, 1.0f, 0.0f});
        if (!patch || patches.normal[*patch].y <= kGroundUp ||
            std::abs(patches.position_m[*patch].y - point.y) > kGroundNear_m)
            continue;
        if (std::find(found.begin(), found.end(), *patch) == found.end()) found.push_back(*patch);
    }
    return found;
}

// From a cell to the hollow below, over its brim to the next, and so on out of the scene.
std::vector<weather::TapStretch> stretches_from(const SceneGround& ground,
                                                std::span<const float> filled_m, std::size_t start,
                                                const scene::Patches& patches)
{
    const std::vector<std::uint32_t>& label = ground.basins.label;
    const std::vector<std::size_t> through = way_of_water(ground, filled_m, start, false);
    std::vector<weather::TapStretch> stretches;
    for (std::size_t i = 0; i < through.size(); ++i) {
        const std::size_t cell = through[i];
        if (i > 0 && label[cell] == label[through[i - 1]]) continue;
        // What the hollow before has to be filled to.
        if (i > 0) {
            const auto brim_m =
                static_cast<double>(std::max(filled_m[through[i - 1]], filled_m[cell]));
            const auto pit_m =
                static_cast<double>(ground.basins.hollow[label[through[i - 1]]].pit_m);
            stretches.back().spill_m = brim_m - std::min(kBrim_m, 0.5 * (brim_m - pit_m));
        }
        weather::TapStretch stretch;
        stretch.way = patches_below(way_of_water(ground, ground.field.height_m, cell, true),
                                    ground.field, patches);
        const bool out = label[cell] == scene::kOutside || label[cell] == scene::kNoLabel;
        if (!out) stretch.runs_to = weather::kToPond | (label[cell] - 1);
        stretches.push_back(std::move(stretch));
        if (out) break;
    }
    return stretches;
}

}  // namespace

std::vector<std::size_t> way_of_water(const SceneGround& ground, std::span<const float> height_m,
                                      std::size_t start, bool stays)
{
    const Slopes slopes{ground, height_m, stays};
    std::vector<std::size_t> way{start};
    for (;;) {
        const std::size_t next = slopes.steepest_from(way.back());
        if (next != way.back()) {
            way.push_back(next);
            continue;
        }
        const std::vector<std::size_t> flat = slopes.across_the_flat(way.back());
        if (flat.empty()) return way;
        way.insert(way.end(), flat.begin(), flat.end());
    }
}

std::vector<TapSite> tap_sites(const std::vector<ScenarioTap>& taps, const SceneGround& ground,
                               const scene::Patches& patches)
{
    std::vector<TapSite> sites;
    if (taps.empty()) return sites;
    const scene::HeightField& field = ground.field;
    const std::vector<float> filled_m = scene::filled_heights(field, ground.drains);
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
        site.tap.temp_k = weather::kZeroCelsiusK + one.temperature_c;
        site.tap.stretches = stretches_from(ground, filled_m, cell, patches);
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
