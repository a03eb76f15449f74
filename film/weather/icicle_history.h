#ifndef PETRICHOR_FILM_WEATHER_ICICLE_HISTORY_H
#define PETRICHOR_FILM_WEATHER_ICICLE_HISTORY_H

#include <functional>
#include <memory>

#include "formulas/weather/moment.h"
#include "scene/icicles/icicle.h"

namespace petrichor::film {

/// Heat that air of a moment takes from wet ice of so wide a radius, W/m2: by convection around a cylinder in half the wind
/// of a thermometer's height, by vapour, by long waves (as of surroundings as warm as the air). Below 0 C water freezes by
/// it, above ice melts by what is below 0 of it.
///   source   Hilpert 1933 for cylinders across a wind; Makkonen 1988 for what takes the heat of an icicle
double icicle_cooling_w_m2(const shared::WeatherMoment& weather, double radius_m);

/// An icicle of a kilogram of ice and more after dt_s of one moment, kg. It freezes of the water no more than there is and than the
/// air can; above 0 C it melts, and never grows.
///   water_kg   that comes to it meanwhile, >= 0
double icicle_after(double ice_kg, double water_kg, const shared::WeatherMoment& weather, double dt_s);

/// Whether a scene so high has any: they grow as long as a hand, and a thing on a table, below 1.5 m, has none.
bool carries_icicles(float height_m);

/// Icicles at edges over the time of a weather: what has dripped there and frozen, by what the edges have drained.
///
/// Water that comes: what runs off in rain and after it and what leaves a snow pack, which holds it back for an hour and a half.
/// Asked on a fixed grid from the first moment on, linear between its points: an answer depends on the time alone. Copies
/// share the grid, which is made with the first question.
class IcicleHistory {
public:
    struct Clock {
        double begin_s = 0.0;  ///< of the weather: where none hang yet
        double end_s = 0.0;    ///< of the film
        double weather_s_per_s = 3600.0;
    };

    /// No weather: none anywhere.
    IcicleHistory() = default;
    /// weather   at a second of the clock
    IcicleHistory(std::function<shared::WeatherMoment(double clock_s)> weather, const Clock& clock);

    scene::IcicleLengths at(double clock_s) const;
    /// Some hang between these times, at edges that drain most.
    bool any(double from_s, double to_s) const;

private:
    struct Grid;
    std::shared_ptr<Grid> grid_;
};

}  // namespace petrichor::film

#endif
