#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_ROAD_EVENTS_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_ROAD_EVENTS_H

#include <cstdint>
#include <span>

#include "weather/physics/cell_state.h"

namespace petrichor::weather {

/// What a road's keepers do. It happens at the end of the step that it falls into: never before its
/// time, at most one step late.
struct RoadEvent {
    enum class Kind : std::uint8_t {
        Salt,    ///< dry salt, g/m2, 0..1000
        Brine,   ///< salt water of 23 %, g/m2 of both together, 0..1000
        Plough,  ///< the share of the snow that goes, 0..1
    };
    std::int64_t time_us = 0;
    Kind kind = Kind::Salt;
    double amount = 0.0;
};

/// Share of salt in the brine that is spread.
inline constexpr double kSpreadBrine = 0.23;

/// Does it to a cell; water of brine counts as precipitation.
void apply_event(CellState& cell, const RoadEvent& event);

/// Throws Error for amounts out of range or times that go back.
void check_events(std::span<const RoadEvent> events);

}  // namespace petrichor::weather

#endif
