// NASA POWER, hours at a point as CSV (-BEGIN HEADER- .. -END HEADER-, YEAR,MO,DY,HR,..) and JSON.
// Units stand beside the names of the parameters and are read from there; the clock is UTC or local
// solar time, which is that of the longitude in whole hours. A value is the mean of the hour that
// begins at its row. -999 is missing.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/json.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

struct Unit {
    const char* name;
    double scale, offset;
};
struct Parameter {
    const char* name;
    Field field;
    std::vector<Unit> units;
    double height_m = 0.0;  // of wind
};
// Of two parameters for one field the first of the list that the file has counts.
const std::vector<Parameter>& parameters()
{
    static const std::vector<Unit> kTemp = {{"C", 1.0, kZeroCelsiusK}, {"K", 1.0, 0.0}},
                                   kFlux = {{"Wh/m^2", 1.0, 0.0},
                                            {"W/m^2", 1.0, 0.0},
                                            {"MJ/hr", 1e6 / 3600.0, 0.0},
                                            {"MJ/m^2/hour", 1e6 / 3600.0, 0.0}},
                                   kWind = {{"m/s", 1.0, 0.0}}, kDegrees = {{"Degrees", 1.0, 0.0}};
    static const std::vector<Parameter> kAll = {
        {"T2M", Field::AirTemp, kTemp},
        {"T2MDEW", Field::DewPoint, kTemp},
        {"RH2M", Field::RelHumidity, {{"%", 1.0, 0.0}}},
        {"PS", Field::Pressure, {{"kPa", 1000.0, 0.0}}},
        {"WS10M", Field::Wind, kWind, 10.0},
        {"WS2M", Field::Wind, kWind, 2.0},
        {"WS50M", Field::Wind, kWind, 50.0},
        {"WD10M", Field::WindFrom, kDegrees},
        {"WD2M", Field::WindFrom, kDegrees},
        {"WD50M", Field::WindFrom, kDegrees},
        {"ALLSKY_SFC_SW_DWN", Field::Shortwave, kFlux},
        {"ALLSKY_SFC_SW_DNI", Field::Direct, kFlux},
        {"ALLSKY_SFC_SW_DIFF", Field::Diffuse, kFlux},
        {"ALLSKY_SFC_LW_DWN", Field::Longwave, kFlux},
        {"PRECTOTCORR", Field::Precip, {{"mm/hour", 1.0 / 3600.0, 0.0}, {"mm/hr", 1.0 / 3600.0, 0.0}}},
        {"PRECTOT", Field::Precip, {{"mm/hour", 1.0 / 3600.0, 0.0}, {"mm/hr", 1.0 / 3600.0, 0.0}}},
        {"SNODP", Field::SnowDepth, {{"cm", 0.01, 0.0}}},
        {"CLOUD_AMT", Field::Cloud, {{"%", 0.01, 0.0}}}};
    return kAll;
}

[[noreturn]] void refuse_days()
{
    throw Error("weather: NASA POWER: this file holds days or months, no hours",
                "Order it with the temporal level Hourly.");
}

// What the file's parameters mean here.
struct Column {
    std::size_t at;
    Field field;
    double scale, offset;
};
class Meaning {
public:
    /// `unit_of` gives the unit that the file writes beside a parameter.
    ///   throws  Error for a unit that is not known
    template <class UnitOf>
    Meaning(const std::vector<std::string>& names, RowCollector& rows, const UnitOf& unit_of)
    {
        std::vector<bool> used(names.size(), false);
        std::array<bool, kFieldCount> has{};
        for (const Parameter& p : parameters()) {
            const auto found = std::find(names.begin(), names.end(), p.name);
            bool& taken = has[static_cast<std::size_t>(p.field)];
            if (found == names.end() || taken) continue;
            const std::string unit = unit_of(p.name);
            const auto known = std::find_if(p.units.begin(), p.units.end(),
                                            [&](const Unit& u) { return unit == u.name; });
            if (known == p.units.end())
                throw Error("weather: NASA POWER: the unit '" + shown(unit) + "' of " + p.name +
                                " is not known",
                            "Order it again with its usual units, hours.");
            taken = true;
            const auto at = static_cast<std::size_t>(found - names.begin());
            used[at] = true;
            columns.push_back({at, p.field, known->scale, known->offset});
            if (p.height_m > 0.0) rows.site().wind_height_m = p.height_m;
            if (!field_info(p.field).is_rate) rows.holds_after(p.field, 1800.0);
        }
        std::vector<std::string> unread;
        for (std::size_t i = 0; i < names.size(); ++i)
            if (!used[i] && !names[i].empty()) unread.push_back(names[i]);
        rows.unread_columns(unread);
    }
    void set(std::size_t at, double value, double fill, RowCollector& rows) const
    {
        for (const Column& c : columns) {
            if (c.at != at) continue;
            if (std::isnan(value) || value == fill)
                rows.missing(c.field);
            else
                rows.set(c.field, value * c.scale + c.offset);
        }
    }
    std::vector<Column> columns;
};

