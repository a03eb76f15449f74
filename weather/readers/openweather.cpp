// OpenWeather: the CSV and JSON of its history in bulk, and the lists of its history, forecast and
// One Call interfaces. Times are seconds since 1970. Kelvin, Celsius or Fahrenheit are chosen when
// the file is ordered and not written down: values above 150 are Kelvin, else temperature, dew
// point and humidity tell. Rain and snow are mm of the hour (or three) before their row, and absent
// where none fell. An hour with two kinds of weather stands there twice.
#include <cmath>
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

struct Hour {
    std::int64_t time_us = 0;
    std::size_t line = 0;
    double temp = kMissing, dew = kMissing, humidity = kMissing, sea_hpa = kMissing,
           ground_hpa = kMissing, wind = kMissing, wind_from = kMissing, clouds = kMissing,
           visibility = kMissing, rain_1h = kMissing, rain_3h = kMissing, snow_1h = kMissing,
           snow_3h = kMissing, code = kMissing;
};
struct Name {
    const char* csv;
    const char* json;  // path below an hour, parts between points; two kinds of answers, two paths
    const char* json_too;
    double Hour::*value;
};
constexpr Name kNames[] = {{"temp", "main.temp", "temp", &Hour::temp},
                           {"dew_point", "main.dew_point", "dew_point", &Hour::dew},
                           {"humidity", "main.humidity", "humidity", &Hour::humidity},
                           {"pressure", "main.pressure", "pressure", &Hour::sea_hpa},
                           {"grnd_level", "main.grnd_level", "", &Hour::ground_hpa},
                           {"wind_speed", "wind.speed", "wind_speed", &Hour::wind},
                           {"wind_deg", "wind.deg", "wind_deg", &Hour::wind_from},
                           {"clouds_all", "clouds.all", "clouds", &Hour::clouds},
                           {"visibility", "visibility", "", &Hour::visibility},
                           {"rain_1h", "rain.1h", "", &Hour::rain_1h},
                           {"rain_3h", "rain.3h", "", &Hour::rain_3h},
                           {"snow_1h", "snow.1h", "", &Hour::snow_1h},
                           {"snow_3h", "snow.3h", "", &Hour::snow_3h},
                           {"weather_id", "weather.id", "", &Hour::code}};

AirScale::Scale scale_of(const std::vector<Hour>& hours)
{
    constexpr double kKelvin = 150.0;  // no air is as warm in C or F
    bool any = false, kelvin = true;
    AirScale air;
    for (const Hour& h : hours) {
        if (std::isnan(h.temp)) continue;
        any = true;
        kelvin = kelvin && h.temp > kKelvin;
        air.add(h.temp, h.dew, h.humidity);
    }
    return any && kelvin ? AirScale::Scale::Kelvin : air.scale();
}

// Codes 2xx thunder, 3xx drizzle, 5xx rain, 6xx snow: something falls.
bool falls(double code)
{
    return (code >= 200.0 && code < 400.0) || (code >= 500.0 && code < 700.0);
}

void put_precip(const Hour& h, RowCollector& rows)
{
    const bool hour = !std::isnan(h.rain_1h) || !std::isnan(h.snow_1h);
    const bool three = !std::isnan(h.rain_3h) || !std::isnan(h.snow_3h);
    const auto or_none = [](double x) { return std::isnan(x) ? 0.0 : x; };
    const double rain = or_none(hour ? h.rain_1h : h.rain_3h),
                 snow = or_none(hour ? h.snow_1h : h.snow_3h);
    if (hour || three) {
        rows.fell_before(Field::Precip, rain + snow, hour ? 1.0 : 3.0);
        if (rain + snow > 0.0) rows.set(Field::SnowShare, snow / (rain + snow));
    } else if (falls(h.code)) {
        rows.missing(Field::Precip);
    } else {
        rows.fell_before(Field::Precip, 0.0, 1.0);
    }
}

void put(const std::vector<Hour>& hours, RowCollector& rows, const ReadOptions& options)
{
    const AirScale::Scale scale = scale_of(hours);
    if (scale == AirScale::Scale::Unknown)
        throw Error("weather: OpenWeather: the file names no units, and its temperatures, dew "
                    "points and humidities do not tell them",
                    "Order it with units=standard (Kelvin), or with the dew point.");
    const bool us = scale == AirScale::Scale::Fahrenheit;
    rows.note(ReadNote::Kind::Info, 0, "units",
              scale == AirScale::Scale::Kelvin ? "K and m/s, by the numbers"
              : us ? "F and mph: temperature, dew point and humidity fit Fahrenheit alone"
                   : "C and m/s: temperature, dew point and humidity fit Celsius alone");
    const ToKelvin kelvin = to_kelvin(scale);
    const Site& site = rows.site();
    const double elevation =
        std::isnan(options.site.elevation_m) ? site.elevation_m : options.site.elevation_m;
    rows.note(ReadNote::Kind::Info, 0, "pressure",
              "grnd_level where it is given; else that of sea level, brought to the elevation "
              "where one is given");
    rows.join_same_times();
    rows.times_name_their_zone();
    for (const Hour& h : hours) {
        if (!rows.begin_row(h.time_us, h.line)) continue;
        const double air_k = h.temp * kelvin.scale + kelvin.offset;
        const auto set = [&](Field field, double si) { put_value(field, si, rows); };
        set(Field::AirTemp, air_k);
        set(Field::DewPoint, h.dew * kelvin.scale + kelvin.offset);
        set(Field::RelHumidity, h.humidity);
        set(Field::Pressure, std::isnan(h.ground_hpa)
                                 ? station_pressure_pa(h.sea_hpa * 100.0, elevation, air_k)
                                 : h.ground_hpa * 100.0);
        set(Field::Wind, h.wind * (us ? 0.44704 : 1.0));
        set(Field::WindFrom, h.wind_from);
        set(Field::Cloud, h.clouds * 0.01);
        set(Field::Visibility, h.visibility);
        put_precip(h, rows);
    }
}

