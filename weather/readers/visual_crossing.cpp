// Visual Crossing, hours as CSV (datetime,temp,feelslike,..) and JSON (days of hours). The service
// lets people choose units and writes none down: temperature, dew point and humidity together tell
// Fahrenheit (unit group us: also mph, inches, miles) from Celsius, which two groups share; km/h and
// mm are taken then, with a warning. Amounts are of the time that begins at their row; pressure is
// that of sea level. Times of CSV are the clock of the place, JSON has seconds since 1970 beside.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "weather/readers/air_scale.h"
#include "weather/readers/formats.h"
#include "weather/readers/json.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

// An hour of either kind of file, by the names that both use.
struct Hour {
    std::int64_t time_us = 0;
    std::size_t line = 0;
    double temp = kMissing, dew = kMissing, humidity = kMissing, precip = kMissing,
           snow_depth = kMissing, wind = kMissing, wind_from = kMissing, sea_level = kMissing,
           cloud = kMissing, visibility = kMissing, solar = kMissing;
    bool rain = false, snow = false;  // of preciptype
};
using Name = NumberColumn<Hour>;
constexpr Name kNames[] = {{"temp", &Hour::temp},
                           {"dew", &Hour::dew},
                           {"humidity", &Hour::humidity},
                           {"precip", &Hour::precip},
                           {"snowdepth", &Hour::snow_depth},
                           {"windspeed", &Hour::wind},
                           {"winddir", &Hour::wind_from},
                           {"sealevelpressure", &Hour::sea_level},
                           {"cloudcover", &Hour::cloud},
                           {"visibility", &Hour::visibility},
                           {"solarradiation", &Hour::solar}};

void add_kind(Hour& hour, std::string_view kind)
{
    hour.snow = hour.snow || kind.find("snow") != kind.npos || kind.find("ice") != kind.npos;
    hour.rain = hour.rain || kind.find("rain") != kind.npos;  // also freezingrain
}

struct Units {
    ToKelvin kelvin;
    double wind, precip, depth, visibility;
};

Units units_of(const std::vector<Hour>& hours, RowCollector& rows)
{
    AirScale air;
    for (const Hour& h : hours) air.add(h.temp, h.dew, h.humidity);
    const AirScale::Scale scale = air.scale();
    if (scale == AirScale::Scale::Fahrenheit) {
        rows.note(ReadNote::Kind::Info, 0, "units",
                  "the file names none; temperature, dew point and humidity fit Fahrenheit alone: "
                  "the service's unit group us (mph, inches, miles)");
        return {to_kelvin(scale), 0.44704, 25.4, 0.0254, 1609.344};
    }
    if (scale == AirScale::Scale::Celsius) {
        rows.note(ReadNote::Kind::Warning, 0, "units",
                  "the file names none; temperature, dew point and humidity fit Celsius alone: "
                  "taken as the service's unit group metric (km/h, mm, km, cm of snow); in its "
                  "group uk wind is mph and visibility miles");
        return {to_kelvin(scale), 1.0 / 3.6, 1.0, 0.01, 1000.0};
    }
    throw Error(scale == AirScale::Scale::Kelvin
                    ? "weather: Visual Crossing: this file is in the unit group base (Kelvin)"
                    : "weather: Visual Crossing: the file names no units, and its temperatures, "
                      "dew points and humidities do not tell them",
                "Order it as hours with temp, dew and humidity, unit group metric or us.");
}

void put(const std::vector<Hour>& hours, RowCollector& rows, const ReadOptions& options)
{
    const Units units = units_of(hours, rows);
    std::vector<std::int64_t> times;
    for (const Hour& h : hours)
        if (times.empty() || h.time_us > times.back()) times.push_back(h.time_us);
    const double step_s = static_cast<double>(usual_step_us(times)) * 1e-6;
    const double elevation = options.site.elevation_m;
    rows.note(ReadNote::Kind::Info, 0, "pressure",
              std::isnan(elevation) ? "given for sea level; give the elevation to bring it down"
                                    : "given for sea level, brought to the station");
    rows.note(ReadNote::Kind::Info, 0, "precip",
              "amounts are for the interval that begins at their row");
    for (const Hour& h : hours) {
        if (!rows.begin_row(h.time_us, h.line)) continue;
        const double air_k = h.temp * units.kelvin.scale + units.kelvin.offset;
        const auto set = [&](Field field, double si) { put_value(field, si, rows); };
        set(Field::AirTemp, air_k);
        set(Field::DewPoint, h.dew * units.kelvin.scale + units.kelvin.offset);
        set(Field::RelHumidity, h.humidity);
        set(Field::Precip, h.precip * units.precip / step_s);
        set(Field::SnowDepth, h.snow_depth * units.depth);
        set(Field::Wind, h.wind * units.wind);
        set(Field::WindFrom, h.wind_from);
        set(Field::Pressure, station_pressure_pa(h.sea_level * 100.0, elevation, air_k));
        set(Field::Cloud, h.cloud * 0.01);
        set(Field::Visibility, h.visibility * units.visibility);
        set(Field::Shortwave, h.solar);
        if (h.rain || h.snow) rows.set(Field::SnowShare, h.rain ? (h.snow ? 0.5 : 0.0) : 1.0);
    }
}

