#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_IDENTITY_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_IDENTITY_H

#include <cstdint>
#include <span>

#include "weather/models/physical/physical_grid.h"

namespace petrichor::weather {

/// What saved states depend on, as hashes: they may only go on under the same weather, on the same
/// ground and by the same model. Names of sites and surfaces do not count.
struct RunIdentity {
    std::uint64_t weather = 0;  ///< times, values and site of the forcing table
    std::uint64_t ground = 0;   ///< surfaces, and the cells of a grid
    std::uint64_t model = 0;    ///< laws and steps
};
RunIdentity cell_identity(const ForcingTable& table, const PhysicalParams& params);
RunIdentity grid_identity(const ForcingTable& table, const GridParams& params,
                          std::span<const GridCell> cells);

}  // namespace petrichor::weather

#endif
