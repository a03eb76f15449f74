#ifndef PETRICHOR_WEATHER_PHYSICAL_GRID_CHECKPOINT_H
#define PETRICHOR_WEATHER_PHYSICAL_GRID_CHECKPOINT_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "weather/physical_grid.h"

namespace petrichor::weather {

/// What the states of a grid depend on, as hashes: states may only go on under the same weather, on
/// the same ground and by the same model.
struct GridIdentity {
    std::uint64_t weather = 0;  ///< times, values and site of the forcing table
    std::uint64_t ground = 0;   ///< cells and surfaces
    std::uint64_t model = 0;    ///< laws and steps
};
GridIdentity grid_identity(const ForcingTable& table, const GridParams& params,
                           std::span<const GridCell> cells);

/// The states of all cells at the grid's present step, as bytes that are the same on every machine.
std::string save_grid(const PhysicalGrid& grid, const GridIdentity& identity);

/// Puts saved states into a grid of the same identity, which then goes on with the same bits.
/// Returns how many of the bytes were used: what follows belongs to the caller.
///   throws  Error for bytes that save_grid did not write, that are cut short or damaged, or that
///   belong to another weather, ground or model (it says which)
std::size_t load_grid(PhysicalGrid& grid, const GridIdentity& identity, std::string_view bytes);

/// Numbers as eight bytes each, the lowest first, appended to and taken from the front of bytes.
void put_number(std::string& bytes, std::uint64_t number);
std::uint64_t take_number(std::string_view& bytes);  ///< throws Error when there are no eight bytes

}  // namespace petrichor::weather

#endif
