#ifndef PETRICHOR_CLI_SCENE_GROUND_MAP_H
#define PETRICHOR_CLI_SCENE_GROUND_MAP_H

#include <optional>
#include <string>
#include <vector>

#include "cli/report/drawing.h"
#include "film/weather/patch_sites.h"
#include "scene/scene.h"

namespace petrichor::cli {

inline constexpr const char* kBasinsMap = "basins";

/// The ground of a scene without keys, and what was guessed.
struct GroundView {
    film::SceneGround ground;
    std::vector<std::string> notes;
};
GroundView find_scene_ground(const scene::Scene& scene);

/// What its hollows hold.
struct HollowSums {
    std::uint32_t pits = 0;
    double capacity_m3 = 0.0, deepest_m = 0.0, wet_m2 = 0.0;  ///< all full
};
HollowSums hollow_sums(const film::SceneGround& ground);

/// The ground from above with its water, a pixel a cell.
///   rain_mm  that has fallen on it, dry and sealed, and run where it runs; nothing: without end
///   throws   Error when the scene has no ground
Pixels draw_basins(const GroundView& view, std::optional<double> rain_mm);

}  // namespace petrichor::cli

#endif
