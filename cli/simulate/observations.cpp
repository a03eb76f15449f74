#include "cli/simulate/observations.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "base/error.h"
#include "base/words.h"
#include "cli/report/plot_axes.h"
#include "weather/physics/constants.h"
#include "weather/physics/friction.h"
#include "weather/readers/text.h"

namespace petrichor::cli {
namespace {

constexpr double kDay_s = 86400.0;

std::optional<double> observed_value(std::string_view cell)
{
    const auto value = weather::to_number(cell);
    if (!value || *value == -99.0 || *value == -999.0 || *value == -9999.0) return std::nullopt;
    return value;
}

std::string table_column_of(std::string_view name, const std::vector<std::string>& columns)
{
    const std::string low = weather::lower(weather::trimmed(name));
    constexpr std::pair<const char*, const char*> kOtherNames[] = {
        {"albedo", "snow_albedo"},
        {"depth_m", "snow_depth_m"},
        {"swe", "swe_kg_m2"},
        {"swe_mm", "swe_kg_m2"},
        {"surface_temperature_c", "surface_temp_c"}};
    for (const auto& [other, column] : kOtherNames) {
        if (low == other) return column;
    }
    const auto found = std::find(columns.begin(), columns.end(), low);
    return found == columns.end() || low == "time_s" ? "" : low;
}

class Collector {
public:
    explicit Collector(std::string file) : file_(std::move(file)) {}

    std::size_t column(const std::string& name)
    {
        observations_.columns.push_back({name, {}, {}});
        return observations_.columns.size() - 1;
    }
    void add(std::size_t column, std::int64_t us, std::string_view cell)
    {
        const auto value = observed_value(cell);
        if (!value) return;
        observations_.columns[column].time_us.push_back(us);
        observations_.columns[column].values.push_back(*value);
    }
    void bad(std::size_t line, const std::string& why)
    {
        if (bad_++ < 5)
            observations_.notes.push_back(file_ + " line " + std::to_string(line) + ": " + why +
                                          ", left out");
    }
    void good() { ++good_; }
    void set_daily(bool daily) { observations_.daily = daily; }
    Observations finish()
    {
        if (bad_ > 5)
            observations_.notes.push_back(file_ + ": " + std::to_string(bad_ - 5) +
                                          " more rows left out");
        std::erase_if(observations_.columns,
                      [](const ObservedColumn& c) { return c.values.empty(); });
        if (observations_.columns.empty() || bad_ > good_) {
            throw Error("observations: " + file_ + ": " + std::to_string(good_) + " good rows, " +
                            std::to_string(bad_) + " bad" +
                            (observations_.notes.empty()
                                 ? ""
                                 : "\n  " + join_words(observations_.notes, "\n  ")),
                        "Give a CSV with date and, for example, snow_depth_m and swe_kg_m2, or the "
                        "nine columns of FSM.");
        }
        return std::move(observations_);
    }

private:
    std::string file_;
    Observations observations_;
    std::size_t bad_ = 0, good_ = 0;
};

// year month day albedo runoff depth SWE surface soil
Observations read_fsm_observations(std::string_view text, const std::string& file)
{
    Collector out(file);
    out.set_daily(true);
    const std::size_t albedo = out.column("snow_albedo"), depth = out.column("snow_depth_m"),
                      swe = out.column("swe_kg_m2"), surface = out.column("surface_temp_c");
    weather::Lines lines(text);
    while (const auto line = lines.next()) {
        if (weather::trimmed(*line).empty()) continue;
        const auto f = weather::words(*line);
        const bool whole = f.size() == 9 && weather::to_integer(f[0]) &&
                           weather::to_integer(f[1]) && weather::to_integer(f[2]);
        const auto us =
            whole ? weather::us_from_civil(
                        {*weather::to_integer(f[0]), static_cast<int>(*weather::to_integer(f[1])),
                         static_cast<int>(*weather::to_integer(f[2])), 0, 0, 0.0})
                  : std::nullopt;
        if (!us) {
            out.bad(lines.number(), "is not year month day and six numbers");
            continue;
        }
        out.good();
        out.add(albedo, *us, f[3]);
        out.add(depth, *us, f[5]);
        out.add(swe, *us, f[6]);
        out.add(surface, *us, f[7]);
    }
    return out.finish();
}

Observations read_csv_observations(std::string_view text, const std::string& file,
                                   const std::vector<std::string>& table_columns)
{
    Collector out(file);
    weather::Lines lines(text);
    std::vector<std::string_view> names;
    char separator = ',';
    while (names.empty()) {
        const auto line = lines.next();
        if (!line) break;
        const auto words = weather::trimmed(*line);
        if (words.empty() || words.front() == '#') continue;
        for (const char c : {',', ';', '\t'}) {
            if (std::count(line->begin(), line->end(), c) >
                std::count(line->begin(), line->end(), separator))
                separator = c;
        }
        names = weather::split(*line, separator, 256);
    }
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::size_t time_at = kNone;
    std::vector<std::size_t> to(names.size(), kNone);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string low = weather::lower(weather::trimmed(names[i]));
        if (time_at == kNone &&
            (low == "date" || low == "time" || low == "datetime" || low == "time_utc")) {
            time_at = i;
            continue;
        }
        const std::string column = table_column_of(names[i], table_columns);
        if (!column.empty()) to[i] = out.column(column);
    }
    if (time_at == kNone ||
        std::all_of(to.begin(), to.end(), [&](std::size_t c) { return c == kNone; })) {
        throw Error("observations: " + file +
                        ": the header has no date or time, or no column of the simulation",
                    "Name columns as in: date,snow_depth_m,swe_kg_m2,surface_temp_c,albedo.");
    }
    bool daily = true;
    while (const auto line = lines.next()) {
        const auto words = weather::trimmed(*line);
        if (words.empty() || words.front() == '#') continue;
        const auto f = weather::split(*line, separator, 256);
        const auto us = f.size() == names.size() ? weather::us_from_iso(f[time_at]) : std::nullopt;
        if (!us) {
            out.bad(lines.number(), f.size() == names.size()
                                        ? "'" + weather::shown(f[time_at]) + "' is not a date"
                                        : "has " + std::to_string(f.size()) + " columns");
            continue;
        }
        out.good();
        daily = daily && weather::trimmed(f[time_at]).size() <= 10;
        for (std::size_t i = 0; i < f.size(); ++i) {
            if (to[i] != kNone) out.add(to[i], *us, f[i]);
        }
    }
    out.set_daily(daily);
    return out.finish();
}

// Rows of a table seen as functions of time.
struct Rows {
    const SimulationTable& table;
    std::vector<double> times;

