// PVGIS CSV (typical year or series): a header block, a table that begins with time(UTC), a footer.
// No precipitation. Times like 20180101:0000; the year of a typical year jumps.
#include <cmath>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/json.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

struct Column {
    const char* name;
    Field field;
    double offset;
};
constexpr Column kColumns[] = {
    {"t2m", Field::AirTemp, kZeroCelsiusK},
    {"rh", Field::RelHumidity, 0},
    {"g(h)", Field::Shortwave, 0},
    {"gb(n)", Field::Direct, 0},
    {"gd(h)", Field::Diffuse, 0},
    {"ir(h)", Field::Longwave, 0},
    {"ws10m", Field::Wind, 0},
    {"wd10m", Field::WindFrom, 0},
    {"sp", Field::Pressure, 0},
};

bool parse_when(std::string_view text, CivilTime& when)
{
    if (text.size() < 13 || text[8] != ':') return false;
    const auto year = to_integer(text.substr(0, 4)), month = to_integer(text.substr(4, 2)),
               day = to_integer(text.substr(6, 2));
    const auto hour = to_integer(text.substr(9, 2)), minute = to_integer(text.substr(11, 2));
    if (!year || !month || !day || !hour || !minute) return false;
    if (*month < 1 || *month > 12 || *hour < 0 || *hour > 24 || *minute < 0 || *minute > 59)
        return false;
    when = {*year,
            static_cast<int>(*month),
            static_cast<int>(*day),
            static_cast<int>(*hour),
            static_cast<int>(*minute),
            0.0};
    return true;
}

}  // namespace

