#ifndef PETRICHOR_FILM_WEATHER_WATER_RELIEF_H
#define PETRICHOR_FILM_WEATHER_WATER_RELIEF_H

#include <string>
#include <vector>

#include "scene/patches/patches.h"
#include "scene/patches/tracer.h"
#include "weather/physics/stores.h"

namespace petrichor::film {

/// The relief below the patches of a material, as water stands in it: heights as pixels read them, of a
/// height map or the relief that ground has without one. Of all its level ground together, so that
/// neighbouring patches have neighbouring levels.
struct WaterRelief {
    weather::Hypsometry curve;  ///< depth 0: it is flat
    float lowest = 0.0f;    ///< height of its lowest point, in heights of the map
    double unit_mm = 0.0;   ///< of height 1 over height 0; 0: water never stands on the material
};

/// Whether water stands on a patch of a material; from steeper ones it runs off. By a height map up to
/// 44 degrees, without one up to 4: the middle of what pixels draw (gpu/passes/surface/water.glsl).
bool holds_water(const scene::Material& material, const glm::vec3& normal);

struct WaterReliefs {
    std::vector<WaterRelief> of_material;
    /// Of a patch: puddle masks of its material tell hollows from other ground, and this lies in one.
    std::vector<bool> hollow;
};
/// notes: maps that cannot be read, taken as none.
WaterReliefs water_reliefs(const scene::Patches& patches, const scene::Triangles& triangles,
                           std::vector<std::string>& notes);

/// What the relief holds before water runs off: up to where a third of the ground lies below it, in a
/// hollow up to its highest point. The same curve, so that as much of the patch is wet as is drawn.
weather::Hypsometry store_of_relief(const WaterRelief& relief, bool hollow);

/// Level of water whose mean depth is this, in heights of the map, so that the mean over the ground of
/// max(0, level - height) is that depth; below all heights where there is none.
float relief_level(const WaterRelief& relief, double mean_mm);
/// Share of the ground that lies below a level.
float drowned_share(const WaterRelief& relief, float level);

}  // namespace petrichor::film

#endif
