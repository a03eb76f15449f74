#include "weather/packed/point_series.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "base/error.h"
#include "weather/packed/detail/point_names.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"
#include "weather/readers/text.h"

namespace petrichor::weather::packed {

using detail::What;
using detail::what_of;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostTimes = 2000000;

// "W m**-2", "W m-2" and "W/m^2" are "wm-2", "wm-2" and "w/m2".
std::string plain(const std::string& units)
{
    std::string out;
    for (const char c : lower(units)) {
        if (c != ' ' && c != '*' && c != '^' && c != '.') out += c;
    }
    return out;
}
bool is_one_of(const std::string& word, std::initializer_list<const char*> words)
{
    return std::any_of(words.begin(), words.end(), [&](const char* w) { return word == w; });
}
[[noreturn]] void refuse_units(const PointVariable& v)
{
    throw Error("weather: variable '" + shown(v.name) + "' has the unit '" + shown(v.units) +
                    "', which is not known for it",
                "Convert the variable to SI units.");
}

// Seconds from each time to the next; the last one as the one before.
std::vector<double> steps_of(const std::vector<std::int64_t>& time_us)
{
    std::vector<double> steps(time_us.size(), 3600.0);
    for (std::size_t i = 0; i + 1 < time_us.size(); ++i)
        steps[i] = static_cast<double>(time_us[i + 1] - time_us[i]) * 1e-6;
    if (time_us.size() > 1) steps.back() = steps[steps.size() - 2];
    return steps;
}

// Amounts that add up: through a day (ERA5-Land: the value at 00 is the whole day before) or
// through a run (WRF).
enum class Adding { No, Day, Run };
Adding adding_of(const std::vector<double>& v, const std::vector<std::int64_t>& time_us)
{
    std::size_t falls_at_one = 0, falls_elsewhere = 0, rises = 0;
    double most = 0.0;
    for (const double x : v) {
        if (!std::isnan(x)) most = std::max(most, std::abs(x));
    }
    const double tolerance = 1e-5 * most;  // of packing
    for (std::size_t i = 1; i < v.size(); ++i) {
        if (std::isnan(v[i]) || std::isnan(v[i - 1])) continue;
        const std::int64_t of_day = ((time_us[i - 1] % 86400000000LL) + 86400000000LL) %
                                    86400000000LL;  // of the row before
        if (v[i] < v[i - 1] - tolerance)
            ++(of_day == 0 ? falls_at_one : falls_elsewhere);
        else
            rises += v[i] > v[i - 1] + tolerance;
    }
    if (rises == 0 || falls_elsewhere > 0 || v.size() < 12) return Adding::No;
    return falls_at_one ? Adding::Day : Adding::Run;
}

// Differences in time of an amount that adds up; the first is not known.
std::vector<double> differences(const std::vector<double>& v,
                                const std::vector<std::int64_t>& time_us, Adding adding)
{
    std::vector<double> out(v.size(), kNone);
    for (std::size_t i = 1; i < v.size(); ++i) {
        const bool fresh = adding == Adding::Day && time_us[i - 1] % 86400000000LL == 0;
        out[i] = std::max(fresh ? v[i] : v[i] - v[i - 1], 0.0);
    }
    return out;
}

// What happened in the interval before each time becomes what happens in the interval after it.
std::vector<double> moved_forward(const std::vector<double>& v)
{
    std::vector<double> out(v.begin() + (v.empty() ? 0 : 1), v.end());
    if (!v.empty()) out.push_back(kNone);
    return out;
}

class Table {
public:
    explicit Table(const PointSeries& s) : s_(s), steps_(steps_of(s.time_us)) {}

