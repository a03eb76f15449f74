// Weather Underground, answers of its interface for private stations (v2/pws): history/all and
// history/hourly, observations/all/1day and hourly/7day, and current ones put together. What has units
// stands in an object that is called after them; rain is a count since midnight of the place, pressure
// that of the sea.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/json.h"
#include "weather/readers/rain_count.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

constexpr double kMile_h_m_s = 0.44704, kKilometre_h_m_s = 1.0 / 3.6, kFoot_m = 0.3048;
struct Units {
    const char* name;
    bool fahrenheit;
    double wind_m_s, pressure_pa, rain_mm, height_m;
};
constexpr Units kUnits[] = {
    {"metric", false, kKilometre_h_m_s, 100.0, 1.0, 1.0},
    {"imperial", true, kMile_h_m_s, 3386.389, 25.4, kFoot_m},
    {"metric_si", false, 1.0, 100.0, 1.0, 1.0},
    {"uk_hybrid", false, kMile_h_m_s, 100.0, 1.0, kMissing},  // no word on heights
};
// Above, the highest sun of a row is not the row's.
constexpr double kShortRow_h = 0.26;

double number_in(const Json& object, const char* name)
{
    const Json* value = object.find(name);
    return value && value->kind == Json::Kind::Number ? value->number : kMissing;
}
// Of now, or the mean of a row of the history.
double either(const Json& object, const char* now, const char* mean)
{
    const double value = number_in(object, now);
    return std::isnan(value) ? number_in(object, mean) : value;
}
const std::string& text_in(const Json& object, const char* name)
{
    static const std::string none;
    const Json* value = object.find(name);
    return value && value->kind == Json::Kind::String ? value->text : none;
}

std::optional<std::int64_t> time_of(const Json& item)
{
    if (const auto us = us_from_iso(text_in(item, "obsTimeUtc"))) return us;
    const double epoch_s = number_in(item, "epoch");
    if (!(std::abs(epoch_s) < 2e10)) return std::nullopt;
    return static_cast<std::int64_t>(epoch_s) * 1000000;
}

struct Row {
    std::int64_t time_us = 0;
    const Json* item = nullptr;
    const Json* values = nullptr;  // those with units
    const Units* units = nullptr;
};

Row row_of(const Json& item)
{
    Row row;
    row.item = &item;
    for (const Units& u : kUnits) {
        const Json* found = item.find(u.name);
        if (!found || found->kind != Json::Kind::Object) continue;
        row.values = found;
        row.units = &u;
    }
    return row;
}

