#include "weather/physics/detail/step_forcing.h"

#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/physics/detail/lanes.h"
#include "weather/physics/horizon.h"
#include "weather/physics/solar.h"

namespace petrichor::weather::detail {

namespace {

// value_at, where a row at or before the time is known.
double value_from(const ForcingTable& table, const std::vector<double>& v, std::size_t row,
                  std::int64_t time)
{
    const auto& t = table.time_us;
    if (v.empty()) return kMissing;
    if (time < t.front()) return v.front();
    while (row + 1 < t.size() && t[row + 1] <= time) ++row;
    if (row + 1 == t.size()) return v.back();
    const double x = static_cast<double>(time - t[row]) / static_cast<double>(t[row + 1] - t[row]);
    return v[row] + (v[row + 1] - v[row]) * x;
}

// Mean of a column over [begin, end], rows `first` .. the row after the end.
double mean_over(const ForcingTable& table, Field field, std::size_t first, std::int64_t begin,
                 std::int64_t end)
{
    const auto& v = table[field];
    const auto& t = table.time_us;
    const bool rate = field_info(field).is_rate;
    double sum = 0.0;
    std::int64_t at = begin;
    std::size_t i = first;
    double from = rate ? 0.0 : value_from(table, v, first, begin);
    while (at < end) {
        // Piece from `at` to the next row or the end; beyond the last row values stay (rates: 0).
        while (i + 1 < t.size() && t[i + 1] <= at) ++i;
        const bool last = i + 1 >= t.size() || at < t[0];
        std::int64_t to = last ? end : std::min(end, t[i + 1]);
        if (at < t[0]) to = std::min(end, t[0]);
        const double width = static_cast<double>(to - at);
        if (rate) {
            const bool inside = at >= t[0] && i + 1 < t.size();
            // The last row's rate lasts as long as the row before it did.
            const bool tail =
                i + 1 == t.size() && t.size() > 1 && at >= t[i] && at < t[i] + (t[i] - t[i - 1]);
            if (inside || tail || t.size() == 1) sum += v[i] * width;
        } else {
            const double until = value_from(table, v, i, to);
            sum += 0.5 * (from + until) * width;
            from = until;
        }
        at = to;
    }
    return sum / static_cast<double>(end - begin);
}

// Where a step lies in its table. Usually it is the interval between two rows.
struct StepRows {
    std::size_t first;  // the last row at or before the beginning
    std::int64_t begin, end;
    bool between_rows;
};

Ramp ramp_by_integral(const ForcingTable& table, Field field, const StepRows& at, double offset)
{
    const double a = value_from(table, table[field], at.first, at.begin);
    const double b = value_from(table, table[field], at.first, at.end);
    const double mean = mean_over(table, field, at.first, at.begin, at.end);
    return {mean - 0.5 * (b - a) + offset, b - a};
}
PETRICHOR_INLINE Ramp ramp_over(const ForcingTable& table, Field field, const StepRows& at,
                                double offset)
{
    if (!at.between_rows) return ramp_by_integral(table, field, at, offset);
    const double* v = table[field].data() + at.first;
    return {v[0] + offset, v[1] - v[0]};
}

double rate_over(const ForcingTable& table, Field field, const StepRows& at)
{
    if (at.between_rows) return table[field][at.first];
    return mean_over(table, field, at.first, at.begin, at.end);
}

// `first`: the last row at or before the beginning.
StepForcing step_from(const ForcingTable& table, std::size_t first, std::int64_t begin,
                      std::int64_t length, SunUse use, const Observer& observer,
                      const Skyline& skyline)
{
    const auto& t = table.time_us;
    const std::int64_t end = begin + length;
    const StepRows at{first, begin, end,
                      first + 1 < t.size() && t[first] == begin && t[first + 1] == end};
    StepForcing step;
    step.begin_us = begin;
    step.dt_s = static_cast<double>(length) * 1e-6;
    step.air_c = ramp_over(table, Field::AirTemp, at, -kZeroCelsiusK);
    step.rh_pct = ramp_over(table, Field::RelHumidity, at, 0.0);
    step.wind = ramp_over(table, Field::Wind, at, 0.0);
    step.pressure = ramp_over(table, Field::Pressure, at, 0.0);
    step.shortwave = ramp_over(table, Field::Shortwave, at, 0.0);
    step.longwave = ramp_over(table, Field::Longwave, at, 0.0);
    if (table.has(Field::Rain) || table.has(Field::Snow)) {
        const double rain = table.has(Field::Rain) ? rate_over(table, Field::Rain, at) : 0.0;
        const double snow = table.has(Field::Snow) ? rate_over(table, Field::Snow, at) : 0.0;
        step.precip = rain + snow;
        step.snow_share = step.precip > 0.0 ? snow / step.precip : 0.0;
        step.phase_known = true;
    } else {
        step.precip = rate_over(table, Field::Precip, at);
        // Where reports or a rising snow depth tell what fell.
        const double share =
            table.has(Field::SnowShare) ? rate_over(table, Field::SnowShare, at) : kMissing;
        if (!std::isnan(share)) {
            step.snow_share = share;
            step.phase_known = true;
        }
    }
    // Where no sun shines its direction changes nothing.
    const bool lit = step.shortwave.start > 0.0 || step.shortwave.start + step.shortwave.rise > 0.0;
    const bool place =
        !std::isnan(table.site.latitude_deg) && !std::isnan(table.site.longitude_deg);
    if (use == SunUse::Direction && lit && place) {
        const SunNear near(begin + length / 2, observer);
        const SunDirection sun = near.at(begin + length / 2);
        step.sun_east = sun.east;
        step.sun_north = sun.north;
        step.sun_up = sun.up;
        step.diffuse = diffuse_fraction(step.shortwave.at(0.5), sun.up, sun.extraterrestrial_w_m2);
        if (!skyline.empty()) step.beam = beam_share(skyline, begin, length, observer, near);
    }
    if (table.has(Field::NetShortwave)) {
        step.shortwave = {rate_over(table, Field::NetShortwave, at), 0.0};
        step.reflecting = 0.0;
    }
    step.middle = moment_of(step, 0.5, 1.0);
    return step;
}

// Of a table without a place nobody asks for the sun.
Observer observer_of(const ForcingTable& table)
{
    const bool placed =
        !std::isnan(table.site.latitude_deg) && !std::isnan(table.site.longitude_deg);
    return placed ? Observer(table.site.latitude_deg, table.site.longitude_deg) : Observer(0.0, 0.0);
}

// The last row at or before a time; the first row for earlier times.
std::size_t row_before(const ForcingTable& table, std::int64_t time_us)
{
    const auto& t = table.time_us;
    const auto upper = std::upper_bound(t.begin(), t.end(), time_us);
    return upper == t.begin() ? 0 : static_cast<std::size_t>(upper - t.begin()) - 1;
}

}  // namespace

StationMoment moment_of(const StepForcing& step, double x, double until)
{
    StationMoment m;
    const double later = until - x;
    m.air_c = step.air_c.at(x);
    m.from_middle_k = m.air_c - step.air_c.at(0.5);
    m.rh_share = 0.01 * step.rh_pct.at(x);
    m.wind = step.wind.at(x);
    m.pressure = step.pressure.at(x);
    m.shortwave = larger(step.shortwave.at(x), 0.0);
    const double air_k = m.air_c + kZeroCelsiusK;
    const double squared = air_k * air_k;
    m.sky_w_m2_k4 = step.longwave.at(x) / (squared * squared);
    m.reflecting = step.reflecting;
    m.later_air_k = step.air_c.rise * later;
    m.later_wind = step.wind.rise * later / (m.wind + 1.0);
    m.later_rh = step.rh_pct.rise * later / (step.rh_pct.at(x) + 1.0);
    m.later_shortwave = step.shortwave.rise * later;
    m.later_longwave = step.longwave.rise * later;
    return m;
}

StepForcing make_step_forcing(const ForcingTable& table, std::int64_t begin, std::int64_t length,
                              SunUse sun, std::span<const double> horizon)
{
    return step_from(table, row_before(table, begin), begin, length, sun, observer_of(table),
                     Skyline(horizon));
}

std::int64_t StepPlan::length_of(std::size_t step) const
{
    return std::min(length_us, end_us - begin_of(step));
}

StepPlan make_step_plan(const ForcingTable& table, std::int64_t step_us)
{
    StepPlan plan;
    plan.begin_us = table.time_us.front();
    plan.length_us = step_us;
    // The last row's interval counts too: its precipitation falls after its time.
    const std::int64_t tail =
        table.rows() > 1 ? table.time_us.back() - table.time_us[table.rows() - 2] : step_us;
    plan.end_us = table.time_us.back() + tail;
    plan.count = static_cast<std::size_t>((plan.end_us - plan.begin_us + step_us - 1) / step_us);
    return plan;
}

StepWalk::StepWalk(const ForcingTable& table, const StepPlan& plan, std::size_t first_step,
                   SunUse sun, std::span<const double> horizon)
    : table_(&table),
      plan_(&plan),
      step_(first_step),
      row_(row_before(table, plan.begin_of(first_step))),
      sun_(sun),
      observer_(observer_of(table)),
      skyline_(horizon)
{
}

StepForcing StepWalk::next()
{
    const std::int64_t begin = plan_->begin_of(step_);
    while (row_ + 1 < table_->rows() && table_->time_us[row_ + 1] <= begin) ++row_;
    return step_from(*table_, row_, begin, plan_->length_of(step_++), sun_, observer_, skyline_);
}

std::vector<StepForcing> make_step_forcings(const ForcingTable& table, std::int64_t step_us,
                                            std::span<const double> horizon)
{
    const StepPlan plan = make_step_plan(table, step_us);
    std::vector<StepForcing> steps;
    steps.reserve(plan.count);
    StepWalk walk(table, plan, 0, SunUse::Direction, horizon);
    for (std::size_t i = 0; i < plan.count; ++i) steps.push_back(walk.next());
    return steps;
}

}  // namespace petrichor::weather::detail
