#ifndef PETRICHOR_FILM_SCENES_LIGHT_BAKE_H
#define PETRICHOR_FILM_SCENES_LIGHT_BAKE_H

#include <filesystem>
#include <string>
#include <vector>

#include "film/scenes/transport.h"
#include "scene/patches/light_map.h"
#include "scene/scene.h"

namespace petrichor::film {

/// The light and the weather that light maps hold.
struct BakeConditions {
    double sky_lux = 10000.0;  ///< of an overcast sky on open ground
    double sun_lux = 0.0;      ///< on a plane that faces it
    double sun_elevation_degrees = 45.0;
    double sun_azimuth_degrees = 180.0;  ///< clockwise from north
    double north_degrees = 0.0;          ///< where north is: clockwise from -z
    double snow = 0.0;                   ///< 0..1, as WeatherMoment::snow_amount
    bool indirect = false;  ///< without what sun and lamps send straight: that stays real-time
    bool shadow_mask = false;  ///< beside the light, how much of sun and lamps is seen
    std::string mask_lamps = {};  ///< glob of lamps that get channels of the mask; empty: all, as far as there are
};

/// Bakes the light maps of a scene: lamps of the scene, the sun and an overcast sky, surfaces that
/// glow, and what all surfaces send on, in their colours under that snow. Beyond the scene lies ground
/// that sends a fifth of its light back.
///
///   source   sky: Moon and Spencer 1942 (CIE overcast), 3 times as bright at the zenith as at the
///            horizon; ground: an albedo of 0.2 (Oke 1987).
scene::LightMaps bake_light(const scene::Scene& scene, const BakeConditions& conditions,
                            const TransportOptions& transport, const scene::BakeOptions& options,
                            std::vector<std::string>& notes);

/// Writes a float EXR for each map, lux: the light on the left and on the right, if it has one, its shadow
/// mask, 0..1; and light_maps.toml: the keys of a scenario that lays them on and tells lamps their channels.
/// Returns the files' names, in the order of the maps, the keys last. Makes the folder.
std::vector<std::string> write_light_maps(const std::filesystem::path& folder,
                                          const scene::Scene& scene, const scene::LightMaps& maps);

}  // namespace petrichor::film

#endif