    explicit Rows(const SimulationTable& t) : table(t)
    {
        for (const auto& row : t.rows) times.push_back(row[0]);
    }
    double first_s() const { return times.front(); }
    double last_s() const { return times.back(); }
    double at(std::size_t column, double time_s) const
    {
        const auto above = std::lower_bound(times.begin(), times.end(), time_s - 1e-6);
        const auto i = static_cast<std::size_t>(above - times.begin());
        if (i == 0 || std::abs(times[i] - time_s) < 1e-6) return table.rows[i][column];
        const double x = (time_s - times[i - 1]) / (times[i] - times[i - 1]);
        return table.rows[i - 1][column] + (table.rows[i][column] - table.rows[i - 1][column]) * x;
    }
    // Of what is a class and not a quantity.
    double nearest(std::size_t column, double time_s) const
    {
        const auto above = std::lower_bound(times.begin(), times.end(), time_s);
        const auto i = static_cast<std::size_t>(above - times.begin());
        if (i == times.size()) return table.rows.back()[column];
        const bool before = i > 0 && time_s - times[i - 1] < times[i] - time_s;
        return table.rows[before ? i - 1 : i][column];
    }
    // Mean over [from, from + a day), weighted by another column where there is one.
    std::optional<double> daily_mean(std::size_t column, double from_s,
                                     std::optional<std::size_t> weight) const
    {
        double sum = 0.0, weights = 0.0;
        const auto begin = std::lower_bound(times.begin(), times.end(), from_s - 1e-6);
        for (auto t = begin; t != times.end() && *t < from_s + kDay_s - 1e-6; ++t) {
            const auto& row = table.rows[static_cast<std::size_t>(t - times.begin())];
            const double w = weight ? row[*weight] : 1.0;
            sum += w * row[column];
            weights += w;
        }
        return weights > 0.0 ? std::optional(sum / weights) : std::nullopt;
    }
};

std::optional<double> depth_on(const Observations& observed, std::int64_t us)
{
    for (const ObservedColumn& c : observed.columns) {
        if (c.column != "snow_depth_m") continue;
        const auto at = std::lower_bound(c.time_us.begin(), c.time_us.end(), us);
        if (at != c.time_us.end() && *at == us)
            return c.values[static_cast<std::size_t>(at - c.time_us.begin())];
        return 0.0;  // depth is observed, but not on this day
    }
    return std::nullopt;
}

std::string unit_of(const std::string& column)
{
    const auto ends = [&](std::string_view end) {
        return column.size() > end.size() && column.ends_with(end);
    };
    if (ends("_kg_m2")) return "kg/m2";
    if (ends("_w_m2")) return "W/m2";
    if (ends("_temp_c")) return "K";
    if (ends("_m")) return "m";
    return "";
}

Score score_of(const Rows& rows, const Observations& observed, const ObservedColumn& one)
{
    const std::size_t column = column_index(rows.table, one.column);
    const bool mean =
        observed.daily && (one.column == "surface_temp_c" || one.column == "snow_albedo");
    const std::size_t sun = column_index(rows.table, "sw_down_w_m2");
    const bool by_sun = one.column == "snow_albedo" && sun < rows.table.columns.size();
    Score score{one.column, unit_of(one.column), 0, 0.0, 0.0, ""};
    score.how = !observed.daily ? "at the time of the observation"
                                : (mean ? "daily mean, snow deeper than 0.1 m" : "at 12 h");
    for (std::size_t i = 0; i < one.values.size(); ++i) {
        const double day_s = static_cast<double>(one.time_us[i] - rows.table.utc_start_us) * 1e-6;
        std::optional<double> model;
        if (mean) {
            if (depth_on(observed, one.time_us[i]).value_or(1.0) <= 0.1 || day_s < rows.first_s() ||
                day_s + kDay_s > rows.last_s() + 3600.0)
                continue;
            model = rows.daily_mean(column, day_s, by_sun ? std::optional(sun) : std::nullopt);
        } else {
            const double at_s = day_s + (observed.daily ? 0.5 * kDay_s : 0.0);
            if (at_s < rows.first_s() || at_s > rows.last_s()) continue;
            model = rows.at(column, at_s);
        }
        if (!model) continue;
        ++score.count;
        score.rmse += (*model - one.values[i]) * (*model - one.values[i]);
        score.bias += *model - one.values[i];
    }
    if (score.count > 0) {
        score.rmse = std::sqrt(score.rmse / static_cast<double>(score.count));
        score.bias /= static_cast<double>(score.count);
    }
    return score;
}

// Dry, wet, or white: what an observer and METRo's codes tell apart alike.
int kind_of_condition(double code)
{
    using weather::RoadCondition;
    switch (static_cast<RoadCondition>(std::lround(code))) {
        case RoadCondition::Dry: return 0;
        case RoadCondition::Wet:
        case RoadCondition::Dew: return 1;
        default: return 2;
    }
}

Score agreement_of(const Rows& rows, const ObservedColumn& one)
{
    const std::size_t column = column_index(rows.table, one.column);
    Score score{one.column, "", 0, 0.0, 0.0, "dry, wet, or snow and ice, at the time", 0.0};
    std::size_t same = 0;
    for (std::size_t i = 0; i < one.values.size(); ++i) {
        const double at_s = static_cast<double>(one.time_us[i] - rows.table.utc_start_us) * 1e-6;
        if (at_s < rows.first_s() || at_s > rows.last_s()) continue;
        ++score.count;
        same += kind_of_condition(rows.nearest(column, at_s)) == kind_of_condition(one.values[i]);
    }
    if (score.count > 0)
        score.agreement = static_cast<double>(same) / static_cast<double>(score.count);
    return score;
}

// On days without much snow the measured surface is not the snow's.
PlotDots dots_of(const SimulationTable& table, const Observations& observed,
                 const ObservedColumn& one)
{
    PlotDots dots{observed.label, "#111827", {}, {}};
    const double shift_s = observed.daily ? 0.5 * kDay_s : 0.0;
    for (std::size_t i = 0; i < one.values.size(); ++i) {
        const double at_s =
            static_cast<double>(one.time_us[i] - table.utc_start_us) * 1e-6 + shift_s;
        if (table.rows.empty() || at_s < table.rows.front()[0] || at_s > table.rows.back()[0])
            continue;
        if (observed.daily && one.column == "snow_albedo" &&
            depth_on(observed, one.time_us[i]).value_or(1.0) <= 0.1)
            continue;
        dots.time_s.push_back(at_s);
        dots.values.push_back(one.values[i]);
    }
    return dots;
}

}  // namespace

