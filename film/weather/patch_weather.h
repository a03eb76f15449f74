#ifndef PETRICHOR_FILM_WEATHER_PATCH_WEATHER_H
#define PETRICHOR_FILM_WEATHER_PATCH_WEATHER_H

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "film/scenario/scenario.h"
#include "film/weather/patch_sites.h"
#include "film/weather/shelter_parts.h"
#include "film/weather/tap_sites.h"
#include "film/weather/water_relief.h"
#include "gpu/frame/frame.h"
#include "scene/scene.h"

namespace petrichor::film {

/// The ground of a scene as the keys of [ground] say: materials by glob, drains.
///   notes  gets what the height field noticed, and globs and drains that meet nothing
SceneGround scene_ground(const scene::Scene& scene, const ScenarioGround& keys,
                         std::vector<std::string>& notes);

/// A scene's patches, ready for any weather file.
struct SceneSites {
    weather::PatchSet set;
    SceneGround ground;
    std::shared_ptr<const gpu::PlaceShape> shape;
    std::vector<WaterRelief> relief;           ///< by material
    std::vector<std::uint32_t> material;       ///< of a weather patch
    ShelterParts shelter;                      ///< patches that are cut finer
    std::vector<TapSite> taps;                 ///< of the keys
    std::vector<std::string> notes;
};
/// Throws Error for taps as tap_sites.
SceneSites scene_sites(const scene::Scene& scene, const scene::Patches& patches,
                       const scene::Tracer& tracer, std::span<const scene::PatchSurface> surfaces,
                       const ScenarioGround& keys, const weather::Surface& otherwise);

/// What all patches hold together at a moment.
struct PlaceSums {
    double area_m2 = 0.0;
    double film_kg = 0.0, standing_kg = 0.0, ice_kg = 0.0, snow_kg = 0.0, ponds_m3 = 0.0;
    double pond_ice_kg = 0.0;  ///< of ponds_m3, which counts ice as the water that it is
    weather::PatchLedger books;
};

/// A weather file on the patches of a scene, as a renderer wants it. Copies share their run; not
/// for two threads at once.
class PlaceWeatherOfFile {
public:
    /// Runs up to `from_us`. Throws Error as weather::PatchWeather.
    PlaceWeatherOfFile(const SceneSites& sites, const weather::ForcingTable& table,
                       const weather::PatchParams& params, std::int64_t from_us);

    /// The weather of every patch at a moment; the same bits whatever was asked before.
    std::shared_ptr<const gpu::PlaceWeather> at(std::int64_t utc_us);
    /// Of the moment that was asked last.
    PlaceSums sums() const;
    std::int64_t begin_us() const;

private:
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

}  // namespace petrichor::film

#endif
