#include "cli/bench/skill/road.h"

#include <algorithm>
#include <cmath>

#include "weather/models/physical/observed_start.h"
#include "weather/physics/constants.h"
#include "weather/physics/friction.h"

namespace petrichor::cli {
namespace {

using weather::Field;
using weather::ForcingTable;

constexpr double kStep_s = 600.0;

std::size_t last_measured(const weather::MetroObservation& observed)
{
    std::size_t last = observed.surface_c.size();
    for (std::size_t i = 0; i < observed.surface_c.size(); ++i)
        if (!std::isnan(observed.surface_c[i])) last = i;
    return last;
}

weather::RoadTemperatures temperatures(const RoadCase& road, std::size_t count)
{
    const weather::MetroObservation& o = road.observed;
    return {std::span(o.table.time_us).first(count), std::span(o.surface_c).first(count),
            std::span(o.subsurface_c).first(count), road.station.subsurface_depth_m};
}

// Air and fluxes that METRo used, from the last measurement on.
ForcingTable table_of(const RoadCase& road, std::int64_t begin_us, double emissivity)
{
    const weather::MetroRoadcast& r = road.roadcast;
    ForcingTable t;
    t.site = road.station.site;
    const auto add = [&](std::int64_t us, std::size_t i) {
        t.time_us.push_back(us);
        t[Field::AirTemp].push_back(r.air_c[i] + weather::kZeroCelsiusK);
        t[Field::DewPoint].push_back(r.dew_point_c[i] + weather::kZeroCelsiusK);
        t[Field::Wind].push_back(r.wind_m_s[i]);
        if (road.forecast.has(Field::Pressure))
            t[Field::Pressure].push_back(weather::value_at(road.forecast, Field::Pressure, us));
        const std::size_t next = std::min(i + 1, r.air_c.size() - 1);
        t[Field::NetShortwave].push_back(0.5 * (r.shortwave_w_m2[i] + r.shortwave_w_m2[next]));
        t[Field::Longwave].push_back(r.longwave_w_m2[i] / emissivity);
        t[Field::Rain].push_back(std::max(r.rain_mm_h[next], 0.0) / 3600.0);
        t[Field::Snow].push_back(std::max(r.snow_mm_h[next], 0.0) / 3600.0);
    };
    if (begin_us < r.time_us.front()) add(begin_us, 0);
    for (std::size_t i = 0; i < r.time_us.size(); ++i)
        if (r.time_us[i] >= begin_us) add(r.time_us[i], i);
    weather::ReadReport report;
    weather::fill_forcing(t, report);
    return t;
}

SkillRow row_of(const RoadCase& road, const char* quantity, const ErrorSum& sum)
{
    return {road.name, quantity, "K", sum.count(), sum.mae(), sum.bias(), "MAE"};
}

}  // namespace

std::vector<SkillRow> road_rows(const RoadCase& road, const weather::PhysicalParams& params)
{
    const std::size_t last = last_measured(road.observed);
    if (last == road.observed.surface_c.size() || road.roadcast.time_us.empty()) return {};
    weather::PhysicalParams p = params;
    p.surface.layers = road.station.layers;
    p.step_s = p.substep_s = kStep_s;
    p.exchange.rain_heat = 0.0;  // METRo knows none
    const std::int64_t begin_us =
        std::min(road.observed.table.time_us[last], road.roadcast.time_us.front());
    const ForcingTable table = table_of(road, begin_us, p.surface.emissivity);
    // As METRo begins.
    const weather::CellState start = weather::observed_start(
        table, p, temperatures(road, last + 1), weather::FirstProfile::Metro);
    const auto run_with = [&](double traffic_wind_m_s) {
        weather::PhysicalParams stirred = p;
        stirred.surface.traffic_wind_m_s = traffic_wind_m_s;
        return weather::PhysicalTimeline(table, stirred, start, table.time_us.front());
    };
    // METRo's vehicles do not stir the air.
    const weather::PhysicalTimeline run = run_with(0.0),
                                    in_use = run_with(params.surface.traffic_wind_m_s);
    ErrorSum ours, used, air, conditions;
    for (std::size_t i = 0; i < road.roadcast.time_us.size(); ++i) {
        const double metro_c = road.roadcast.surface_c[i];
        const weather::CellState cell = run.state_at(road.roadcast.time_us[i]);
        ours.add(cell.surface_temp_c - metro_c);
        used.add(in_use.state_at(road.roadcast.time_us[i]).surface_temp_c - metro_c);
        air.add(road.roadcast.air_c[i] - metro_c);
        const int metro = road.roadcast.condition[i];
        if (metro > 0)
            conditions.add(static_cast<int>(weather::road_condition(cell)) == metro ? 0.0 : 1.0);
    }
    SkillRow other = row_of(road, "other condition than METRo", conditions);
    other.unit = "share";
    other.measure = "of hours";
    return {row_of(road, "road beside METRo", ours),
            row_of(road, "with traffic's wind", used),
            row_of(road, "air beside METRo", air), other};
}

}  // namespace petrichor::cli
