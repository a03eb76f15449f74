#ifndef PETRICHOR_CLI_SIMULATE_RELIEF_H
#define PETRICHOR_CLI_SIMULATE_RELIEF_H

#include <filesystem>
#include <string>

#include "weather/physics/stores.h"

namespace petrichor::cli {

/// Where water can stand on a material, from its height map.
struct Relief {
    weather::Hypsometry cracks;   ///< hollows narrower than 1/50 of the map's width
    weather::Hypsometry puddles;  ///< what is left of those narrower than 1/10
    std::string note;             ///< depths, capacities and areas, for people
};

/// Measures a tileable height map (first channel; white is high).
///
///   range_m  from black to white in metres; for maps in floats: from 0 to 1
///   throws   Error for an image that cannot be read, and for a range that is not positive
Relief read_relief(const std::filesystem::path& height_map, double range_m);

}  // namespace petrichor::cli

#endif
