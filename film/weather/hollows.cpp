#include "film/weather/hollows.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "film/weather/patch_weather.h"

namespace petrichor::film {
namespace {

// What runs to the hollows where all puddles are full: half of a rain of 40 mm.
constexpr double kRunOff_m = 0.02;

}  // namespace

bool leaves_water_to_geometry(const scene::Scene& scene)
{
    return std::none_of(scene.materials.begin(), scene.materials.end(),
                        [](const scene::Material& m) {
                            return m.weather.height.present() || m.weather.puddle_mask.present();
                        });
}

Hollows::Hollows(const scene::Scene& scene, const ScenarioGround& keys)
{
    std::vector<std::string> notes;
    const SceneGround ground = scene_ground(scene, keys, notes);
    const scene::HeightField& field = ground.field;
    auto shape = std::make_shared<gpu::PlaceShape>();
    shape->table.resize(1);
    if (!field.empty()) {
        basins_ = ground.basins;
        shape->basin_corner_m = glm::vec2(field.corner_m);
        shape->basin_cell_m = static_cast<float>(field.cell_m);
        shape->basin_width = static_cast<std::uint32_t>(field.width);
        shape->basin_depth = static_cast<std::uint32_t>(field.depth);
        shape->labels = basins_.label;
    }
    shape_ = std::move(shape);
}

std::shared_ptr<const gpu::PlaceWeather> Hollows::at(float flood_puddles) const
{
    if (!any() || !(flood_puddles > 0.0f)) return nullptr;
    std::vector<double> into(basins_.pits + std::size_t{1}, 0.0);
    for (std::size_t pit = 1; pit < into.size(); ++pit) {
        into[pit] = basins_.pit_cells[pit] * basins_.cell_area_m2 * kRunOff_m *
                    static_cast<double>(flood_puddles);
    }
    scene::BasinWater water(basins_);
    scene::pour(basins_, water, into);
    auto place = std::make_shared<gpu::PlaceWeather>();
    place->shape = shape_;
    place->levels_m = scene::drawn_levels_m(basins_, water);
    return place;
}

}  // namespace petrichor::film
