#include "weather/models/physical/road_events.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "weather/physics/brine.h"

namespace petrichor::weather {

namespace {

constexpr double kMostSpread_g_m2 = 1000.0;

void plough(CellState& c, double share)
{
    for (std::size_t i = 0; i < kSnowLayers; ++i) {
        const double ice = c.snow_ice[i] * share, liquid = c.snow_liquid[i] * share;
        c.total_drainage += ice + liquid;
        c.snow_ice[i] -= ice;
        c.snow_liquid[i] -= liquid;
        c.snow_thickness[i] *= 1.0 - share;
        if (c.snow_ice[i] > 0.0) continue;
        // A clean plough leaves no layer behind.
        c.snow_thickness[i] = c.snow_temp_c[i] = 0.0;
    }
}

}  // namespace

void apply_event(CellState& c, const RoadEvent& event)
{
    switch (event.kind) {
        case RoadEvent::Kind::Salt:
            c.salt += 1e-3 * event.amount;
            break;
        case RoadEvent::Kind::Brine: {
            const double water = 1e-3 * event.amount * (1.0 - kSpreadBrine);
            c.salt += 1e-3 * event.amount * kSpreadBrine;
            c.film += water;
            c.total_precip += water;
            break;
        }
        case RoadEvent::Kind::Plough:
            plough(c, event.amount);
            break;
    }
}

void check_events(std::span<const RoadEvent> events)
{
    for (std::size_t i = 0; i < events.size(); ++i) {
        const RoadEvent& e = events[i];
        const double most = e.kind == RoadEvent::Kind::Plough ? 1.0 : kMostSpread_g_m2;
        if (!(e.amount >= 0.0 && e.amount <= most)) {
            throw Error(
                "road events: an amount of " + std::to_string(e.amount) + ", accepted are 0.." +
                    (most > 1.0 ? "1000 g/m2" : "1"),
                "Give salt and brine in g/m2, and a plough the share of the snow it takes.");
        }
        if (i > 0 && e.time_us < events[i - 1].time_us)
            throw Error("road events: times go back", "Sort the events by time.");
    }
}

}  // namespace petrichor::weather
