#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_PHYSICAL_CHECKPOINT_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_PHYSICAL_CHECKPOINT_H

#include <cstdint>
#include <string>
#include <string_view>

#include "weather/models/physical/identity.h"
#include "weather/physics/cell_state.h"

namespace petrichor::weather {

/// A cell where a step begins: enough to go on with identical bits.
struct CellCheckpoint {
    std::int64_t at_us = 0;
    CellState state{};
};

/// As text that is the same on every machine.
std::string save_checkpoint(const CellCheckpoint& checkpoint, const RunIdentity& identity);

/// And back.
///   throws  Error for a text that save_checkpoint did not write, that is cut short or damaged, or
///   that belongs to another weather, surface or model (it says which)
CellCheckpoint load_checkpoint(std::string_view text, const RunIdentity& identity);

}  // namespace petrichor::weather

#endif
