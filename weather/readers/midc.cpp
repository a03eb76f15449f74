// NREL Measurement and Instrumentation Data Center: CSV with DATE (MM/DD/YYYY), a clock named by
// its zone (MST, PST, ..; standard time), and columns such as "Global Horizontal [W/m^2]". Of
// several instruments for one quantity the first counts; the others are named in the report.
#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/tables.h"

namespace petrichor::weather {

namespace {

struct Word {
    const char* begins;
    const char* unit;
    Field field;
    double scale, offset;
};
constexpr Word kWords[] = {
    {"global", "[w/m^2]", Field::Shortwave, 1.0, 0.0},
    {"direct", "[w/m^2]", Field::Direct, 1.0, 0.0},
    {"diffuse", "[w/m^2]", Field::Diffuse, 1.0, 0.0},
    {"downwelling ir", "[w/m^2]", Field::Longwave, 1.0, 0.0},
    {"infrared", "[w/m^2]", Field::Longwave, 1.0, 0.0},
    {"pyrgeometer", "[w/m^2]", Field::Longwave, 1.0, 0.0},
    {"reflected", "[w/m^2]", Field::Reflected, 1.0, 0.0},
    {"upwelling sw", "[w/m^2]", Field::Reflected, 1.0, 0.0},
    {"air temp", "[deg c]", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"temperature", "[deg c]", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"deck dry bulb temp", "[deg c]", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"tower dry bulb temp", "[deg c]", Field::AirTemp, 1.0, kZeroCelsiusK},
    {"rel humidity", "[%]", Field::RelHumidity, 1.0, 0.0},
    {"relative humidity", "[%]", Field::RelHumidity, 1.0, 0.0},
    {"tower rh", "[%]", Field::RelHumidity, 1.0, 0.0},
    {"deck rh", "[%]", Field::RelHumidity, 1.0, 0.0},
    {"avg wind speed", "[m/s]", Field::Wind, 1.0, 0.0},
    {"wind speed", "[m/s]", Field::Wind, 1.0, 0.0},
    {"avg wind direction", "[deg", Field::WindFrom, 1.0, 0.0},
    {"wind direction", "[deg", Field::WindFrom, 1.0, 0.0},
    {"station pressure", "[mbar]", Field::Pressure, 100.0, 0.0},
    {"pressure", "[mbar]", Field::Pressure, 100.0, 0.0},
    {"snow depth", "[cm]", Field::SnowDepth, 0.01, 0.0},
    {"total cloud cover", "[%]", Field::Cloud, 0.01, 0.0},
};

double zone_of_name(std::string_view name)
{
    struct Zone {
        const char* name;
        double hours;
    };
    constexpr Zone kZones[] = {{"utc", 0},  {"gmt", 0},   {"est", -5},  {"cst", -6}, {"mst", -7},
                               {"pst", -8}, {"akst", -9}, {"hst", -10}, {"ast", -4}};
    for (const Zone& z : kZones) {
        if (name == z.name) return z.hours;
    }
    return kMissing;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const TableHeader header(lines.next().value_or(""), ',');
    double zone_h = header.size() > 1 ? zone_of_name(header.names()[1]) : kMissing;
    if (std::isnan(zone_h)) {
        zone_h = zone_of_longitude_h(options.site.longitude_deg);
        rows.note(ReadNote::Kind::Warning, 1, "time",
                  "the clock's zone is not known: taken from the longitude");
    }
    rows.site().utc_offset_h = zone_h;
    struct Column {
        const Word* word;
        std::size_t at;
    };
    std::vector<Column> columns;
    std::size_t rain = TableHeader::kNone, rain_sum = TableHeader::kNone;
    std::string twins;
    std::vector<std::string> unread;
    for (std::size_t i = 2; i < header.size(); ++i) {
        const std::string& name = header.names()[i];
        if (name.rfind("precipitation", 0) == 0 && name.find("[mm]") != name.npos) {
            (name.find("accum") == name.npos ? rain : rain_sum) = i;
            continue;
        }
        bool known = false;
        for (const Word& word : kWords) {
            if (name.rfind(word.begins, 0) != 0 || name.find(word.unit) == name.npos) continue;
            const bool taken = std::any_of(columns.begin(), columns.end(), [&](const Column& c) {
                return c.word->field == word.field;
            });
            known = true;
            if (taken)
                twins.append(twins.empty() ? "" : ", ").append(shown(name));
            else
                columns.push_back({&word, i});
            break;
        }
        if (!known) unread.push_back(name);
    }
    rows.unread_columns(unread);
    if (!twins.empty())
        rows.note(ReadNote::Kind::Info, 1, "columns", "second instruments, not used: " + twins);
    std::optional<double> sum_before;
    std::vector<std::string_view> f;
    std::int64_t before = 0;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, ',', f, 256);
        const auto date = cell_of(f, 0), clock = cell_of(f, 1);
        std::optional<std::int64_t> us;
        const auto month_end = date.find('/'), day_end = date.rfind('/');
        if (month_end != date.npos && day_end != month_end) {
            const auto whole = [](std::string_view part) { return to_integer(part).value_or(-1); };
            const auto colon = clock.find(':');
            const long long month = whole(date.substr(0, month_end)),
                            day = whole(date.substr(month_end + 1, day_end - month_end - 1)),
                            year = whole(date.substr(day_end + 1)),
                            hour = whole(clock.substr(0, colon)),
                            minute = colon == clock.npos ? -1 : whole(clock.substr(colon + 1, 2));
            if (month >= 1 && month <= 12 && day >= 1 && day <= 31 && hour >= 0 && hour <= 24 &&
                minute >= 0 && minute < 60)
                us = us_from_civil({year, static_cast<int>(month), static_cast<int>(day),
                                    static_cast<int>(hour), static_cast<int>(minute), 0.0});
        }
        if (!us) {
            rows.bad_row(lines.number(), "time", "'" + shown(*line) + "' has no date and time");
            continue;
        }
        *us -= static_cast<std::int64_t>(zone_h * 3600e6);
        if (!rows.begin_row(*us, lines.number())) continue;
        for (const Column& c : columns) {
            const auto cell = cell_of(f, c.at);
            const auto value = to_number(cell);
            if (cell.empty() || (value && *value <= -999.0))
                rows.missing(c.word->field);
            else if (!value)
                rows.unreadable(c.word->field, cell);
            else
                rows.set(c.word->field, *value * c.word->scale + c.word->offset);
        }
        const double hours = before ? static_cast<double>(*us - before) / 3600e6 : 1.0 / 60.0;
        if (const auto mm = to_number(cell_of(f, rain)); mm && *mm >= 0.0) {
            rows.fell_before(Field::Precip, *mm, hours);
        } else if (const auto sum = to_number(cell_of(f, rain_sum)); sum && *sum >= 0.0) {
            // Counts up through the day and starts again at midnight.
            if (sum_before)
                rows.fell_before(Field::Precip, *sum >= *sum_before ? *sum - *sum_before : *sum,
                                 hours);
            sum_before = sum;
        }
        before = *us;
    }
}

bool recognise(const FileHead& head)
{
    return head.first.rfind("date (mm/dd/yyyy),", 0) == 0;
}

}  // namespace

extern const Reader midc_reader;
const Reader midc_reader{"MIDC", "NREL measurement stations, CSV", recognise, read};

}  // namespace petrichor::weather
