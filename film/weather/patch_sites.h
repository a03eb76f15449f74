#ifndef PETRICHOR_FILM_WEATHER_PATCH_SITES_H
#define PETRICHOR_FILM_WEATHER_PATCH_SITES_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "film/weather/surface_by_name.h"
#include "film/weather/water_relief.h"
#include "scene/basins/hierarchy.h"
#include "scene/patches/patches.h"
#include "scene/patches/surfaces.h"
#include "weather/patches/patch_weather.h"

namespace petrichor::film {

/// What the ground of a scene does with water.
struct SceneGround {
    scene::HeightField field;
    scene::Basins basins;
    std::vector<std::size_t> drains;  ///< cells
};

/// A scene's patches as weather sees them: kinds by material (albedo of the patches themselves),
/// visibility, links, the way that water runs: down a roof from patch to patch, over an edge to
/// what lies below (nine tenths of it into a gutter where that is more than 2 m), from the ground
/// into the hollow that it drains to. Deterministic.
///
///   surfaces    as scene::patch_surfaces; one a patch
///   otherwise   of materials whose name says nothing
///   reliefs     of these patches
weather::PatchSet patch_sites(const scene::Patches& patches, const scene::Tracer& tracer,
                              std::span<const scene::PatchSurface> surfaces,
                              const SceneGround& ground, const weather::Surface& otherwise,
                              const WaterReliefs& reliefs);

/// The hollows of a ground as ponds of a patch set: pond i is pit i + 1.
weather::Ponds ponds_of(const SceneGround& ground);

}  // namespace petrichor::film

#endif
