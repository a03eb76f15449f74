// Plain CSV: a header with a time column and names with units, then rows. The separator (comma,
// semicolon, tab) is the most frequent one of the header; # begins a comment. Column names:
// units.cpp.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"
#include "weather/readers/formats.h"
#include "weather/readers/text.h"
#include "weather/readers/units.h"

namespace petrichor::weather {

namespace {

bool is_time_name(std::string_view name)
{
    const std::string low = lower(name);
    return low == "time" || low == "time_utc" || low == "datetime" || low == "date" ||
           low == "timestamp" || low == "date_time" || low == "time(utc)" || low == "time (utc)" ||
           low == "timestamp_utc" || low == "datetime_utc" || low == "valid_time" ||
           low == "date time";
}

// A date and time, or seconds or milliseconds since 1970 as programs write them. Ten digits may be
// 2024010106: when they begin with a year from 1900 to 2099 they are no count.
std::optional<std::int64_t> time_of_cell(std::string_view text)
{
    if (const auto us = us_from_iso(text)) return us;
    const auto count = to_integer(text);
    const auto length = trimmed(text).size();
    if (!count || *count < 0 || (length != 9 && length != 10 && length != 13)) return std::nullopt;
    if (length == 13) return *count * 1000;
    const long long year = *count / 1000000;
    if (length == 10 && year >= 1900 && year <= 2099) {
        return us_from_civil({year, static_cast<int>(*count / 10000 % 100),
                              static_cast<int>(*count / 100 % 100), static_cast<int>(*count % 100),
                              0, 0.0});
    }
    return *count * 1000000;
}

// Programs that write tables put the times first and often leave their name out.
bool is_unnamed_time(std::string_view header, std::string_view row, char separator)
{
    const auto names = split(header, separator, 2), cells = split(row, separator, 2);
    return names.front().empty() && time_of_cell(cells.front());
}

// Codes that data loggers and archives write for "no value"; none of them is a possible value of a
// column here.
bool is_missing_word(std::string_view text)
{
    text = trimmed(text);
    if (!text.empty() && text.front() >= '0' && text.front() <= '9') return false;
    const std::string low = lower(text);
    for (const char* word :
         {"", "na", "n/a", "nan", "null", "none", "-", "--", "?", "m", "missing"}) {
        if (low == word) return true;
    }
    if (low.front() != '-') return false;
    const auto value = to_number(low);
    if (!value) return false;
    for (const double code : {-99.0, -99.9, -99.99, -999.0, -999.9, -999.99, -6999.0, -7999.0,
                              -9999.0, -9999.9, -9999.99, -99999.0}) {
        if (*value == code) return true;
    }
    return false;
}

bool is_field(const ColumnMeaning& m)
{
    return !m.percent_snow && !m.vapour_pressure;
}
bool same_field(const ColumnMeaning& a, const ColumnMeaning& b)
{
    return is_field(a) && is_field(b) && a.field == b.field;
}
bool has_unit(std::string_view name)
{
    return trimmed(name).find_first_of("_([ ") != std::string_view::npos;
}

// With another separator than a comma, a comma may be the decimal point.
std::optional<double> cell_number(std::string_view text, char separator)
{
    const auto value = to_number(text);
    if (value || separator == ',' || std::count(text.begin(), text.end(), ',') != 1) return value;
    std::string point(text);
    std::replace(point.begin(), point.end(), ',', '.');
    return to_number(point);
}

}  // namespace

void read_forcing_csv(std::string_view text, RowCollector& rows, const ReadOptions&)
{
    Lines lines(text);
    std::string_view header;
    while (const auto line = lines.next()) {
        const auto t = trimmed(*line);
        if (t.empty() || t.front() == '#') continue;
        header = *line;
        break;
    }
    char separator = ',';
    std::ptrdiff_t most = 0;
    for (const char c : {',', ';', '\t'}) {
        const auto n = std::count(header.begin(), header.end(), c);
        if (n > most) {
            most = n;
            separator = c;
        }
    }
    const auto names = split(header, separator, 256);
    Lines below = lines;
    std::size_t time_at =
        is_unnamed_time(header, below.next().value_or(""), separator) ? 0 : names.size();
    std::vector<std::optional<ColumnMeaning>> meaning(names.size());
    std::size_t known = 0;
    std::string unknown, bare_names;
    const auto list = [](std::string& names_so_far, const std::string& name) {
        names_so_far.append(names_so_far.empty() ? "" : ", ").append(name);
    };
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i == time_at) continue;
        if (time_at == names.size() && is_time_name(names[i])) {
            time_at = i;
            continue;
        }
        meaning[i] = column_meaning(names[i]);
        if (!meaning[i]) {
            list(unknown, names[i].empty() ? "a column without a name" : shown(names[i]));
            continue;
        }
        ++known;
        for (std::size_t j = 0; j < i; ++j) {
            if (!meaning[j] || !same_field(*meaning[i], *meaning[j])) continue;
            // "rain_kg_m2_s" beside a bare "rain": the one that says its unit counts.
            if (has_unit(names[i]) == has_unit(names[j])) {
                throw Error("weather: columns '" + shown(names[j]) + "' and '" + shown(names[i]) +
                                "' mean the same quantity",
                            "Keep one of the two columns.");
            }
            const std::size_t bare = has_unit(names[i]) ? j : i;
            list(bare_names, shown(names[bare]) + " (" + shown(names[bare == i ? j : i]) + " is)");
            meaning[bare].reset();
            if (bare == i) break;
        }
    }
    if (!unknown.empty())
        rows.note(ReadNote::Kind::Info, lines.number(), "columns",
                  "not known, not used: " + unknown);
    if (!bare_names.empty())
        rows.note(ReadNote::Kind::Warning, lines.number(), "columns",
                  "not used, as another column says the same quantity with a unit: " + bare_names);
    if (time_at == names.size() || known == 0) {
        throw Error("weather: line " + std::to_string(lines.number()) + ": the header '" +
                        shown(header) + "' has no " +
                        (time_at == names.size() ? "time column" : "known weather column"),
                    "Name the columns as in: "
                    "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm,sw_down_w_m2.");
    }

    // Amounts per interval belong to the time from this row to the next.
    std::int64_t usual_us = 3600000000LL;
    bool amounts = false;
    for (const auto& m : meaning) amounts = amounts || (m && m->amount);
    if (amounts) {
        // The step is that of the first two rows with a time.
        Lines look = lines;
        std::vector<std::int64_t> first_times;
        while (first_times.size() < 2) {
            const auto line = look.next();
            if (!line) break;
            const auto f = split(*line, separator, 256);
            if (f.size() <= time_at) continue;
            if (const auto us = time_of_cell(f[time_at])) first_times.push_back(*us);
        }
        if (first_times.size() == 2 && first_times[1] > first_times[0])
            usual_us = first_times[1] - first_times[0];
        rows.note(ReadNote::Kind::Info, 0, "precip",
                  std::string("amounts are for the interval that begins at their row, ")
                      .append(std::to_string(usual_us / 1000000))
                      .append(" s"));
    }
    const double seconds = static_cast<double>(usual_us) * 1e-6;

    std::map<std::string, std::size_t> missing_codes;
    std::size_t plain_numbers = 0;  // where a time should be
    std::vector<std::string_view> f;
    while (const auto line = lines.next()) {
        const auto t = trimmed(*line);
        if (t.empty() || t.front() == '#') continue;
        split(*line, separator, f, 256);
        if (f.size() != names.size()) {
            rows.bad_row(lines.number(), "",
                         "has " + std::to_string(f.size()) + " columns, the header has " +
                             std::to_string(names.size()));
            continue;
        }
        const auto us = time_of_cell(f[time_at]);
        if (!us) {
            plain_numbers += to_number(f[time_at]).has_value();
            rows.bad_row(lines.number(), "time",
                         "'" + shown(f[time_at]) + "' is not a date and time as 2005-10-01T06:00");
            continue;
        }
        if (!rows.begin_row(*us, lines.number())) continue;
        double snow_share = kMissing, vapour = kMissing, air_k = kMissing, precip = kMissing;
        for (std::size_t i = 0; i < f.size(); ++i) {
            if (!meaning[i]) continue;
            const ColumnMeaning& m = *meaning[i];
            const bool field = is_field(m);
            if (is_missing_word(f[i])) {
                if (field) rows.missing(m.field);
                const std::string code(trimmed(f[i]));
                ++missing_codes[code.empty() ? "an empty cell" : "'" + shown(code) + "'"];
                continue;
            }
            const auto value = cell_number(f[i], separator);
            if (!value) {
                if (field) rows.unreadable(m.field, f[i]);
                continue;
            }
            if (m.percent_snow) {
                snow_share = *value;
                continue;
            }
            if (m.vapour_pressure) {
                vapour = *value;
                continue;
            }
            double si = *value * m.scale + m.offset;
            if (m.amount) si /= seconds;
            if (m.field == Field::AirTemp) air_k = si;
            if (m.field == Field::Precip) precip = si;
            rows.set(m.field, si);
        }
        if (!std::isnan(vapour) && air_k > 173.15 && air_k < 333.15) {
            rows.set(Field::RelHumidity,
                     std::min(100.0 * vapour / saturation_pressure_water_pa(air_k), 100.0));
        }
        if (snow_share >= 0.0 && snow_share <= 1.0 && !std::isnan(precip)) {
            rows.set(Field::Snow, precip * snow_share);
            rows.set(Field::Rain, precip * (1.0 - snow_share));
        }
    }
    if (rows.rows() == 0 && plain_numbers > 0) {
        throw Error(
            "weather: column '" + shown(names[time_at]) +
                "' holds plain numbers, not dates and times",
            "Give times as 2005-10-01T06:00; for keys of the artist model, name the columns "
            "time_s,temperature_c,rainfall.");
    }
    for (const auto& [code, count] : missing_codes) {
        rows.note(ReadNote::Kind::Info, 0, "missing",
                  std::string(code)
                      .append(" means no value, ")
                      .append(std::to_string(count))
                      .append(" times"));
    }
}

}  // namespace petrichor::weather
