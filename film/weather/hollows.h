#ifndef PETRICHOR_FILM_WEATHER_HOLLOWS_H
#define PETRICHOR_FILM_WEATHER_HOLLOWS_H

#include <memory>

#include "film/scenario/scenario.h"
#include "gpu/frame/frame.h"
#include "scene/basins/water.h"

namespace petrichor::film {

/// Ponds in the hollows of a scene's ground, for weather without patches: the same rain on all of the
/// ground runs to where it is lowest (Fill-Spill-Merge).
class Hollows {
public:
    /// keys: what is ground, and its drains
    Hollows(const scene::Scene& scene, const ScenarioGround& keys);

    bool any() const { return basins_.pits > 0; }
    std::uint32_t count() const { return basins_.pits; }
    /// The ponds at a level of the puddles, 0..1; null where they are dry.
    std::shared_ptr<const gpu::PlaceWeather> at(float flood_puddles) const;

private:
    scene::Basins basins_;
    std::shared_ptr<const gpu::PlaceShape> shape_;
};

/// Whether the materials of a scene say nothing of where water stands: no height map, no puddle mask.
bool leaves_water_to_geometry(const scene::Scene& scene);

}  // namespace petrichor::film

#endif
