#include "weather/models/physical/observed_water.h"

#include <algorithm>

#include "weather/forcing/cut_forcing.h"

namespace petrichor::weather {

// Where it rains at the first measurement it has rained before.
static RoadWater first_water(const ForcingTable& weather, const PhysicalParams& params,
                             std::int64_t time_us)
{
    RoadWater water;
    if (weather.has(Field::Rain) && value_at(weather, Field::Rain, time_us) > 0.0)
        water.film = params.surface.film_capacity_kg_m2;
    return water;
}

RoadWater observed_water(const ForcingTable& weather, const PhysicalParams& params,
                         const RoadTemperatures& measured)
{
    constexpr double kStep_s = 600.0;
    const auto usable = [](double c) { return c > -90.0 && c < 100.0; };  // false for NaN
    const auto& c = measured.surface_c;
    const auto first = static_cast<std::size_t>(std::find_if(c.begin(), c.end(), usable) - c.begin());
    std::size_t last = c.size();
    while (last > first && !usable(c[last - 1])) --last;
    if (last == first || measured.time_us.size() < last) return {};
    const std::int64_t begin_us = measured.time_us[first], end_us = measured.time_us[last - 1];
    const RoadWater before = first_water(weather, params, begin_us);
    if (last == first + 1) return before;
    const ForcingTable hours = cut_forcing(weather, begin_us, end_us);
    PhysicalParams fine = params;
    fine.step_s = std::min(fine.step_s, kStep_s);
    fine.substep_s = std::min(fine.substep_s, fine.step_s);
    const CellState start = observed_start(
        hours, fine,
        {measured.time_us.first(first + 1), c.first(first + 1),
         measured.subsurface_c.first(std::min(first + 1, measured.subsurface_c.size())),
         measured.subsurface_depth_m});
    const CellState end =
        PhysicalTimeline(hours, fine, with_water(start, before), begin_us).state_at(end_us);
    return {end.film, end.crack, end.puddle};
}

CellState with_water(CellState start, const RoadWater& water)
{
    start.film = water.film;
    start.crack = water.crack;
    start.puddle = water.puddle;
    return start;
}

}  // namespace petrichor::weather