// Hours that the clock of the file is ahead of UTC.
double zone_of(std::string_view standard, const ReadOptions& options, RowCollector& rows)
{
    if (standard == "UTC") {
        rows.times_name_their_zone();
        return 0.0;
    }
    const double longitude = std::isnan(options.site.longitude_deg) ? rows.site().longitude_deg
                                                                    : options.site.longitude_deg;
    if (standard != "LST" || std::isnan(longitude))
        throw Error("weather: NASA POWER: the file does not say the standard of its times (UTC or "
                    "LST) and its place",
                    "Download it again, with the time standard UTC.");
    const double hours = std::round(longitude / 15.0);
    char said[120];
    std::snprintf(said, sizeof said,
                  "local solar time, that of the longitude in whole hours: UTC%+g h", hours);
    rows.note(ReadNote::Kind::Time, 0, "time", said);
    rows.site().utc_offset_h = hours;
    return hours;
}

double number_behind(std::string_view line, std::string_view word)
{
    const std::size_t at = line.find(word);
    if (at == line.npos) return kMissing;
    const auto behind = words(line.substr(at + word.size()), 2);
    return behind.empty() ? kMissing : to_number(behind.front()).value_or(kMissing);
}

void read_csv(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    std::map<std::string, std::string, std::less<>> units;
    std::string standard;
    double fill = -999.0;
    bool parameters_begin = false;
    while (const auto line = lines.next()) {
        const auto t = trimmed(*line);
        const std::string low = lower(t);
        const auto is = [&](const char* word) { return low.rfind(word, 0) == 0; };
        Site& site = rows.site();
        if (is("-end header-")) break;
        if (is("location")) {
            site.latitude_deg = number_behind(low, "latitude");
            site.longitude_deg = number_behind(low, "longitude");
        } else if (is("elevation")) {
            site.elevation_m = number_behind(low, "=");
        } else if (is("dates")) {
            for (const char* word : {"UTC", "LST"})
                if (t.ends_with(std::string("in ") + word)) standard = word;
        } else if (is("the value for missing")) {
            if (const std::size_t colon = t.rfind(':'); colon != t.npos)
                fill = to_number(t.substr(colon + 1)).value_or(fill);
        } else if (is("parameter")) {
            parameters_begin = true;
        } else if (parameters_begin) {
            const std::size_t open = t.rfind('('), close = t.rfind(')');
            if (open != t.npos && close != t.npos && close > open)
                units[std::string(t.substr(0, t.find_first_of(" \t")))] =
                    std::string(trimmed(t.substr(open + 1, close - open - 1)));
        }
    }
    const TableHeader header(lines.next().value_or(""), ',');
    const std::size_t year = header.at("year"), month = header.at("mo"), day = header.at("dy"),
                      hour = header.at("hr");
    if (hour == TableHeader::kNone || month == TableHeader::kNone || day == TableHeader::kNone)
        refuse_days();
    std::vector<std::string> names;
    for (const std::string& n : header.names()) {
        std::string upper = n;
        for (char& c : upper)
            if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
        names.push_back(std::move(upper));
    }
    std::vector<std::string> parameter_names = names;
    for (const std::size_t at : {year, month, day, hour})
        if (at < names.size()) parameter_names[at].clear();
    const Meaning meaning(parameter_names, rows, [&](const char* name) {
        const auto found = units.find(name);
        return found == units.end() ? std::string() : found->second;
    });
    const double zone_h = zone_of(standard, options, rows);
    const auto time_of = [&](const Cells& cells) -> std::optional<std::int64_t> {
        const auto y = to_integer(cell_of(cells, year)), m = to_integer(cell_of(cells, month)),
                   d = to_integer(cell_of(cells, day)), h = to_integer(cell_of(cells, hour));
        if (!(y && m && d && h && *m >= 1 && *m <= 12 && *d >= 1 && *d <= 31 && *h >= 0 && *h <= 23))
            return std::nullopt;
        return us_from_civil(
            {*y, static_cast<int>(*m), static_cast<int>(*d), static_cast<int>(*h), 0, 0.0});
    };
    const DatedRows how{.time_of = time_of, .lacks = "is not a year, month, day and hour"};
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (!rows.begin_row(row.time_us - static_cast<std::int64_t>(zone_h * 3600e6), row.line))
            return;
        for (const Column& c : meaning.columns) {
            const auto cell = cell_of(row.cells, c.at);
            auto value = number_or_none(cell);
            if (value == fill) value.reset();
            put_cell({{}, c.field, c.scale, c.offset}, cell, value, rows);
        }
    });
}