    void put(What what, const PointVariable& v)
    {
        switch (what) {
            case What::AirTemp:
                return temperature("air_temp_k", v);
            case What::DewPoint:
                return temperature("dew_point_k", v);
            case What::SurfaceTemp:
                return temperature("surface_temp_k", v);
            case What::Shortwave:
                return flux("sw_down_w_m2", v);
            case What::Direct:
                return;
            case What::Longwave:
                return flux("lw_down_w_m2", v);
            case What::Reflected:
                return flux("sw_up_w_m2", v);
            case What::NetShortwave:
                return flux("sw_net_w_m2", v);
            case What::Precip:
            case What::PrecipMore:
                return water("precip_kg_m2_s", v);
            case What::Rain:
                return water("rain_kg_m2_s", v);
            case What::Snow:
                return water("snowfall_kg_m2_s", v);
            default:
                return plain_value(what, v);
        }
    }
    bool has(const char* name) const { return columns_.count(name) != 0; }
    std::vector<double>& column(const char* name) { return columns_[name]; }
    std::vector<std::string> notes;

    // Humidity and wind from their parts; phases from a total.
    void finish()
    {
        if (has("q") && !has("rel_humidity_pct") && has("air_temp_k")) {
            auto& rh = columns_["rel_humidity_pct"];
            const auto& t = columns_["air_temp_k"];
            const auto& q = columns_["q"];
            const bool pressure = has("pressure_pa");
            for (std::size_t i = 0; i < q.size(); ++i) {
                const double p = pressure ? columns_["pressure_pa"][i] : 101325.0;
                const double e = q[i] * p / (0.622 + 0.378 * q[i]);
                const bool good = t[i] > 173.15 && t[i] < 333.15 && e >= 0.0;
                rh.push_back(good ? std::min(100.0 * e / saturation_pressure_water_pa(t[i]), 100.0)
                                  : kNone);
            }
        }
        columns_.erase("q");
        if (has("east") && has("north")) {
            if (!has("wind_m_s")) {
                auto& speed = columns_["wind_m_s"];
                for (std::size_t i = 0; i < columns_["east"].size(); ++i)
                    speed.push_back(std::hypot(columns_["east"][i], columns_["north"][i]));
            }
            auto& from = columns_["wind_from_deg"];
            from.clear();
            for (std::size_t i = 0; i < columns_["east"].size(); ++i) {
                const double a =
                    std::atan2(-columns_["east"][i], -columns_["north"][i]) * 180.0 / kPi;
                from.push_back(a < 0.0 ? a + 360.0 : a);
            }
        }
        columns_.erase("east");
        columns_.erase("north");
        if (has("snowfall_kg_m2_s") && has("precip_kg_m2_s") && !has("rain_kg_m2_s")) {
            auto& rain = columns_["rain_kg_m2_s"];
            for (std::size_t i = 0; i < s_.time_us.size(); ++i)
                rain.push_back(
                    std::max(columns_["precip_kg_m2_s"][i] - columns_["snowfall_kg_m2_s"][i], 0.0));
        }
        if (has("snowfall_kg_m2_s") && has("rain_kg_m2_s")) columns_.erase("precip_kg_m2_s");
    }