Observations read_observations(std::string_view text, const std::string& file,
                               const std::vector<std::string>& table_columns)
{
    if (text.find('\0') != text.npos || weather::trimmed(text.substr(0, 65536)).empty()) {
        throw Error("observations: " + file + " is " +
                        (text.find('\0') != text.npos ? "a binary file" : "empty"),
                    "Give a text file.");
    }
    const auto first = weather::words(weather::Lines(text).next().value_or(""), 16);
    const bool fsm =
        first.size() == 9 && std::all_of(first.begin(), first.end(), [](std::string_view w) {
            return weather::to_number(w).has_value();
        });
    return fsm ? read_fsm_observations(text, file)
               : read_csv_observations(text, file, table_columns);
}

Observations observations_of(const weather::ForcingTable& table)
{
    using weather::Field;
    Observations out;
    out.label = "in the file";
    const auto take = [&](Field field, const char* column, double offset) {
        if (!table.has(field)) return;
        ObservedColumn one{column, {}, {}};
        bool any = false;
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const double value = table[field][i];
            if (std::isnan(value)) continue;
            any = any || value != 0.0;
            one.time_us.push_back(table.time_us[i]);
            one.values.push_back(value + offset);
        }
        if (any) out.columns.push_back(std::move(one));
    };
    take(Field::SnowDepth, "snow_depth_m", 0.0);
    take(Field::SnowWater, "swe_kg_m2", 0.0);
    take(Field::SurfaceTemp, "surface_temp_c", -weather::kZeroCelsiusK);
    take(Field::Condition, "road_condition", 0.0);
    take(Field::Friction, "wheel_friction", 0.0);
    if (table.has(Field::Reflected) && table.has(Field::Shortwave)) {
        // Where no depth tells, what is darker than old snow is the ground's (Oke 1987: soil and grass
        // to 0.35).
        constexpr double kLeastOfSnow = 0.4;
        ObservedColumn albedo{"snow_albedo", {}, {}};
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const double sun = table[Field::Shortwave][i], up = table[Field::Reflected][i];
            const bool snow = table.has(Field::SnowDepth) ? table[Field::SnowDepth][i] > 0.1
                                                          : up > kLeastOfSnow * sun;
            // A low sun measures the mast and the tilt of the sensor.
            if (!(sun > 150.0) || std::isnan(up) || !snow || up > sun) continue;
            albedo.time_us.push_back(table.time_us[i]);
            albedo.values.push_back(up / sun);
        }
        if (!albedo.values.empty()) out.columns.push_back(std::move(albedo));
    }
    return out;
}

