// UMEP, SOLWEIG and SUEWS: 24 columns between blanks under "%iy id it imin ..": year, day of year,
// hour and minute by the clock of the place, then means of the interval that ends there. C, %, m/s,
// kPa, mm, W/m2; Kdir is on a plane that faces the sun. -999 is missing; lines of -9 end the file.
// Older files call the air temperature Td, which is no dew point.
//   source  UMEP manual, meteorological input data; Lindberg et al. 2018
#include <algorithm>
#include <cmath>

#include "weather/physics/constants.h"
#include "weather/readers/formats.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kColumns = 24;

struct Column {
    const char* names[3];
    Field field;
    double scale, offset;
};
constexpr Column kRead[] = {{{"wind", "u", "ws"}, Field::Wind, 1.0, 0.0},
                            {{"rh", "", ""}, Field::RelHumidity, 1.0, 0.0},
                            {{"td", "tair", "ta"}, Field::AirTemp, 1.0, kZeroCelsiusK},
                            {{"press", "pres", "pressure"}, Field::Pressure, 1000.0, 0.0},
                            {{"kdn", "kdown", ""}, Field::Shortwave, 1.0, 0.0},
                            {{"ldown", "", ""}, Field::Longwave, 1.0, 0.0},
                            {{"fcld", "", ""}, Field::Cloud, 1.0, 0.0},
                            {{"kdiff", "", ""}, Field::Diffuse, 1.0, 0.0},
                            {{"kdir", "", ""}, Field::Direct, 1.0, 0.0},
                            {{"wd", "wdir", ""}, Field::WindFrom, 1.0, 0.0}};

std::vector<std::string> names_of(std::string_view line)
{
    line = trimmed(line);
    if (!line.empty() && (line.front() == '%' || line.front() == '#')) line.remove_prefix(1);
    std::vector<std::string> names;
    for (const auto word : words(line, 64)) names.push_back(lower(word));
    return names;
}

bool is_header(const std::vector<std::string>& names)
{
    return names.size() >= kColumns && names[0] == "iy" && names[1] == "id" && names[2] == "it" &&
           names[3] == "imin";
}

const Column* column_of(const std::string& name)
{
    for (const Column& c : kRead)
        for (const char* n : c.names)
            if (*n && name == n) return &c;
    return nullptr;
}

std::optional<std::int64_t> time_of(const std::vector<std::string_view>& w)
{
    const auto year = to_integer(w[0]), day = to_integer(w[1]), hour = to_integer(w[2]),
               minute = to_integer(w[3]);
    if (!year || !day || !hour || !minute || *day < 1 || *day > (is_leap_year(*year) ? 366 : 365) ||
        *hour < 0 || *hour > 24 || *minute < 0 || *minute > 59)
        return std::nullopt;
    const auto midnight = us_from_civil({*year, 1, 1, 0, 0, 0.0});
    if (!midnight) return std::nullopt;
    return *midnight + ((*day - 1) * 1440 + *hour * 60 + *minute) * 60 * 1000000;
}

void read(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    Lines lines(text);
    const std::vector<std::string> names = names_of(lines.next().value_or(""));
    for (const Field f : {Field::Shortwave, Field::Longwave, Field::Diffuse, Field::Direct})
        rows.means_of_past(f);
    std::vector<bool> told(names.size(), false);  // of columns that nobody reads
    std::vector<std::string_view> w;
    std::int64_t last_us = 0;
    while (const auto line = lines.next()) {
        words(*line, w, 64);
        if (w.empty() || w[0] == "-9") continue;
        const auto us = w.size() == names.size() ? time_of(w) : std::nullopt;
        if (!us) {
            if (w.size() == names.size())
                rows.bad_row(lines.number(), "time",
                             "'" + shown(*line) + "' begins with no year, day, hour and minute");
            else
                rows.wrong_columns(lines.number(), w.size(), names.size());
            continue;
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        const double hours = rows.rows() > 1 ? static_cast<double>(*us - last_us) / 3600e6 : 1.0;
        last_us = *us;
        for (std::size_t i = 4; i < w.size(); ++i) {
            const Column* c = column_of(names[i]);
            const bool rain = names[i] == "rain";
            const auto value = to_number(w[i]);
            const bool none = value && *value <= -999.0;
            if (!c && !rain) {
                told[i] = told[i] || (value && !none);
            } else if (none) {
                rows.missing(rain ? Field::Precip : c->field);
            } else if (!value) {
                rows.unreadable(rain ? Field::Precip : c->field, w[i]);
            } else if (rain) {
                // After a gap the amount is that of an hour at most.
                rows.fell_before(Field::Precip, *value, std::min(hours, 1.0));
            } else {
                rows.set(c->field, *value * c->scale + c->offset);
            }
        }
    }
    std::vector<std::string> unread;
    for (std::size_t i = 4; i < names.size(); ++i)
        if (told[i]) unread.push_back(names[i]);
    rows.unread_columns(unread);
    if (std::isnan(options.utc_offset_h))
        rows.note(ReadNote::Kind::Info, 0, "time",
                  "the clock of the place, which the file does not name: taken as UTC; --file-zone "
                  "HOURS says another");
}

bool recognise(const FileHead& head)
{
    return is_header(names_of(head.lines.front()));
}

}  // namespace

extern const Reader umep_reader;
const Reader umep_reader{"UMEP", "UMEP, SOLWEIG and SUEWS: iy id it imin and 20 columns", recognise,
                         read};

}  // namespace petrichor::weather