    std::string csv() const
    {
        std::string out = "time";
        for (const auto& [name, values] : columns_) out.append(",").append(name);
        out += '\n';
        char number[40];
        for (std::size_t i = 0; i < s_.time_us.size(); ++i) {
            out += iso_from_us(s_.time_us[i]);
            for (const auto& [name, values] : columns_) {
                out += ',';
                if (std::isnan(values[i])) continue;
                const auto end =
                    std::to_chars(number, number + sizeof number, static_cast<float>(values[i]))
                        .ptr;
                out.append(number, end);
            }
            out += '\n';
        }
        return out;
    }

private:
    void add(const std::string& name, std::vector<double> values, double scale, double offset)
    {
        for (double& v : values) v = v * scale + offset;
        auto& column = columns_[name];
        if (column.empty()) {
            column = std::move(values);
            return;
        }
        const bool sum = name == "precip_kg_m2_s";
        for (std::size_t i = 0; i < column.size() && sum; ++i) column[i] += values[i];
        if (!sum) notes.push_back("two variables give " + name + ": the first is used");
    }
    void temperature(const char* name, const PointVariable& v)
    {
        const std::string u = plain(v.units);
        if (is_one_of(u, {"k", "kelvin", ""}))
            add(name, v.values, 1.0, 0.0);
        else if (is_one_of(u, {"c", "degc", "celsius", "degreec", "degreecelsius", "degree_celsius",
                               "degrees_c", "degreesc",
                               "\xC2\xB0"
                               "c"}))
            add(name, v.values, 1.0, kZeroCelsiusK);
        else
            refuse_units(v);
    }
    // W/m2, or J/m2 of the time before (an hour, or what adds up).
    void flux(const char* name, const PointVariable& v)
    {
        const std::string u = plain(v.units);
        if (is_one_of(u, {"wm-2", "w/m2", "w/m-2", "watts/m2", ""})) {
            add(name, s_.ends_of_intervals ? centred(v.values) : v.values, 1.0, 0.0);
            return;
        }
        if (!is_one_of(u, {"jm-2", "j/m2"})) refuse_units(v);
        add(name, centred(rates_of(v)), 1.0, 0.0);
    }
    // kg m-2 s-1 at the time, or an amount of the time before.
    void water(const char* name, const PointVariable& v)
    {
        const std::string u = plain(v.units);
        double scale = 0.0;
        bool rate = false;
        if (is_one_of(u, {"kgm-2s-1", "kg/m2/s", "mm/s", "mms-1", "kg/m2s"})) {
            scale = 1.0;
            rate = true;
        } else if (is_one_of(u, {"ms-1", "m/s"})) {
            scale = 1000.0;
            rate = true;
        } else if (is_one_of(u, {"mm/h", "mmh-1", "mmhr-1", "kgm-2h-1"})) {
            scale = 1.0 / 3600.0;
            rate = true;
        } else if (is_one_of(u, {"m", "mofwaterequivalent"})) {
            scale = 1000.0;
        } else if (is_one_of(u, {"mm", "kgm-2", "kg/m2", "kgm2"})) {
            scale = 1.0;
        } else {
            refuse_units(v);
        }
        if (rate)
            add(name, s_.ends_of_intervals ? moved_forward(v.values) : v.values, scale, 0.0);
        else
            add(name, moved_forward(rates_of(v)), scale, 0.0);
    }
    // An amount of the interval before each time, a second.
    std::vector<double> rates_of(const PointVariable& v)
    {
        const Adding adding = adding_of(v.values, s_.time_us);
        std::vector<double> out =
            adding == Adding::No ? v.values : differences(v.values, s_.time_us, adding);
        for (std::size_t i = 0; i < out.size(); ++i) {
            // Plain amounts of reanalyses are those of one hour, however far apart the rows.
            const double hour = 3600.0;
            const double seconds = adding == Adding::No ? std::min(hour, steps_[i ? i - 1 : 0])
                                                        : steps_[i ? i - 1 : 0];
            out[i] = out[i] / seconds;
            if (out[i] < 0.0 && out[i] > -1.0) out[i] = 0.0;  // noise of packing
        }
        if (adding == Adding::Day)
            notes.push_back(v.name + " adds up through the day: taken apart");
        if (adding == Adding::Run)
            notes.push_back(v.name + " adds up through the run: taken apart");
        return out;
    }
    // Means of the time before become values at the times.
    static std::vector<double> centred(const std::vector<double>& v)
    {
        std::vector<double> out = v;
        for (std::size_t i = 0; i + 1 < v.size(); ++i) {
            if (std::isnan(v[i + 1])) continue;
            out[i] = std::isnan(v[i]) ? v[i + 1] : 0.5 * (v[i] + v[i + 1]);
        }
        return out;
    }
    void plain_value(What what, const PointVariable& v)
    {
        const std::string u = plain(v.units);
        const auto scaled = [&](const char* name,
                                std::initializer_list<std::pair<const char*, double>> known) {
            for (const auto& [unit, scale] : known) {
                if (u == unit) return add(name, v.values, scale, 0.0);
            }
            refuse_units(v);
        };
        switch (what) {
            case What::SpecificHumidity:
                return scaled("q", {{"kgkg-1", 1.0},
                                    {"kg/kg", 1.0},
                                    {"1", 1.0},
                                    {"gg-1", 1.0},
                                    {"g/g", 1.0},
                                    {"g/kg", 1e-3},
                                    {"gkg-1", 1e-3},
                                    {"", 1.0}});
            case What::RelHumidity:
                return scaled("rel_humidity_pct", {{"%", 1.0}, {"percent", 1.0}, {"1", 100.0}});
            case What::Wind:
                return scaled("wind_m_s", {{"ms-1", 1.0}, {"m/s", 1.0}, {"", 1.0}});
            case What::WindEast:
                return scaled("east", {{"ms-1", 1.0}, {"m/s", 1.0}, {"", 1.0}});
            case What::WindNorth:
                return scaled("north", {{"ms-1", 1.0}, {"m/s", 1.0}, {"", 1.0}});
            case What::WindFrom:
                return scaled("wind_from_deg", {{"degree", 1.0}, {"degrees", 1.0}, {"deg", 1.0}});
            case What::Pressure:
                return scaled("pressure_pa", {{"pa", 1.0},
                                              {"hpa", 100.0},
                                              {"mbar", 100.0},
                                              {"mb", 100.0},
                                              {"kpa", 1000.0},
                                              {"", 1.0}});
            case What::Cloud:
                return scaled("cloud_fraction", {{"(0-1)", 1.0},
                                                 {"1", 1.0},
                                                 {"", 1.0},
                                                 {"%", 0.01},
                                                 {"percent", 0.01},
                                                 {"(0 - 1)", 1.0}});
            case What::SnowDepth:
                return scaled("snow_depth_m", {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}});
            case What::SnowWater:
                return scaled("snow_water_kg_m2", {{"kgm-2", 1.0},
                                                   {"kg/m2", 1.0},
                                                   {"mm", 1.0},
                                                   {"m", 1000.0},
                                                   {"mofwaterequivalent", 1000.0}});
            case What::Visibility:
                return scaled("visibility_m", {{"m", 1.0}, {"km", 1000.0}});
            default:
                return;
        }
    }

