#ifndef PETRICHOR_CLI_SCENE_SCENE_MAP_H
#define PETRICHOR_CLI_SCENE_SCENE_MAP_H

#include <functional>
#include <string>
#include <vector>

#include "cli/report/drawing.h"
#include "cli/scene/scene_view.h"
#include "scene/scene.h"

namespace petrichor::cli {

/// What a map asks for besides the scene.
struct MapConditions {
    double wind_from_degrees = 270.0;  ///< clockwise from -z
    double wind_m_s = 0.0;
    double drop_m_s = 6.0;  ///< speed of falling drops
    double latitude_degrees = 50.0;
    double day_of_year = 172.0;
    double north_degrees = 0.0;  ///< clockwise from -z
};

/// One kind of map: a number a patch, its scale and its words. A row in scene_maps() is all that a
/// new one needs.
struct SceneMap {
    std::string name;
    std::string help;  ///< one line
    std::string unit;
    std::vector<std::string> colors;  ///< "#rrggbb" from low to high
    /// A leaf each; NaN: none there.
    std::function<std::vector<float>(const SceneView&, const MapConditions&)> values;
    /// Ends of the scale, from the values.
    std::function<std::pair<float, float>(const std::vector<float>&)> range;
    /// What is said below the picture besides the scale.
    std::function<std::string(const SceneView&, const MapConditions&)> caption;
    bool smooth = true;  ///< between patches, as light is; false: patch by patch
    bool lamps = false;  ///< their shapes are drawn over it
};
const std::vector<SceneMap>& scene_maps();

struct MapPicture {
    int width = 960;
    int height = 540;
    int threads = 0;
};

/// The scene from a camera, each surface in the colour of its patch, a legend below. Rays of our
/// own; no GPU. The same bytes for any number of threads.
Pixels draw_scene_map(const SceneView& view, const SceneMap& map, const MapConditions& conditions,
                      const scene::Camera& camera, const MapPicture& picture);

}  // namespace petrichor::cli

#endif