[[noreturn]] void refuse_days()
{
    throw Error("weather: Visual Crossing: this file holds days, no hours",
                "Order hours (include=hours, or Hourly on the page of the query).");
}

void read_csv(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ',');
    if (header.has("tempmax")) refuse_days();
    const std::size_t stamp = header.at("datetime"), kind = header.at("preciptype"),
                      latitude = header.at("latitude"), longitude = header.at("longitude");
    NumberColumns<Hour> numbers(header, kNames, rows);
    rows.unread_columns(header.unread());
    note_unknown_zone(rows, options,
                      "that of the place, with summer time where it has any (JSON has UTC beside)");
    std::vector<Hour> hours;
    const DatedRows how{
        .time_of = [&](const Cells& cells) { return us_from_iso(cell_of(cells, stamp)); }};
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        Hour& h = hours.emplace_back();
        h.time_us = row.time_us;
        h.line = row.line;
        numbers.read(row.cells, h.line, h);
        add_kind(h, cell_of(row.cells, kind));
        if (std::isnan(rows.site().latitude_deg)) {
            rows.site().latitude_deg = to_number(cell_of(row.cells, latitude)).value_or(kMissing);
            rows.site().longitude_deg = to_number(cell_of(row.cells, longitude)).value_or(kMissing);
        }
    });
    put(hours, rows, options);
}

double number_of(const Json* value)
{
    return value && value->kind == Json::Kind::Number ? value->number : kMissing;
}

void read_json(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    const Json whole = parse_json(text);
    Site& site = rows.site();
    site.latitude_deg = number_of(whole.find("latitude"));
    site.longitude_deg = number_of(whole.find("longitude"));
    const double zone_h = number_of(whole.find("tzoffset"));
    if (std::abs(zone_h) <= 14.0) site.utc_offset_h = zone_h;
    if (const Json* place = whole.find("resolvedAddress")) site.name = shown(place->text);
    rows.times_name_their_zone();  // seconds since 1970
    std::vector<Hour> hours;
    const Json* days = whole.find("days");
    bool any = false;
    for (const Json& day : days ? days->items : std::vector<Json>{}) {
        const Json* of_day = day.find("hours");
        if (!of_day) continue;
        any = true;
        for (const Json& item : of_day->items) {
            const double epoch = number_of(item.find("datetimeEpoch"));
            if (!(std::abs(epoch) < 2e10)) {
                rows.bad_row(item.line, "time", "an hour has no datetimeEpoch");
                continue;
            }
            Hour& h = hours.emplace_back();
            h.time_us = static_cast<std::int64_t>(epoch) * 1000000;
            h.line = item.line;
            for (const Name& n : kNames) h.*n.value = number_of(item.find(n.name));
            // The CSV's sealevelpressure.
            if (std::isnan(h.sea_level)) h.sea_level = number_of(item.find("pressure"));
            if (const Json* kind = item.find("preciptype"))
                for (const Json& word : kind->items) add_kind(h, word.text);
        }
    }
    if (!any) refuse_days();
    put(hours, rows, options);
}

bool recognise_csv(const FileHead& head)
{
    // People choose columns too: one that nobody else names so is enough.
    if (!head.has_columns({"datetime", "temp"})) return false;
    for (const char* own : {"feelslike", "sealevelpressure", "preciptype", "precipprob",
                            "solarradiation", "solarenergy", "severerisk", "tempmax"})
        if (head.has_columns({own})) return true;
    return false;
}
bool recognise_json(const FileHead& head)
{
    return head.begins("{") && head.text.find("\"resolvedAddress\"") != head.text.npos &&
           head.text.find("\"days\"") != head.text.npos;
}

}  // namespace

extern const Reader visual_crossing_reader;
const Reader visual_crossing_reader{"Visual Crossing CSV", "Visual Crossing, hours", recognise_csv,
                                    read_csv};
extern const Reader visual_crossing_json_reader;
const Reader visual_crossing_json_reader{"Visual Crossing JSON", "Visual Crossing, days of hours",
                                         recognise_json, read_json};

}  // namespace petrichor::weather