void read_json(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    const Json whole = parse_json(text);
    const auto at = [](const Json* from, const char* name) {
        return from ? from->find(name) : nullptr;
    };
    const Json* parameter = at(whole.find("properties"), "parameter");
    const Json* place = at(whole.find("geometry"), "coordinates");
    const Json* header = whole.find("header");
    const Json* about = whole.find("parameters");
    if (!parameter)
        throw Error("weather: NASA POWER: no parameters in this answer",
                    "Order hours at a point, as JSON or CSV.");
    const auto coordinate = [&](std::size_t i) {
        return place && place->items.size() > i && place->items[i].kind == Json::Kind::Number
                   ? place->items[i].number
                   : kMissing;
    };
    Site& site = rows.site();
    site.longitude_deg = coordinate(0);
    site.latitude_deg = coordinate(1);
    site.elevation_m = coordinate(2);
    const Json* fill_value = at(header, "fill_value");
    const double fill =
        fill_value && fill_value->kind == Json::Kind::Number ? fill_value->number : -999.0;
    const Json* standard = at(header, "time_standard");
    std::vector<std::string> names;
    for (const Json::Member& m : parameter->members) names.push_back(m.name);
    const Meaning meaning(names, rows, [&](const char* name) {
        const Json* unit = at(at(about, name), "units");
        return unit ? unit->text : std::string();
    });
    const double zone_h = zone_of(standard ? std::string_view(standard->text) : "", options, rows);
    // Parameters hold the same times, each its own list.
    std::map<std::string, std::vector<double>> hours;
    for (std::size_t p = 0; p < names.size(); ++p) {
        for (const Json::Member& m : parameter->members[p].value.members) {
            auto& row = hours[m.name];
            row.resize(names.size(), kMissing);
            if (m.value.kind == Json::Kind::Number) row[p] = m.value.number;
        }
    }
    for (const auto& [stamp, values] : hours) {
        if (stamp.size() != 10) refuse_days();
        const auto us = time_of_cell(stamp);  // YYYYMMDDHH
        if (!us) {
            rows.bad_row(0, "time", "'" + shown(stamp) + "' is not a year, month, day and hour");
            continue;
        }
        if (!rows.begin_row(*us - static_cast<std::int64_t>(zone_h * 3600e6), 0)) continue;
        for (const Column& c : meaning.columns) meaning.set(c.at, values[c.at], fill, rows);
    }
}

bool recognise_csv(const FileHead& head)
{
    return head.begins("-BEGIN HEADER-") && head.text.find("NASA/POWER") != head.text.npos;
}
bool recognise_json(const FileHead& head)
{
    const std::string_view begins = head.text.substr(0, 2048);
    return head.begins("{") && begins.find("\"geometry\"") != begins.npos &&
           begins.find("\"parameter\"") != begins.npos;
}

}  // namespace

extern const Reader nasa_power_reader;
const Reader nasa_power_reader{"NASA POWER CSV", "NASA POWER, hours at a point", recognise_csv,
                               read_csv};
extern const Reader nasa_power_json_reader;
const Reader nasa_power_json_reader{"NASA POWER JSON", "NASA POWER, hours at a point",
                                    recognise_json, read_json};

}  // namespace petrichor::weather