void compare(const SimulationTable& fine, const Observations& observed, SimulationTable& table)
{
    table.notes.insert(table.notes.end(), observed.notes.begin(), observed.notes.end());
    if (fine.rows.empty() || !fine.dated) return;
    const Rows rows(fine);
    for (const ObservedColumn& one : observed.columns) {
        const bool classes = one.column == "road_condition";
        const Score score = classes ? agreement_of(rows, one) : score_of(rows, observed, one);
        if (score.count == 0) {
            table.notes.push_back("observed " + one.column + ": nothing to compare in this time");
            continue;
        }
        char line[200];
        if (score.agreement)
            std::snprintf(line, sizeof line, "observed %s: %.0f %% agree, %zu values (%s)",
                          one.column.c_str(), *score.agreement * 100.0, score.count,
                          score.how.c_str());
        else
            std::snprintf(line, sizeof line, "observed %s: RMSE %.4g%s%s, bias %+.3g, %zu values (%s)",
                      one.column.c_str(), score.rmse, score.unit.empty() ? "" : " ",
                      score.unit.c_str(), score.bias, score.count, score.how.c_str());
        table.notes.emplace_back(line);
        table.scores.push_back(score);
        for (PlotPanel& panel : table.panels) {
            if (std::any_of(panel.series.begin(), panel.series.end(),
                            [&](const PlotSeries& s) { return s.column == one.column; })) {
                panel.dots.push_back(dots_of(table, observed, one));
            }
        }
    }
}

}  // namespace petrichor::cli
