#include "cli/scene/ground_map.h"

#include <algorithm>

#include "film/weather/patch_weather.h"
#include "formulas/color/srgb.h"
#include "scene/basins/basin_map.h"
#include "scene/basins/water.h"

namespace petrichor::cli {

GroundView find_scene_ground(const scene::Scene& scene)
{
    GroundView view;
    view.ground = film::scene_ground(scene, {}, view.notes);
    return view;
}

HollowSums hollow_sums(const film::SceneGround& ground)
{
    HollowSums sums;
    sums.pits = ground.basins.pits;
    for (std::uint32_t i = 1; i < ground.basins.hollow.size(); ++i) {
        const scene::Hollow& h = ground.basins.hollow[i];
        if (h.parent != 0) continue;
        sums.capacity_m3 += h.capacity_m3;
        sums.deepest_m =
            std::max(sums.deepest_m, static_cast<double>(h.spill_m) - static_cast<double>(h.pit_m));
        sums.wet_m2 += scene::wet_area_m2(ground.basins, i, static_cast<double>(h.spill_m));
    }
    return sums;
}

Pixels draw_basins(const GroundView& view, std::optional<double> rain_mm)
{
    const scene::Basins& basins = view.ground.basins;
    std::vector<float> levels;
    if (rain_mm) {
        scene::BasinWater water(basins);
        std::vector<double> into;
        for (const double cells : basins.pit_cells)
            into.push_back(cells * basins.cell_area_m2 * *rain_mm * 1e-3);
        scene::pour(basins, water, into);
        levels = scene::levels_m(basins, water);
    }
    const Image map = scene::basin_map(view.ground.field, basins, levels);
    Pixels pixels{map.width, map.height, {}};
    pixels.rgb.reserve(map.pixels.size());
    for (const float linear : map.pixels) {
        const float code = shared::srgb_from_linear(std::clamp(linear, 0.0f, 1.0f));
        pixels.rgb.push_back(static_cast<std::uint8_t>(code * 255.0f + 0.5f));
    }
    return pixels;
}

}  // namespace petrichor::cli
