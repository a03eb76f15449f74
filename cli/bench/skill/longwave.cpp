#include "cli/bench/skill/longwave.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <utility>

#include "weather/physics/constants.h"
#include "weather/readers/text.h"

namespace petrichor::cli {

using weather::Field;
using weather::ForcingTable;

namespace {

constexpr const char* kUnderCloud = "longwave under cloud";
constexpr std::size_t kFewHours = 50;
constexpr double kStep = 0.03;  // of the measured sky: 10 W/m2; the year's round makes 0.012
constexpr double kSun_w_m2 = 300.0, kClear = 0.3;  // 0.3 of cloud takes a hundredth of the sun
constexpr double kFalls_kg_m2_s = 0.5 / 3600.0;

// A share of what a black sky sends, and when.
struct SkyHour {
    std::int64_t time_us;
    double less_1;
};

// The measured longwave over that of a black sky as warm as the air, less 1, in damp hours with
// rain or snow: low cloud then, which is nearly black. What is far from 0 is the instrument's.
std::vector<SkyHour> sky_of_falling_hours(const ForcingTable& made, const ForcingTable& raw)
{
    std::vector<SkyHour> hours;
    if (!raw.has(Field::RelHumidity)) return hours;
    for (std::size_t i = 0; i < raw.rows(); ++i) {
        double falls = 0.0;
        for (const Field f : {Field::Precip, Field::Rain, Field::Snow})
            if (raw.has(f) && !std::isnan(raw[f][i])) falls += raw[f][i];
        if (!(falls > kFalls_kg_m2_s && raw[Field::RelHumidity][i] >= 95.0)) continue;
        const double air_k = made[Field::AirTemp][i], square = air_k * air_k;
        const double less_1 =
            raw[Field::Longwave][i] / (weather::kStefanBoltzmann * square * square) - 1.0;
        if (std::isfinite(less_1)) hours.push_back({raw.time_us[i], less_1});
    }
    return hours;
}

// The time from which these hours have another mean: where the sum of differences from the mean of
// all is farthest from 0 (Pettitt's manner), with kFewHours at least on either side.
struct SkyStep {
    std::int64_t from_us = 0;
    double step = 0.0;  // of the means after and before it
    std::size_t hours = 0;
};
SkyStep largest_step(const std::vector<SkyHour>& hours)
{
    double all = 0.0, before = 0.0, farthest = -1.0;
    for (const SkyHour& h : hours) all += h.less_1;
    const auto n = static_cast<double>(hours.size());
    SkyStep found;
    for (std::size_t i = 1; i < hours.size(); ++i) {
        before += hours[i - 1].less_1;
        if (i < kFewHours || hours.size() - i < kFewHours) continue;
        const auto k = static_cast<double>(i);
        const double step = (all - before) / (n - k) - before / k;
        const double far = std::abs(step) * std::sqrt(k * (n - k));
        if (far <= farthest) continue;
        farthest = far;
        found = {hours[i].time_us, step, hours.size()};
    }
    return found;
}

}  // namespace

ForcingTable without_longwave(const ForcingTable& raw)
{
    ForcingTable table = raw;
    table[Field::Longwave].clear();
    weather::ReadReport report;
    weather::fill_forcing(table, report);
    return table;
}

namespace {

// Longwave and sunlight as they are made where a file has neither them nor clouds.
std::vector<SkillRow> rows_of_air_alone(const std::string& set, const ForcingTable& raw)
{
    ForcingTable air = raw;
    for (const Field f : {Field::Longwave, Field::Shortwave, Field::NetShortwave, Field::Direct,
                          Field::Diffuse, Field::Cloud})
        air[f].clear();
    weather::ReadReport report;
    weather::fill_forcing(air, report);
    if (air.rows() != raw.rows()) return {};
    std::vector<SkillRow> rows;
    for (const Field f : {Field::Longwave, Field::Shortwave}) {
        if (!raw.has(f)) continue;
        ErrorSum sum;
        for (std::size_t i = 0; i < raw.rows(); ++i) sum.add(air[f][i] - raw[f][i]);
        rows.push_back({set, f == Field::Longwave ? "longwave by air alone" : "sun by air alone",
                        "W/m2", sum.count(), sum.rmse(), sum.bias(), "RMSE"});
    }
    return rows;
}

}  // namespace

std::vector<SkillRow> longwave_rows(const std::string& set, const ForcingTable& raw)
{
    if (!raw.has(Field::Longwave)) return {};
    const ForcingTable made = without_longwave(raw);
    if (made.rows() != raw.rows()) return {};  // rows were divided: nothing to set side by side
    const std::vector<SkyHour> falling = sky_of_falling_hours(made, raw);
    ErrorSum black;
    for (const SkyHour& h : falling) black.add(h.less_1);
    const SkyStep step = largest_step(falling);
    ErrorSum all, cloudy, levelled, sunny, cloudy_before, cloudy_after;
    for (std::size_t i = 0; i < raw.rows(); ++i) {
        const double measured = raw[Field::Longwave][i];
        const double error = made[Field::Longwave][i] - measured;
        all.add(error);
        if (raw.has(Field::Shortwave) && raw[Field::Shortwave][i] > kSun_w_m2 &&
            made[Field::Cloud][i] < kClear)
            sunny.add(error);
        if (made[Field::Cloud][i] < 0.9) continue;
        cloudy.add(error);
        (raw.time_us[i] < step.from_us ? cloudy_before : cloudy_after).add(error);
        if (black.count() >= kFewHours)
            levelled.add(made[Field::Longwave][i] - measured / (1.0 + black.bias()));
    }
    if (all.count() == 0) return {};
    std::vector<SkillRow> rows{
        {set, "longwave", "W/m2", all.count(), all.rmse(), all.bias(), "RMSE"}};
    if (cloudy.count() > 0) {
        rows.push_back({set, kUnderCloud, "W/m2", cloudy.count(),
                        std::abs(cloudy.bias()), cloudy.bias(), "|bias|"});
    }
    if (sunny.count() >= kFewHours) {
        rows.push_back({set, "longwave in clear sun", "W/m2", sunny.count(), std::abs(sunny.bias()),
                        sunny.bias(), "|bias|"});
    }
    if (black.count() >= kFewHours) {
        rows.push_back({set, "sky measured in rain, snow", "of a black sky", black.count(),
                        1.0 + black.bias(), black.bias(), "data, no score"});
        rows.push_back({set, "longwave, that sky black", "W/m2", levelled.count(),
                        std::abs(levelled.bias()), levelled.bias(), "|bias|"});
    }
    for (SkillRow& row : rows_of_air_alone(set, raw)) rows.push_back(std::move(row));
    if (std::abs(step.step) >= kStep) {
        // What follows such a day is another instrument's, or another place's.
        const std::string day = weather::iso_from_us(step.from_us).substr(0, 10);
        rows.push_back({set, "sky step on " + day, "of a black sky", step.hours,
                        std::abs(step.step), step.step, "data, no score"});
        rows.push_back({set, "under cloud to " + day, "W/m2", cloudy_before.count(),
                        std::abs(cloudy_before.bias()), cloudy_before.bias(), "|bias|"});
        rows.push_back({set, "under cloud from " + day, "W/m2", cloudy_after.count(),
                        std::abs(cloudy_after.bias()), cloudy_after.bias(), "|bias|"});
    }
    return rows;
}

std::vector<SkillRow> longwave_of_places(const std::vector<PlacedRows>& sets)
{
    struct Sum {
        double error = 0.0;
        std::size_t hours = 0;
    };
    std::map<std::pair<double, double>, Sum> places;
    for (const PlacedRows& set : sets) {
        for (const SkillRow& row : set.rows) {
            if (row.quantity != kUnderCloud) continue;
            Sum& sum = places[{set.site.latitude_deg, set.site.longitude_deg}];
            sum.error += row.bias * static_cast<double>(row.count);
            sum.hours += row.count;
        }
    }
    std::vector<SkillRow> rows;
    for (const auto& [place, sum] : places) {
        char name[64];
        std::snprintf(name, sizeof name, "%.2f %c %.2f %c", std::abs(place.first),
                      place.first < 0.0 ? 'S' : 'N', std::abs(place.second),
                      place.second < 0.0 ? 'W' : 'E');
        const double bias = sum.error / static_cast<double>(sum.hours);
        rows.push_back({name, "under cloud, all sets", "W/m2", sum.hours, std::abs(bias), bias,
                        "|bias|"});
    }
    return rows;
}

}  // namespace petrichor::cli
