// Open-Meteo, JSON and CSV. Units are beside the names; hourly sums and radiation belong to the
// hour before their time; times are local with an offset for the whole file. Names with and without
// underscores.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/json.h"
#include "weather/readers/text.h"
#include "weather/readers/units.h"
#include "weather/readers/unknown_json.h"

namespace petrichor::weather {

namespace {

struct OpenMeteoColumn {
    std::optional<ColumnMeaning> meaning;
    bool sea_level = false;  // pressure_msl
    bool showers = false;
};

OpenMeteoColumn meaning_of(const std::string& name, const std::string& unit)
{
    OpenMeteoColumn c;
    const std::string low = lower(name);
    if (low == "pressure_msl") {
        c.sea_level = true;
        c.meaning = column_meaning("pressure", unit);
    } else if (low == "showers") {
        c.showers = true;
        c.meaning = column_meaning("rain", unit);
    } else if (low == "snowfall" || low == "rain" || low == "precipitation" ||
               low == "snow_depth" || low == "visibility" || low == "surface_pressure" ||
               low == "temperature_2m" || low == "shortwave_radiation" ||
               low == "diffuse_radiation" || low == "direct_normal_irradiance" ||
               low == "cloud_cover" || low == "cloudcover" || low == "wind_speed_10m" ||
               low == "windspeed_10m" || low == "wind_direction_10m" ||
               low == "winddirection_10m" || low == "relative_humidity_2m" ||
               low == "relativehumidity_2m" || low == "dew_point_2m" || low == "dewpoint_2m") {
        c.meaning = column_meaning(low, unit);
    }
    return c;
}

// Sums of one row; phases are kept apart only when the file has snowfall.
struct RowSums {
    double total = kMissing, rain = kMissing, showers = kMissing, snow = kMissing;
    void add(const OpenMeteoColumn& c, double amount)
    {
        if (c.showers)
            showers = amount;
        else if (c.meaning->field == Field::Precip)
            total = amount;
        else if (c.meaning->field == Field::Rain)
            rain = amount;
        else
            snow = amount;
    }
    void put(RowCollector& rows) const
    {
        const double liquid =
            (std::isnan(rain) ? 0.0 : rain) + (std::isnan(showers) ? 0.0 : showers);
        if (!std::isnan(snow) && !std::isnan(total)) {
            const double ice = std::min(snow, total);
            rows.fell_before(Field::Snow, ice, 1.0);
            rows.fell_before(Field::Rain, total - ice, 1.0);
        } else if (!std::isnan(snow)) {
            rows.fell_before(Field::Snow, snow, 1.0);
            rows.fell_before(Field::Rain, liquid, 1.0);
        } else if (!std::isnan(total)) {
            rows.fell_before(Field::Precip, total, 1.0);
        } else if (!std::isnan(rain)) {
            rows.fell_before(Field::Precip, liquid, 1.0);
        }
    }
};

void put_value(RowCollector& rows, RowSums& sums, const OpenMeteoColumn& c, double value,
               double air_k)
{
    const ColumnMeaning& m = *c.meaning;
    double si = value * m.scale + m.offset;
    if (m.amount) {
        sums.add(c, si);
        return;
    }
    if (c.sea_level) {
        // Down the column of air from sea level to the station.
        const double z = std::isnan(rows.site().elevation_m) ? 0.0 : rows.site().elevation_m;
        const double t = std::isnan(air_k) ? 288.15 : air_k;
        si *= std::exp(-kGravity_m_s2 * z / (kAirGasConstant * (t + 0.5 * kLapseRate_k_m * z)));
    }
    rows.set(m.field, si);
}

void past_means(RowCollector& rows)
{
    for (const Field f : {Field::Shortwave, Field::Direct, Field::Diffuse}) rows.means_of_past(f);
}

}  // namespace

static void read_open_meteo_json(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    const Json whole = parse_json(text);
    const Json* root = &whole;
    if (whole.kind == Json::Kind::Array && !whole.items.empty()) {
        root = &whole.items.front();
        if (whole.items.size() > 1)
            rows.note(ReadNote::Kind::Info, 0, "", "several places in the file, the first is used");
    }
    const Json* hourly = root->find("hourly");
    if (!hourly || hourly->kind != Json::Kind::Object) refuse_unknown_json(whole);
    const auto number = [&](const char* key, double otherwise) {
        const Json* v = root->find(key);
        return v && v->kind == Json::Kind::Number ? v->number : otherwise;
    };
    rows.site().latitude_deg = number("latitude", kMissing);
    rows.site().longitude_deg = number("longitude", kMissing);
    rows.site().elevation_m = number("elevation", kMissing);
    double offset = number("utc_offset_seconds", 0.0);
    if (!(std::abs(offset) <= 50400.0)) offset = 0.0;
    rows.site().utc_offset_h = offset / 3600.0;
    const Json* time = hourly->find("time");
    if (!time || time->kind != Json::Kind::Array) {
        throw Error("weather: JSON 'hourly' has no array 'time'",
                    "Give an Open-Meteo response with hourly values.");
    }
    const Json* units = root->find("hourly_units");
    struct Column {
        const Json* values;
        OpenMeteoColumn meaning;
    };
    std::vector<Column> columns;
    const Json* air = hourly->find("temperature_2m");
    double air_scale = 1.0, air_offset = kZeroCelsiusK;
    for (const auto& [name, values] : hourly->members) {
        if (name == "time" || values.kind != Json::Kind::Array) continue;
        const Json* unit = units ? units->find(name) : nullptr;
        OpenMeteoColumn m = meaning_of(name, unit ? unit->text : "");
        if (!m.meaning) {
            rows.note(ReadNote::Kind::Info, values.line, shown(name), "not used");
            continue;
        }
        // Surface pressure is better than pressure at sea level.
        if (m.sea_level && hourly->find("surface_pressure")) continue;
        if (values.items.size() != time->items.size()) {
            rows.note(ReadNote::Kind::BadRow, values.line, shown(name),
                      "has " + std::to_string(values.items.size()) + " values for " +
                          std::to_string(time->items.size()) + " times");
        }
        if (name == "temperature_2m") {
            air_scale = m.meaning->scale;
            air_offset = m.meaning->offset;
        }
        columns.push_back({&values, m});
    }
    past_means(rows);
    for (std::size_t i = 0; i < time->items.size(); ++i) {
        const Json& t = time->items[i];
        std::optional<std::int64_t> us;
        if (t.kind == Json::Kind::String)
            us = us_from_iso(t.text, offset);
        else if (t.kind == Json::Kind::Number && std::abs(t.number) < 1e11)
            us = static_cast<std::int64_t>(t.number) * 1000000;
        if (!us) {
            rows.bad_row(t.line, "time",
                         "entry " + std::to_string(i + 1) + " of hourly.time is not a time");
            continue;
        }
        if (!rows.begin_row(*us, t.line)) continue;
        double air_k = kMissing;
        if (air && i < air->items.size() && air->items[i].kind == Json::Kind::Number) {
            air_k = air->items[i].number * air_scale + air_offset;
        }
        RowSums sums;
        for (const Column& c : columns) {
            if (i >= c.values->items.size() || c.values->items[i].kind != Json::Kind::Number)
                rows.missing(c.meaning.meaning->field);
            else
                put_value(rows, sums, c.meaning, c.values->items[i].number, air_k);
        }
        sums.put(rows);
    }
}

static void read_open_meteo_csv(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    const auto place_names = split(lines.next().value_or(""), ',', 16);
    const auto place = split(lines.next().value_or(""), ',', 16);
    double offset = 0.0;
    if (std::find(place_names.begin(), place_names.end(), "utc_offset_seconds") ==
        place_names.end())
        rows.note(ReadNote::Kind::Warning, 1, "time",
                  "the clock's zone is not told (utc_offset_seconds), taken as UTC");
    for (std::size_t i = 0; i < place_names.size() && i < place.size(); ++i) {
        const auto value = to_number(place[i]);
        if (place_names[i] == "latitude") rows.site().latitude_deg = value.value_or(kMissing);
        if (place_names[i] == "longitude") rows.site().longitude_deg = value.value_or(kMissing);
        if (place_names[i] == "elevation") rows.site().elevation_m = value.value_or(kMissing);
        if (place_names[i] == "utc_offset_seconds" && value && std::abs(*value) <= 50400.0)
            rows.site().utc_offset_h = (offset = *value) / 3600.0;
    }
    std::vector<OpenMeteoColumn> columns;
    std::size_t width = 0, air_at = 0;
    bool surface = false;
    std::vector<std::string_view> f;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) {
            if (width) break;  // the daily block
            continue;
        }
        split(*line, ',', f, 256);
        if (!width) {
            if (lower(f[0]) != "time") {
                throw Error("weather: Open-Meteo CSV line " + std::to_string(lines.number()) +
                                ": '" + shown(*line) + "' should begin with time",
                            "Download the file again as CSV with hourly values.");
            }
            width = f.size();
            columns.resize(width);
            for (std::size_t i = 1; i < width; ++i) {
                const auto open = f[i].find('(');
                const auto close = f[i].rfind(')');
                std::string unit;
                if (open != std::string_view::npos && close != std::string_view::npos &&
                    close > open) {
                    unit = std::string(f[i].substr(open + 1, close - open - 1));
                }
                const std::string name(trimmed(f[i].substr(0, open)));
                columns[i] = meaning_of(name, unit);
                if (!columns[i].meaning)
                    rows.note(ReadNote::Kind::Info, lines.number(), shown(name), "not used");
                if (lower(name) == "surface_pressure") surface = true;
                if (lower(name) == "temperature_2m") air_at = i;
            }
            past_means(rows);
            continue;
        }
        if (f.size() != width) {
            rows.wrong_columns(lines.number(), f.size(), width);
            continue;
        }
        const auto us = us_from_iso(f[0], offset);
        if (!us) {
            rows.bad_row(lines.number(), "time", "'" + shown(f[0]) + "' is not a time");
            continue;
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        double air_k = kMissing;
        if (air_at && columns[air_at].meaning) {
            if (const auto v = to_number(f[air_at]))
                air_k = *v * columns[air_at].meaning->scale + columns[air_at].meaning->offset;
        }
        RowSums sums;
        for (std::size_t i = 1; i < width; ++i) {
            if (!columns[i].meaning || (columns[i].sea_level && surface)) continue;
            const auto value = to_number(f[i]);
            if (f[i].empty() || lower(f[i]) == "nan")
                rows.missing(columns[i].meaning->field);
            else if (!value)
                rows.unreadable(columns[i].meaning->field, f[i]);
            else
                put_value(rows, sums, columns[i], *value, air_k);
        }
        sums.put(rows);
    }
    if (!width)
        throw Error("weather: Open-Meteo CSV has no table",
                    "Download the file again as CSV with hourly values.");
}

namespace {

bool recognise_open_meteo_json(const FileHead& head)
{
    return head.begins("{") || head.begins("[");
}

}  // namespace

extern const Reader open_meteo_json_reader;
const Reader open_meteo_json_reader{"Open-Meteo JSON", "Open-Meteo", recognise_open_meteo_json,
                                    read_open_meteo_json};

namespace {

bool recognise_open_meteo_csv(const FileHead& head)
{
    return head.first.rfind("latitude,longitude,elevation", 0) == 0 || head.begins("\"latitude\",");
}

}  // namespace

extern const Reader open_meteo_csv_reader;
const Reader open_meteo_csv_reader{"Open-Meteo CSV", "Open-Meteo", recognise_open_meteo_csv,
                                   read_open_meteo_csv};

}  // namespace petrichor::weather
