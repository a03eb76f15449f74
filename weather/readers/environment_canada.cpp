// Environment and Climate Change Canada, hourly CSV: local standard time all year, C, %, mm of the
// hour, tens of degrees, km/h, km, kPa at the station; the column Weather says in words what falls.
// The zone is not in the file: it is that of the longitude.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

constexpr TableColumn kColumns[] = {
    {"temp (\xC2\xB0"
     "c)",
     Field::AirTemp, 1.0, kZeroCelsiusK},
    {"temp (c)", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"temp (\xB0"
     "c)",
     Field::AirTemp, 1.0, kZeroCelsiusK},
    {"dew point temp (\xC2\xB0"
     "c)",
     Field::DewPoint, 1.0, kZeroCelsiusK},
    {"dew point temp (c)", Field::DewPoint, 1.0, kZeroCelsiusK},
    {"dew point temp (\xB0"
     "c)",
     Field::DewPoint, 1.0, kZeroCelsiusK},
    {"rel hum (%)", Field::RelHumidity},
    {"precip. amount (mm)", Field::Precip, 1.0, 0.0, 1.0},
    {"wind dir (10s deg)", Field::WindFrom, 10.0},
    {"wind spd (km/h)", Field::Wind, 1.0 / 3.6},
    {"visibility (km)", Field::Visibility, 1000.0},
    {"stn press (kpa)", Field::Pressure, 1000.0},
};

struct Sky {
    double cloud = kMissing;
    double snow_share = kMissing;
    double rain_mm_h = 0.0, snow_mm_h = 0.0;
};

// "Mainly Clear", "Snow,Fog", "Moderate Rain Showers"
Sky sky_of_words(std::string_view text)
{
    const std::string low = lower(text);
    const auto has = [&](const char* word) { return low.find(word) != low.npos; };
    Sky sky;
    if (has("mostly cloudy"))
        sky.cloud = 0.75;
    else if (has("cloudy"))
        sky.cloud = 1.0;
    else if (has("mainly clear"))
        sky.cloud = 0.25;
    else if (has("clear"))
        sky.cloud = 0.0;
    const double grade = has("heavy") ? 12.0 : has("moderate") ? 4.5 : 1.0;
    const bool snow = has("snow") || has("ice crystals") || has("ice pellets");
    const bool drifts = has("blowing snow") && !has("snow,") && !has(",snow");
    const bool rain = has("rain") || has("drizzle");
    if (snow && !drifts) sky.snow_mm_h = has("heavy") ? 3.0 : has("moderate") ? 1.5 : 0.5;
    if (rain) sky.rain_mm_h = has("drizzle") && !has("rain") ? 0.1 : grade;
    if (sky.snow_mm_h + sky.rain_mm_h > 0.0) {
        sky.snow_share = sky.snow_mm_h / (sky.snow_mm_h + sky.rain_mm_h);
        sky.cloud = 1.0;
    }
    return sky;
}

bool fits(const TableColumn& column, std::string_view cell)
{
    const auto number = to_number(cell);
    if (!number) return cell == "M" || cell == "NA";
    const FieldInfo& info = field_info(column.field);
    const double si = *number * column.scale + column.offset;
    // An amount falls in some hours, and no limit of a rate tells it from another number.
    return column.fell_hours > 0.0 ? *number >= 0.0
                                   : si >= info.low - info.noise && si <= info.high;
}