static void read_pvgis(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    std::vector<std::string_view> names;
    double sun_offset_h = 0.0;  // radiation holds this long after the time of its row
    while (const auto line = lines.next()) {
        const std::string low = lower(*line);
        const auto colon = line->rfind(':');
        const double value = colon == std::string_view::npos
                                 ? kMissing
                                 : to_number(line->substr(colon + 1)).value_or(kMissing);
        if (low.rfind("latitude", 0) == 0)
            rows.site().latitude_deg = value;
        else if (low.rfind("longitude", 0) == 0)
            rows.site().longitude_deg = value;
        else if (low.rfind("elevation", 0) == 0)
            rows.site().elevation_m = value;
        else if (low.rfind("irradiance time offset", 0) == 0 && std::abs(value) <= 1.0)
            sun_offset_h = value;
        else if (low.rfind("time", 0) == 0) {
            names = split(*line, ',', 64);
            break;
        }
    }
    if (names.empty())
        throw Error("weather: PVGIS: there is no line that begins with time(UTC)",
                    "Download the file again as CSV.");
    std::vector<const Column*> meaning(names.size(), nullptr);
    for (std::size_t i = 0; i < names.size(); ++i) {
        for (const Column& c : kColumns) {
            if (lower(names[i]) == c.name) meaning[i] = &c;
        }
    }
    std::vector<std::string> unread;
    for (std::size_t i = 1; i < names.size(); ++i)
        if (!meaning[i]) unread.emplace_back(names[i]);
    rows.unread_columns(unread);
    Lines again = lines;
    TypicalYear typical;
    std::size_t last = 0;  // line of the table; the footer below it explains the columns
    while (const auto line = again.next()) {
        CivilTime when;
        if (!parse_when(*line, when)) continue;
        typical.watch(when.year, when.month);
        last = again.number();
    }
    typical.decide(rows);
    rows.note(ReadNote::Kind::Info, 0, "precip", "PVGIS has no precipitation");
    if (sun_offset_h != 0.0) {
        rows.note(ReadNote::Kind::Time, 0, "sw_down",
                  std::string("irradiance is instantaneous ")
                      .append(std::to_string(std::lround(sun_offset_h * 60.0)))
                      .append(" min after the time of its row; moved to the row along a line"));
        for (const Field f : {Field::Shortwave, Field::Direct, Field::Diffuse})
            rows.holds_after(f, sun_offset_h * 3600.0);
    }
    std::vector<std::string_view> f;
    while (const auto line = lines.next()) {
        if (lines.number() > last) break;
        if (trimmed(*line).empty()) continue;
        split(*line, ',', f, 64);
        CivilTime when;
        if (!parse_when(f[0], when)) {
            rows.bad_row(lines.number(), "time", "'" + shown(f[0]) + "' is not YYYYMMDD:HHMM");
            continue;
        }
        if (f.size() != names.size()) {
            rows.wrong_columns(lines.number(), f.size(), names.size());
            continue;
        }
        if (typical.typical && when.month == 2 && when.day == 29) {
            rows.leap_day_left_out(lines.number());
            continue;
        }
        when.year = typical.of(when.year);
        const auto us = us_from_civil(when);
        if (!us) {
            rows.bad_row(lines.number(), "time", "'" + shown(f[0]) + "': there is no such day");
            continue;
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        for (std::size_t i = 1; i < f.size(); ++i) {
            if (!meaning[i]) continue;
            const auto value = to_number(f[i]);
            if (!value)
                rows.unreadable(meaning[i]->field, f[i]);
            else
                rows.set(meaning[i]->field, *value + meaning[i]->offset);
        }
    }
}

namespace {

// The same as JSON: inputs.location, then outputs.tmy_hourly or outputs.hourly, an object a row.
void read_json(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    const Json all = parse_json(text);
    const Json* inputs = all.find("inputs");
    const Json* location = inputs ? inputs->find("location") : nullptr;
    const auto number = [](const Json* object, const char* key) {
        const Json* value = object ? object->find(key) : nullptr;
        return value && value->kind == Json::Kind::Number ? value->number : kMissing;
    };
    rows.site().latitude_deg = number(location, "latitude");
    rows.site().longitude_deg = number(location, "longitude");
    rows.site().elevation_m = number(location, "elevation");
    const double sun_offset_h = number(location, "irradiance_time_offset");
    const Json* outputs = all.find("outputs");
    const Json* hours = outputs ? outputs->find("tmy_hourly") : nullptr;
    if (!hours && outputs) hours = outputs->find("hourly");
    if (!hours || hours->kind != Json::Kind::Array) {
        throw Error("weather: PVGIS JSON: there is no outputs.tmy_hourly and no outputs.hourly",
                    "Ask PVGIS for hourly data or a typical year.");
    }
    const auto when_of = [](const Json& row, CivilTime& when) {
        const Json* time = row.find("time(UTC)");
        if (!time) time = row.find("time");
        return time && time->kind == Json::Kind::String && parse_when(time->text, when);
    };
    TypicalYear typical;
    for (const Json& row : hours->items) {
        CivilTime when;
        if (when_of(row, when)) typical.watch(when.year, when.month);
    }
    typical.decide(rows);
    rows.note(ReadNote::Kind::Info, 0, "precip", "PVGIS has no precipitation");
    if (std::abs(sun_offset_h) <= 1.0 && sun_offset_h != 0.0) {
        for (const Field f : {Field::Shortwave, Field::Direct, Field::Diffuse})
            rows.holds_after(f, sun_offset_h * 3600.0);
    }
    for (const Json& row : hours->items) {
        CivilTime when;
        if (!when_of(row, when)) {
            rows.bad_row(row.line, "time", "the row has no time as YYYYMMDD:HHMM");
            continue;
        }
        if (typical.typical && when.month == 2 && when.day == 29) continue;
        when.year = typical.of(when.year);
        const auto us = us_from_civil(when);
        if (!us) {
            rows.bad_row(row.line, "time", "there is no such day");
            continue;
        }
        if (!rows.begin_row(*us, row.line)) continue;
        for (const Json::Member& member : row.members) {
            const std::string name = lower(member.name);
            for (const Column& c : kColumns) {
                if (name != c.name) continue;
                if (member.value.kind == Json::Kind::Number)
                    rows.set(c.field, member.value.number + c.offset);
                else
                    rows.missing(c.field);
            }
        }
    }
}

bool recognise_json(const FileHead& head)
{
    return head.begins("{") && head.text.find("\"inputs\"") != head.text.npos &&
           head.text.find("\"outputs\"") != head.text.npos;
}

bool recognise(const FileHead& head)
{
    return head.begins("Latitude (decimal degrees)");
}

}  // namespace

extern const Reader pvgis_json_reader;
const Reader pvgis_json_reader{"PVGIS JSON", "European Commission, typical year or series",
                               recognise_json, read_json};

extern const Reader pvgis_reader;
const Reader pvgis_reader{"PVGIS CSV", "European Commission, typical year or series", recognise,
                          read_pvgis};

}  // namespace petrichor::weather
