#include "cli/bench/skill/road_hindcast.h"

#include <cmath>
#include <string>

#include "weather/forcing/cut_forcing.h"
#include "weather/models/physical/observed_water.h"
#include "weather/physics/constants.h"

namespace petrichor::cli {
namespace {

using weather::Field;
using weather::ForcingTable;

constexpr double kStep_s = 600.0;
constexpr std::int64_t kHour_us = 3600LL * weather::kMicrosPerSecond;
constexpr std::int64_t kLeast_us = 6 * kHour_us, kBefore_us = 3 * kHour_us,
                       kAhead_us = 6 * kHour_us;
constexpr std::size_t kLeastValues = 6, kFewestValues = 2;

struct Errors {
    ErrorSum coupled, started, air, kept;
};

class Hindcast {
public:
    Hindcast(const RoadCase& road, const weather::PhysicalParams& params,
             const weather::CouplingParams& coupling)
        : road_(road), params_(params), coupling_(coupling)
    {
        params_.surface.layers = road.station.layers;
        params_.horizon = road.station.horizon_rad;
        params_.step_s = params_.substep_s = kStep_s;
        const auto& surface_c = road.observed.surface_c;
        for (std::size_t i = 0; i < surface_c.size(); ++i)
            if (!std::isnan(surface_c[i])) measured_.push_back(i);
    }
    bool lasts(std::size_t values, std::int64_t span_us) const
    {
        return measured_.size() >= values && time(measured_.back()) - begin() >= span_us;
    }
    void fill()
    {
        ForcingTable forecast = road_.forecast;
        forecast.site = road_.station.site;
        weather_ = weather::observed_weather(road_.observed, forecast);
        weather::ReadReport unheard;
        weather::fill_forcing(weather_, unheard);
    }
    Errors all_ahead() const
    {
        Errors errors;
        forecast(measured_.front(), time(measured_.back()), errors);
        return errors;
    }
    Errors half_ahead() const
    {
        const std::int64_t half_us = begin() + (time(measured_.back()) - begin()) / 2;
        std::size_t from = measured_.front();
        for (const std::size_t i : measured_)
            if (time(i) <= half_us) from = i;
        Errors errors;
        forecast(from, time(measured_.back()), errors);
        return errors;
    }
    Errors hours_ahead() const
    {
        Errors errors;
        std::int64_t next_us = begin() + kBefore_us;
        for (const std::size_t i : measured_) {
            if (time(i) < next_us || i == measured_.back()) continue;
            forecast(i, time(i) + kAhead_us, errors);
            next_us = time(i) + kHour_us;
        }
        return errors;
    }

private:
    std::int64_t time(std::size_t i) const { return road_.observed.table.time_us[i]; }
    std::int64_t begin() const { return time(measured_.front()); }

    void forecast(std::size_t from, std::int64_t to_us, Errors& errors) const
    {
        const weather::MetroObservation& o = road_.observed;
        const weather::RoadTemperatures known{
            std::span(o.table.time_us).first(from + 1), std::span(o.surface_c).first(from + 1),
            std::span(o.subsurface_c).first(from + 1), road_.station.subsurface_depth_m};
        const ForcingTable plain =
            weather::cut_forcing(weather_, time(from), time(measured_.back()));
        ForcingTable corrected = plain;
        weather::correct_radiation(corrected,
                                   weather::couple_radiation(weather_, params_, known, coupling_));
        const weather::CellState start =
            with_water(weather::observed_start(plain, params_, known),
                       weather::observed_water(weather_, params_, known));
        const weather::PhysicalTimeline coupled(corrected, params_, start, time(from)),
            started(plain, params_, start, time(from));
        for (const std::size_t i : measured_) {
            if (i <= from || time(i) > to_us) continue;
            const double seen_c = o.surface_c[i];
            errors.coupled.add(coupled.state_at(time(i)).surface_temp_c - seen_c);
            errors.started.add(started.state_at(time(i)).surface_temp_c - seen_c);
            errors.air.add(weather::value_at(weather_, Field::AirTemp, time(i)) -
                           weather::kZeroCelsiusK - seen_c);
            errors.kept.add(o.surface_c[from] - seen_c);
        }
    }

    const RoadCase& road_;
    weather::PhysicalParams params_;
    weather::CouplingParams coupling_;
    std::vector<std::size_t> measured_;  // rows of the observation
    ForcingTable weather_;
};

}  // namespace

std::vector<SkillRow> road_hindcast_rows(const RoadCase& road,
                                         const weather::PhysicalParams& params,
                                         const weather::CouplingParams& coupling)
{
    Hindcast hindcast(road, params, coupling);
    if (!hindcast.lasts(kFewestValues, kBefore_us)) return {};
    hindcast.fill();
    std::vector<SkillRow> rows;
    const auto add = [&](const char* what, const std::string& ahead, const ErrorSum& sum) {
        if (sum.count() > 0)
            rows.push_back({road.name, what + (", " + ahead), "K", sum.count(), sum.rmse(),
                            sum.bias(), "RMSE"});
    };
    const auto add_all = [&](const Errors& errors, const char* ahead, bool coupled = true) {
        if (coupled) add("road coupled", ahead, errors.coupled);
        add("road started", ahead, errors.started);
        add("air", ahead, errors.air);
        add("road kept", ahead, errors.kept);
    };
    add_all(hindcast.all_ahead(), "all ahead", false);
    if (!hindcast.lasts(kLeastValues, kLeast_us)) return rows;
    add_all(hindcast.half_ahead(), "half ahead");
    add_all(hindcast.hours_ahead(), "6 h ahead");
    return rows;
}

}  // namespace petrichor::cli
