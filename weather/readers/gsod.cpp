// NOAA Global Summary of the Day: STATION,DATE,..,TEMP,DEWP,SLP,STP,VISIB,WDSP,MAX,MIN,PRCP,SNDP,
// FRSHTT. F, knots, miles, inches, hPa; each with its own run of nines for a missing value. Pressures
// of the station of 1000 hPa and more are often written without their first digit. FRSHTT is six
// digits for fog, rain, snow, hail, thunder and tornado.
#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/days.h"
#include "weather/readers/formats.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    constexpr std::size_t kMostDays = 400000;
    constexpr double kFree_m_s = 1852.0 / 3600.0;
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ',');
    const std::size_t date = header.at("date"), station = header.at("station"),
                      name = header.at("name"), latitude = header.at("latitude"),
                      longitude = header.at("longitude"), elevation = header.at("elevation"),
                      weather = header.at("frshtt"), amount_kind = header.at("prcp_attributes");
    struct Column {
        const char* name;
        double DayOfWeather::*value;
        double scale, offset, missing;
    };
    constexpr double kF = 5.0 / 9.0, kFrom_f = -32.0 * kF;
    constexpr Column kColumns[] = {{"temp", &DayOfWeather::mean_c, kF, kFrom_f, 9999.9},
                                   {"max", &DayOfWeather::high_c, kF, kFrom_f, 9999.9},
                                   {"min", &DayOfWeather::low_c, kF, kFrom_f, 9999.9},
                                   {"dewp", &DayOfWeather::dew_c, kF, kFrom_f, 9999.9},
                                   {"stp", &DayOfWeather::pressure_pa, 100.0, 0.0, 999.9},
                                   {"visib", &DayOfWeather::visibility_m, 1609.344, 0.0, 999.9},
                                   {"wdsp", &DayOfWeather::wind_m_s, kFree_m_s, 0.0, 999.9},
                                   {"prcp", &DayOfWeather::precip_mm, 25.4, 0.0, 99.99},
                                   {"sndp", &DayOfWeather::depth_m, 0.0254, 0.0, 999.9}};
    std::vector<std::size_t> at;
    for (const Column& c : kColumns) {
        at.push_back(header.at(c.name));
        (void)header.at(std::string(c.name) + "_attributes");
    }
    rows.unread_columns(header.unread());
    DaysOfWeather days;
    std::string first;
    bool others = false;
    std::size_t no_report = 0;
    OddCells odd(rows);
    const DatedRows how{
        .time_of = [&](const Cells& cells) { return us_from_iso(cell_of(cells, date)); },
        .lacks = "has no DATE"};
    for_dated_rows(lines, how, rows, [&](const DatedRow& row) {
        if (first.empty()) {
            first = std::string(cell_of(row.cells, station));
            Site& site = rows.site();
            site.latitude_deg = to_number(cell_of(row.cells, latitude)).value_or(kMissing);
            site.longitude_deg = to_number(cell_of(row.cells, longitude)).value_or(kMissing);
            site.elevation_m = to_number(cell_of(row.cells, elevation)).value_or(kMissing);
            site.name = shown(cell_of(row.cells, name));
        }
        if (cell_of(row.cells, station) != first) {
            others = true;
            return;
        }
        if (days.size() >= kMostDays) return;
        DayOfWeather& day = days[row.time_us];
        day.line = row.line;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const Column& c = kColumns[i];
            double value = odd.number_of(cell_of(row.cells, at[i]), row.line, c.name);
            if (std::isnan(value) || value == c.missing) continue;
            if (c.value == &DayOfWeather::pressure_pa && value < 100.0) value += 1000.0;
            day.*c.value = value * c.scale + c.offset;
        }
        // "I": the station told no amount, and may have had one; .00 stands there all the same.
        if (trimmed(cell_of(row.cells, amount_kind)) == "I" && day.precip_mm == 0.0) {
            day.precip_mm = kMissing;
            ++no_report;
        }
        std::string six(trimmed(cell_of(row.cells, weather)));
        six.insert(0, six.size() < 6 ? 6 - six.size() : 0, '0');  // programs drop the zeros before
        const bool rain = six[1] == '1', snow = six[2] == '1';
        if (day.precip_mm > 0.0 && (rain || snow)) day.snow_share = rain ? (snow ? 0.5 : 0.0) : 1.0;
    });
    if (others)
        rows.note(ReadNote::Kind::Warning, 0, "station",
                  "several stations in the file, only " + shown(first) + " is used");
    if (no_report)
        rows.note(ReadNote::Kind::Info, 0, "PRCP",
                  std::to_string(no_report) + " days of which no amount was told (I), missing");
    rows.note(ReadNote::Kind::Info, 0, "snow",
              "a day with rain and snow is half of each: the file tells no more");
    // Warmest is the afternoon of the place, whichever day the archive counts by.
    const double zone_h = zone_of_longitude_h(std::isnan(options.site.longitude_deg)
                                                  ? rows.site().longitude_deg
                                                  : options.site.longitude_deg);
    if (zone_h != 0.0)
        rows.note(ReadNote::Kind::Time, 0, "time",
                  "the archive's days are those of UTC: taken as days of the place");
    put_days(days, zone_h, rows);
}

bool recognise(const FileHead& head)
{
    return head.has_columns({"station", "date", "temp", "dewp", "wdsp", "frshtt"});
}

}  // namespace

extern const Reader gsod_reader;
const Reader gsod_reader{"GSOD", "NOAA, global summary of the day", recognise, read};

}  // namespace petrichor::weather
