#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_PHYSICAL_GRID_CHECKPOINT_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_PHYSICAL_GRID_CHECKPOINT_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "weather/models/physical/identity.h"
#include "weather/models/physical/physical_grid.h"

namespace petrichor::weather {

/// The states of all cells at the grid's present step, as bytes that are the same on every machine.
std::string save_grid(const PhysicalGrid& grid, const RunIdentity& identity);

/// Puts saved states into a grid of the same identity, which then goes on with the same bits.
/// Returns how many of the bytes were used: what follows belongs to the caller.
///   throws  Error for bytes that save_grid did not write, that are cut short or damaged, or that
///   belong to another weather, ground or model (it says which)
std::size_t load_grid(PhysicalGrid& grid, const RunIdentity& identity, std::string_view bytes);

/// Numbers as eight bytes each, the lowest first, appended to and taken from the front of bytes.
void put_number(std::string& bytes, std::uint64_t number);
std::uint64_t take_number(std::string_view& bytes);  ///< throws Error when there are no eight bytes

}  // namespace petrichor::weather

#endif