void read_csv(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ',');
    const std::size_t dt = header.at("dt"), zone = header.at("timezone"), lat = header.at("lat"),
                      lon = header.at("lon"), city = header.at("city_name");
    for (const char* known : {"dt_iso", "weather_main", "weather_description", "weather_icon"})
        (void)header.at(known);
    std::vector<NumberColumn<Hour>> columns;
    for (const Name& n : kNames) columns.push_back({n.csv, n.value});
    NumberColumns<Hour> numbers(header, columns, rows);
    rows.unread_columns(header.unread());
    bool others = false;
    std::string place;
    std::vector<Hour> hours;
    const DatedRows how{.time_of = [&](const Cells& cells) -> std::optional<std::int64_t> {
                            const auto seconds = to_integer(cell_of(cells, dt));
                            if (!seconds || std::abs(*seconds) > 20000000000LL) return std::nullopt;
                            return *seconds * 1000000;
                        },
                        .lacks = "has no dt"};
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        // One file may hold several places, one behind the other.
        std::string where(cell_of(row.cells, lat));
        where.append(" ").append(cell_of(row.cells, lon));
        if (place.empty()) {
            place = where;
            Site& site = rows.site();
            site.latitude_deg = to_number(cell_of(row.cells, lat)).value_or(kMissing);
            site.longitude_deg = to_number(cell_of(row.cells, lon)).value_or(kMissing);
            site.name = shown(cell_of(row.cells, city));
            if (const auto s = to_number(cell_of(row.cells, zone)); s && std::abs(*s) <= 14.0 * 3600.0)
                site.utc_offset_h = *s / 3600.0;
        }
        if (where != place) {
            others = true;
            return;
        }
        Hour& h = hours.emplace_back();
        h.time_us = row.time_us;
        h.line = row.line;
        numbers.read(row.cells, h.line, h);
    });
    if (others)
        rows.note(ReadNote::Kind::Warning, 0, "station",
                  "several places in the file, only the first, " + rows.site().name +
                      ", is used");
    put(hours, rows, options);
}

double number_at(const Json& from, std::string_view path)
{
    const Json* value = &from;
    while (!path.empty()) {
        const std::size_t point = std::min(path.find('.'), path.size());
        if (value->kind == Json::Kind::Array)
            value = value->items.empty() ? nullptr : &value->items.front();
        if (value) value = value->find(path.substr(0, point));
        if (!value) return kMissing;
        path.remove_prefix(std::min(point + 1, path.size()));
    }
    return value->kind == Json::Kind::Number ? value->number : kMissing;
}

void read_json(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    const Json whole = parse_json(text);
    const Json* list = whole.kind == Json::Kind::Array ? &whole : whole.find("list");
    const bool one_call = !list;
    if (one_call) list = whole.find("hourly");
    if (!list || list->items.empty())
        throw Error("weather: OpenWeather: no hours in this answer",
                    "Give an answer with a list of hours: history, forecast, or hourly of One Call.");
    // Of the place: beside the hours, in `city`, or in every hour of the bulk file.
    const Json& first = list->items.front();
    const auto of_place = [&](const char* at_top, const char* in_city, const char* zone) {
        double value = number_at(whole.kind == Json::Kind::Object ? whole : first, at_top);
        if (std::isnan(value)) value = number_at(whole, in_city);
        return std::isnan(value) && *zone ? number_at(whole, zone) : value;
    };
    Site& site = rows.site();
    site.latitude_deg = of_place("lat", "city.coord.lat", "");
    site.longitude_deg = of_place("lon", "city.coord.lon", "");
    const double zone_s = of_place("timezone", "city.timezone", "timezone_offset");
    if (std::abs(zone_s) <= 14.0 * 3600.0) site.utc_offset_h = zone_s / 3600.0;
    if (const Json* name = first.find("city_name")) site.name = shown(name->text);
    std::vector<Hour> hours;
    for (const Json& item : list->items) {
        const double dt = number_at(item, "dt");
        if (!(std::abs(dt) < 2e10)) {
            rows.bad_row(item.line, "time", "an hour has no dt");
            continue;
        }
        const double lat = number_at(item, "lat"), lon = number_at(item, "lon");
        if (!std::isnan(lat) && (lat != site.latitude_deg || lon != site.longitude_deg))
            throw Error("weather: OpenWeather: several places in one file",
                        "Give one file a place.");
        Hour& h = hours.emplace_back();
        h.time_us = static_cast<std::int64_t>(dt) * 1000000;
        h.line = item.line;
        for (const Name& n : kNames) {
            h.*n.value = number_at(item, n.json);
            if (std::isnan(h.*n.value) && *n.json_too) h.*n.value = number_at(item, n.json_too);
        }
    }
    put(hours, rows, options);
}

bool recognise_csv(const FileHead& head)
{
    return head.has_columns({"dt", "dt_iso", "feels_like", "clouds_all"});
}
bool recognise_json(const FileHead& head)
{
    return (head.begins("{") || head.begins("[")) && head.text.find("\"dt\"") != head.text.npos &&
           head.text.find("\"feels_like\"") != head.text.npos;
}

}  // namespace

extern const Reader openweather_reader;
const Reader openweather_reader{"OpenWeather CSV", "OpenWeather, history in bulk", recognise_csv,
                                read_csv};
extern const Reader openweather_json_reader;
const Reader openweather_json_reader{"OpenWeather JSON",
                                     "OpenWeather, history, forecast and One Call", recognise_json,
                                     read_json};

}  // namespace petrichor::weather
