#include "cli/bench/skill/winter.h"

#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/snow_simple.h"

namespace petrichor::cli {
namespace {

using weather::Field;

constexpr std::int64_t kHour_us = 3600LL * weather::kMicrosPerSecond;
constexpr double kSnowDay_m = 0.1;         // snow deep enough for its surface to be what was seen
constexpr double kDegreeDayDensity = 300;  // kg/m3, for a depth beside its SWE
constexpr double kGone_m = 0.01;

const ObservedColumn* column_of(const Observations& observed, const char* name)
{
    for (const ObservedColumn& c : observed.columns)
        if (c.column == name) return &c;
    return nullptr;
}

// The hour of an instant, or nothing outside the run.
const SnowHour* hour_at(const SnowHours& model, std::int64_t us)
{
    const std::int64_t i = (us - model.begin_us) / kHour_us;
    if (us < model.begin_us || i >= static_cast<std::int64_t>(model.hours.size())) return nullptr;
    return &model.hours[static_cast<std::size_t>(i)];
}

double daily_mean(const SnowHours& model, std::int64_t day_us, double SnowHour::*value, bool by_sun)
{
    double sum = 0.0, weights = 0.0;
    for (int h = 0; h < 24; ++h) {
        const SnowHour* hour = hour_at(model, day_us + h * kHour_us);
        if (!hour) return kNoScore;
        const double weight = by_sun ? hour->shortwave_w_m2 : 1.0;
        sum += weight * (hour->*value);
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : kNoScore;
}

SkillRow row_of(const Winter& winter, const char* quantity, const char* unit, const ErrorSum& sum)
{
    return {winter.name, quantity, unit, sum.count(), sum.rmse(), sum.bias(), "RMSE"};
}

// The first day without snow after the last one with more than 0.1 m; -1 where the season goes on.
std::int64_t gone_us(const std::vector<std::int64_t>& days, const std::vector<double>& depths)
{
    std::size_t last = days.size();
    for (std::size_t i = 0; i < days.size(); ++i)
        if (depths[i] > kSnowDay_m) last = i;
    for (std::size_t i = last; i < days.size(); ++i)
        if (depths[i] <= kGone_m) return days[i];
    return -1;
}

void add_snow_off(const Winter& winter, const ObservedColumn& depth, const SnowHours& model,
                  std::vector<SkillRow>& rows)
{
    std::vector<double> modelled;
    std::vector<std::int64_t> days;
    for (const std::int64_t day_us : depth.time_us) {
        const SnowHour* noon = hour_at(model, day_us + 12 * kHour_us);
        if (!noon) continue;
        days.push_back(day_us);
        modelled.push_back(noon->depth_m);
    }
    const std::int64_t seen = gone_us(depth.time_us, depth.values);
    const std::int64_t ours = gone_us(days, modelled);
    if (seen < 0 || ours < 0) return;
    ErrorSum sum;
    sum.add(static_cast<double>(ours - seen) / static_cast<double>(24 * kHour_us));
    rows.push_back(row_of(winter, "snow off", "days", sum));
}

}  // namespace

SnowHours model_hours(const Winter& winter, const weather::PhysicalParams& params)
{
    const weather::PhysicalTimeline timeline(winter.table, params);
    SnowHours out;
    out.begin_us = timeline.begin_us();
    const auto states = timeline.series(timeline.begin_us(), timeline.end_us(), kHour_us);
    out.hours.reserve(states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        const weather::CellState& c = states[i];
        const auto d = weather::diagnostics(c);
        const std::int64_t us = out.begin_us + static_cast<std::int64_t>(i) * kHour_us;
        out.hours.push_back({d.snow_depth_m, d.swe_kg_m2, c.surface_temp_c, c.snow_albedo,
                             weather::value_at(winter.table, Field::Shortwave, us)});
    }
    return out;
}

SnowHours degree_day_hours(const Winter& winter)
{
    const weather::ForcingTable& table = winter.table;
    const weather::DegreeDayParams params;
    SnowHours out;
    out.begin_us = table.time_us.front();
    double swe_kg_m2 = 0.0;
    const auto hours = (table.time_us.back() - out.begin_us) / kHour_us;
    for (std::int64_t i = 0; i <= hours; ++i) {
        const std::int64_t us = out.begin_us + i * kHour_us;
        out.hours.push_back({swe_kg_m2 / kDegreeDayDensity, swe_kg_m2, kNoScore, kNoScore, 0.0});
        const double temp_k = weather::value_at(table, Field::AirTemp, us);
        const double later_k = weather::value_at(table, Field::AirTemp, us + kHour_us);
        double share = std::clamp(
            (params.all_rain_k - temp_k) / (params.all_rain_k - params.all_snow_k), 0.0, 1.0);
        const auto row = static_cast<std::size_t>(
            std::upper_bound(table.time_us.begin(), table.time_us.end(), us) -
            table.time_us.begin() - 1);
        double fallen = table[Field::Precip][row] * 3600.0;
        if (table.has(Field::Snow)) {
            fallen = table[Field::Snow][row] * 3600.0;
            share = 1.0;
        }
        swe_kg_m2 += fallen * share;
        swe_kg_m2 -= std::min(swe_kg_m2, weather::degree_day_melt_kg_m2(temp_k, later_k, 3600.0,
                                                                        params.melt_kg_m2_k_day));
    }
    return out;
}

std::vector<SkillRow> winter_rows(const Winter& winter, const SnowHours& model)
{
    std::vector<SkillRow> rows;
    const ObservedColumn* depth = column_of(winter.observed, "snow_depth_m");
    const auto at_noon = [&](const char* column, const char* quantity, const char* unit,
                             double SnowHour::*value) {
        const ObservedColumn* seen = column_of(winter.observed, column);
        if (!seen) return;
        ErrorSum sum;
        for (std::size_t i = 0; i < seen->values.size(); ++i) {
            const SnowHour* noon = hour_at(model, seen->time_us[i] + 12 * kHour_us);
            if (noon) sum.add(noon->*value - seen->values[i]);
        }
        if (sum.count() > 0) rows.push_back(row_of(winter, quantity, unit, sum));
    };
    at_noon("snow_depth_m", "snow depth", "m", &SnowHour::depth_m);
    at_noon("swe_kg_m2", "SWE", "kg/m2", &SnowHour::swe_kg_m2);
    at_noon("swe_pit_kg_m2", "SWE of pits", "kg/m2", &SnowHour::swe_kg_m2);
    const auto by_day = [&](const char* column, const char* quantity, const char* unit,
                            double SnowHour::*value, bool by_sun) {
        const ObservedColumn* seen = column_of(winter.observed, column);
        if (!seen) return;
        ErrorSum sum;
        for (std::size_t i = 0; i < seen->values.size(); ++i) {
            double lying_m = 1.0;
            if (depth) {
                const auto at = std::lower_bound(depth->time_us.begin(), depth->time_us.end(),
                                                 seen->time_us[i]);
                const bool known = at != depth->time_us.end() && *at == seen->time_us[i];
                lying_m = known
                              ? depth->values[static_cast<std::size_t>(at - depth->time_us.begin())]
                              : 0.0;
            }
            if (lying_m > kSnowDay_m)
                sum.add(daily_mean(model, seen->time_us[i], value, by_sun) - seen->values[i]);
        }
        if (sum.count() > 0) rows.push_back(row_of(winter, quantity, unit, sum));
    };
    by_day("surface_temp_c", "snow surface", "K", &SnowHour::surface_c, false);
    by_day("snow_albedo", "snow albedo", "", &SnowHour::albedo, true);
    if (depth) add_snow_off(winter, *depth, model, rows);
    return rows;
}

}  // namespace petrichor::cli