    const PointSeries& s_;
    std::vector<double> steps_;
    std::map<std::string, std::vector<double>> columns_;
};

std::string line_of(const char* key, double value)
{
    if (std::isnan(value)) return "";
    char text[80];
    std::snprintf(text, sizeof text, "# %s: %.6g\n", key, value);
    return text;
}

std::string one_line(std::string text)
{
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    return text;
}

}  // namespace

std::string csv_of(const PointSeries& s)
{
    if (s.time_us.empty() || s.time_us.size() > kMostTimes) {
        throw Error("weather: the file has " + std::to_string(s.time_us.size()) +
                        " times; 1 to 2000000 are accepted",
                    "Give a file with times, or a part of this one.");
    }
    Table table(s);
    std::string unread;
    double elevation = s.elevation_m;
    for (const PointVariable& v : s.variables) {
        const auto what = what_of(v);
        if (!what) {
            unread.append(unread.empty() ? "" : ", ").append(shown(v.name));
            continue;
        }
        if (v.values.size() != s.time_us.size() && *what != What::Height) continue;
        if (*what == What::Height) {
            if (v.values.empty() || std::isnan(v.values.front()) || !std::isnan(elevation))
                continue;
            const bool geopotential = is_one_of(plain(v.units), {"m2s-2", "m2/s2"});
            elevation = v.values.front() / (geopotential ? kGravity_m_s2 : 1.0);
            continue;
        }
        if (std::all_of(v.values.begin(), v.values.end(), [](double x) { return std::isnan(x); }))
            continue;
        table.put(*what, v);
    }
    table.finish();
    if (!table.has("air_temp_k") && !table.has("sw_down_w_m2") && !table.has("precip_kg_m2_s") &&
        !table.has("rain_kg_m2_s")) {
        throw Error("weather: " + s.kind + ": no variable of the weather is known" +
                        (unread.empty() ? "" : " among " + unread),
                    "Give a file with, for example, t2m or air_temperature.");
    }
    std::string out = "# petrichor: " + s.kind + "\n" + line_of("latitude", s.latitude_deg) +
                      line_of("longitude", s.longitude_deg) + line_of("elevation_m", elevation);
    for (const auto& notes : {s.notes, table.notes}) {
        for (const std::string& note : notes) out += "# note: " + one_line(note) + "\n";
    }
    if (!unread.empty()) out += "# note: not read: " + one_line(unread) + "\n";
    return out + table.csv();
}

}  // namespace petrichor::weather::packed