// Names over columns of something else, as when a program has sorted one and not the other.
//   throws  Error that says which, for the time or for two columns and more
void refuse_misplaced(Lines lines, const TableHeader& header, std::size_t stamp)
{
    constexpr std::size_t kLooked = 48;
    struct Check {
        std::string name;
        std::size_t at;
        std::function<bool(std::string_view)> fits;
        bool some = false;
        std::string odd{};
    };
    std::vector<Check> checks;
    const auto within = [](double low, double high) {
        return [=](std::string_view cell) {
            const auto number = to_number(cell);
            return number && *number >= low && *number <= high;
        };
    };
    const auto add = [&](std::size_t at, std::function<bool(std::string_view)> good) {
        if (at < header.size()) checks.push_back({header.names()[at], at, std::move(good)});
    };
    add(stamp, [](std::string_view cell) { return us_from_iso(cell).has_value(); });
    add(header.at("latitude (y)"), within(-90.0, 90.0));
    add(header.at("longitude (x)"), within(-180.0, 180.0));
    add(header.at("year"), within(1800.0, 2200.0));
    add(header.at("month"), within(1.0, 12.0));
    add(header.at("day"), within(1.0, 31.0));
    for (const TableColumn& column : kColumns)
        add(header.at(column.name),
            [&column](std::string_view cell) { return fits(column, cell); });
    std::vector<std::string_view> cells;
    for (std::size_t row = 0; row < kLooked; ++row) {
        const auto line = lines.next();
        if (!line) break;
        split(*line, ',', cells, 64);
        for (Check& check : checks) {
            const auto cell = cell_of(cells, check.at);
            if (cell.empty() && check.at != stamp) continue;  // every row has a time
            if (check.fits(cell))
                check.some = true;
            else if (check.odd.empty())
                check.odd = cell.empty() ? "nothing" : "'" + shown(cell) + "'";
        }
    }
    std::string list;
    std::size_t wrong = 0;
    for (const Check& check : checks) {
        if (check.some || check.odd.empty()) continue;
        list += (wrong++ ? ", '" : "'") + check.name + "' holds " + check.odd;
    }
    if (wrong == 0 || (wrong == 1 && (checks.front().some || checks.front().odd.empty()))) return;
    throw Error("weather: Environment Canada: columns hold what their names do not say: " + list,
                "Put each name over its own column again.");
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ',');
    std::size_t stamp = header.at("date/time (lst)");
    if (stamp == TableHeader::kNone) stamp = header.at("date/time");
    const std::size_t clock =
                          header.has("time (lst)") ? header.at("time (lst)") : header.at("time"),
                      weather = header.at("weather"), longitude = header.at("longitude (x)"),
                      latitude = header.at("latitude (y)"), name = header.at("station name");
    refuse_misplaced(lines, header, stamp);
    const bool measured = header.has("precip. amount (mm)");
    {
        Lines below = lines;
        const auto f = split(below.next().value_or(""), ',', 64);
        rows.site().longitude_deg = to_number(cell_of(f, longitude)).value_or(kMissing);
        rows.site().latitude_deg = to_number(cell_of(f, latitude)).value_or(kMissing);
        rows.site().name = shown(cell_of(f, name));
    }
    const double zone_h =
        zone_of_longitude_h(std::isnan(options.site.longitude_deg) ? rows.site().longitude_deg
                                                                   : options.site.longitude_deg);
    rows.site().utc_offset_h = zone_h;
    char zone[120];
    std::snprintf(zone, sizeof zone,
                  "local standard time; the zone is taken from the longitude: UTC%+g h", zone_h);
    rows.note(ReadNote::Kind::Time, 1, "time", zone);
    TableRows how;
    how.columns = kColumns;
    how.value_of = [](std::string_view cell) -> std::optional<double> {
        if (cell.empty() || cell == "M" || cell == "NA") return std::nullopt;
        return to_number(cell).value_or(kMissing);
    };
    how.time_of = [&](const std::vector<std::string_view>& f) -> std::optional<std::int64_t> {
        std::string when(cell_of(f, stamp));
        if (when.size() == 10) when.append(" ").append(cell_of(f, clock));
        auto us = us_from_iso(when);
        if (us) *us -= static_cast<std::int64_t>(zone_h * 3600e6);
        return us;
    };
    how.also = [&](const std::vector<std::string_view>& f) {
        const Sky sky = sky_of_words(cell_of(f, weather));
        if (!std::isnan(sky.cloud)) rows.set(Field::Cloud, sky.cloud);
        if (!std::isnan(sky.snow_share)) rows.set(Field::SnowShare, sky.snow_share);
        if (!measured) rows.set(Field::Precip, (sky.rain_mm_h + sky.snow_mm_h) / 3600.0);
    };
    // The archive fills the rest of a month with rows that hold only their time.
    std::vector<std::size_t> values{weather};
    for (const TableColumn& column : kColumns) values.push_back(header.at(column.name));
    how.skip = [values = std::move(values)](const std::vector<std::string_view>& f) {
        return std::all_of(values.begin(), values.end(),
                           [&](std::size_t at) { return cell_of(f, at).empty(); });
    };
    if (!measured) {
        rows.note(ReadNote::Kind::Info, 1, "precip",
                  "no amounts in the file: rates from the weather in words, as for METAR");
    }
    read_table_rows(lines, header, how, rows);
}

bool recognise(const FileHead& head)
{
    const bool stamp = head.first.find("date/time") != head.first.npos;
    return stamp && head.first.find("stn press") != head.first.npos &&
           head.first.find("climate id") != head.first.npos;
}

}  // namespace

extern const Reader environment_canada_reader;
const Reader environment_canada_reader{"Environment Canada", "hourly CSV of the climate archive",
                                       recognise, read};

}  // namespace petrichor::weather