void put_row(const Row& row, double elevation_m, bool take_sun, RainCount& rain, RowCollector& rows)
{
    const Json &item = *row.item, &values = *row.values;
    const Units& u = *row.units;
    const auto kelvin = [&](double t) {
        return (u.fahrenheit ? (t - 32.0) * 5.0 / 9.0 : t) + kZeroCelsiusK;
    };
    put_value(Field::AirTemp, kelvin(either(values, "temp", "tempAvg")), rows);
    put_value(Field::DewPoint, kelvin(either(values, "dewpt", "dewptAvg")), rows);
    put_value(Field::RelHumidity, either(item, "humidity", "humidityAvg"), rows);
    put_value(Field::Wind, either(values, "windSpeed", "windspeedAvg") * u.wind_m_s, rows);
    put_value(Field::WindFrom, either(item, "winddir", "winddirAvg"), rows);
    double sea = number_in(values, "pressure");
    if (std::isnan(sea))
        sea = 0.5 * (number_in(values, "pressureMax") + number_in(values, "pressureMin"));
    put_value(Field::Pressure, station_pressure_pa(sea * u.pressure_pa, elevation_m, kMissing), rows);
    if (take_sun)
        put_value(Field::Shortwave, either(item, "solarRadiation", "solarRadiationHigh"), rows);
    rain.put(number_in(values, "precipTotal") * u.rain_mm, row.time_us, rows);
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    const Json whole = parse_json(text);
    const Json* list = whole.kind == Json::Kind::Array ? &whole : whole.find("observations");
    if (!list && whole.find("summaries"))
        throw Error("weather: Weather Underground: this answer holds days",
                    "Ask for history/all or history/hourly.");
    if (!list || list->items.empty())
        throw Error("weather: Weather Underground: no observations in this answer",
                    "Give an answer of history/all, history/hourly or observations/all.");
    OneStation stations(options.station);
    std::vector<Row> found;
    std::vector<std::int64_t> times;
    bool sun_now = false, sun_high = false;
    for (const Json& item : list->items) {
        const std::string& who = text_in(item, "stationID");
        if (stations.is_other(who)) continue;
        Row row = row_of(item);
        const auto us = time_of(item);
        if (!us || !row.values) {
            rows.bad_row(item.line, us ? "units" : "time",
                         us ? "an observation has none of metric, imperial, metric_si, uk_hybrid"
                            : "an observation has no obsTimeUtc");
            continue;
        }
        row.time_us = *us;
        found.push_back(row);
        sun_now = sun_now || !std::isnan(number_in(item, "solarRadiation"));
        sun_high = sun_high || !std::isnan(number_in(item, "solarRadiationHigh"));
    }
    stations.check("Weather Underground", "by its stationID");
    std::stable_sort(found.begin(), found.end(),
                     [](const Row& a, const Row& b) { return a.time_us < b.time_us; });
    for (const Row& row : found) times.push_back(row.time_us);
    if (times.size() > 1 && usual_step_us(times) > 12 * 3600LL * 1000000)
        throw Error("weather: Weather Underground: these observations are days",
                    "Ask for history/all or history/hourly.");

    Site& site = rows.site();
    site.name = shown(stations.name());
    double elevation_m = options.site.elevation_m;
    for (const Row& row : found) {
        const auto keep = [](double& value, double seen) {
            if (std::isnan(value)) value = seen;
        };
        keep(site.latitude_deg, number_in(*row.item, "lat"));
        keep(site.longitude_deg, number_in(*row.item, "lon"));
        keep(site.elevation_m, number_in(*row.values, "elev") * row.units->height_m);
        const auto local_us = us_from_iso(text_in(*row.item, "obsTimeLocal"));
        if (&row == &found.front() && local_us)
            if (const double h = std::round(static_cast<double>(*local_us - row.time_us) / 900e6) / 4.0; std::abs(h) <= 14.0)
                site.utc_offset_h = h;
    }
    if (std::isnan(elevation_m)) elevation_m = site.elevation_m;
    rows.times_name_their_zone();
    rows.note(ReadNote::Kind::Info, 0, "pressure",
              std::isnan(elevation_m) ? "given for sea level; give the elevation to bring it down"
                                      : "given for sea level, brought to the station");
    rows.note(ReadNote::Kind::Info, 0, "precip",
              "what the count of the day rises by from row to row");
    const double step_h = static_cast<double>(usual_step_us(times)) / 3600e6;
    const bool take_sun = sun_now || step_h <= kShortRow_h;
    if (sun_high && !take_sun)
        rows.note(ReadNote::Kind::Warning, 0, "solarRadiationHigh",
                  "is the highest of rows of " + std::to_string(std::lround(step_h * 60.0)) +
                      " min, not their mean: not read (history/all has shorter rows)");
    RainCount rain;
    for (const Row& row : found)
        if (rows.begin_row(row.time_us, row.item->line))
            put_row(row, elevation_m, take_sun, rain, rows);
}

bool recognise(const FileHead& head)
{
    const auto has = [&](std::string_view word) { return head.text.find(word) != head.text.npos; };
    return (head.begins("{") || head.begins("[")) && has("\"stationID\"") &&
           (has("\"metric\"") || has("\"imperial\"") || has("\"metric_si\"") ||
            has("\"uk_hybrid\""));
}

}  // namespace

extern const Reader wunderground_json_reader;
const Reader wunderground_json_reader{"Weather Underground JSON",
                                      "private stations, history and observations of api v2",
                                      recognise, read};

}  // namespace petrichor::weather
