// Plain CSV: a header with a time column and names with units, then rows; its layout:
// plain_table.h. Column names: units.cpp.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "weather/physics/constants.h"
#include "weather/physics/humidity.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/formats.h"
#include "weather/readers/gauge_count.h"
#include "weather/readers/plain_table.h"
#include "weather/readers/table_rows.h"
#include "weather/readers/text.h"
#include "weather/readers/units.h"

namespace petrichor::weather {

namespace {

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

// The line of names, and what its columns mean.
struct Header {
    std::size_t line = 0;
    const std::vector<std::string_view>& names;
    CsvTimes times;
    std::vector<std::optional<ColumnMeaning>> meaning;
};

// Columns that weather tables often have and that no model here uses: no reason to stop.
bool is_known_unused(std::string_view name)
{
    std::string low = lower(trimmed(name));
    std::replace(low.begin(), low.end(), ' ', '_');
    for (const char* start : {"soil_temp",
                              "soil_moist",
                              "precip_temp",
                              "snow_density",
                              "wind_gust",
                              "windgust",
                              "gust",
                              "weather_code",
                              "weathercode",
                              "evapotranspiration",
                              "windb\xC3\xB6",
                              "windb\xF6",
                              "windboe",
                              "sonnenschein",
                              "et0",
                              "uv_index",
                              "sunshine",
                              "wet_bulb",
                              "apparent_temp",
                              "precipitation_probability",
                              "vapour_pressure_deficit",
                              "vapor_pressure_deficit",
                              "pressure_msl",
                              "cloud_cover_low",
                              "cloud_cover_mid",
                              "cloud_cover_high",
                              "cloudcover_low",
                              "cloudcover_mid",
                              "cloudcover_high"}) {
        if (low.rfind(start, 0) == 0) return true;
    }
    return low.size() > 5 && (low.ends_with("_flag") || low.ends_with("_qc"));
}

// "# latitude: 45.3" above the table says where it is, as "Latitude;45.3" in its title does; also
// longitude, elevation_m, temp_height_m, wind_height_m, utc_offset_h, name; and "note" goes to the
// report.
void read_place(std::string_view text, const PlainTable& table, RowCollector& rows)
{
    Site& site = rows.site();
    Lines lines(text);
    while (const auto line = lines.next()) {
        auto t = trimmed(*line);
        if (lines.number() >= table.header_line) return;
        if (t.empty()) continue;
        const bool comment = t.front() == '#';
        if (comment) t = trimmed(t.substr(1));
        const auto colon = t.find_first_of(comment ? ":=" : ":=,;\t");
        if (colon == std::string_view::npos) continue;
        const std::string key = lower(trimmed(t.substr(0, colon)));
        auto value = trimmed(t.substr(colon + 1));
        while (!comment && !value.empty() &&
               std::string_view(",;\t ").find(value.back()) != value.npos)
            value.remove_suffix(1);
        const auto number = comment ? to_number(value) : cell_number(value, table);
        if (comment && key == "petrichor") rows.report().format = shown(value);
        if (key == "name") site.name = shown(value);
        if (comment && key == "note")
            rows.note(ReadNote::Kind::Info, lines.number(), "", std::string(value.substr(0, 400)));
        if (comment && key == "warning")
            rows.note(ReadNote::Kind::Warning, lines.number(), "",
                      std::string(value.substr(0, 400)));
        if (!number) continue;
        if (key == "latitude") site.latitude_deg = *number;
        if (key == "longitude") site.longitude_deg = *number;
        if (key == "elevation_m") site.elevation_m = *number;
        if (key == "utc_offset_h" && std::abs(*number) <= 14.0) site.utc_offset_h = *number;
        if (key == "temp_height_m" && *number >= 0.3 && *number <= 200.0)
            site.temp_height_m = *number;
        if (key == "wind_height_m" && *number >= 0.6 && *number <= 500.0)
            site.wind_height_m = *number;
    }
}

void add_to_list(std::string& list, const std::string& name)
{
    list.append(list.empty() ? "" : ", ").append(name);
}

// "rain_kg_m2_s" beside a bare "rain": the one that says its unit counts. Adds to the list of bare
// names when column `i` is, or makes, one of two.
//   throws  Error when both or none of two columns of one quantity say their unit
void drop_bare_twin(Header& h, std::size_t i, std::string& bare_names)
{
    for (std::size_t j = 0; j < i && h.meaning[i]; ++j) {
        if (!h.meaning[j] || !same_field(*h.meaning[i], *h.meaning[j])) continue;
        if (has_unit(h.names[i]) == has_unit(h.names[j])) {
            throw Error("weather: columns '" + shown(h.names[j]) + "' and '" + shown(h.names[i]) +
                            "' mean the same quantity",
                        "Keep one of the two columns.");
        }
        const std::size_t bare = has_unit(h.names[i]) ? j : i;
        const std::size_t better = bare == i ? j : i;
        add_to_list(bare_names, shown(h.names[bare]) + " (" + shown(h.names[better]) + " is)");
        h.meaning[bare].reset();
    }
}

// Named by --ignore; the word "all" there is of columns that are not understood.
bool is_left_out(std::string_view name, const std::vector<std::string>& ignored)
{
    const std::string low = lower(trimmed(name));
    return std::any_of(ignored.begin(), ignored.end(),
                       [&](const std::string& word) { return lower(word) == low; });
}

//   throws  Error without times or a known column
Header read_header(const PlainTable& table, RowCollector& rows, const ReadOptions& options)
{
    Header h{table.header_line, table.names, {}, {}};
    std::vector<std::string_view> first;
    Lines below = table.rows();
    table.cells(below.next().value_or(""), first);
    h.times = find_csv_times(h.names, first);
    h.meaning.resize(h.names.size());
    bool any = false;
    std::string bare_names, left_out, assumed;
    for (std::size_t i = 0; i < h.names.size(); ++i) {
        if (h.times.uses(i)) continue;
        if (is_left_out(h.names[i], options.ignore)) {
            add_to_list(left_out, shown(trimmed(h.names[i])));
            continue;
        }
        h.meaning[i] = column_meaning(h.names[i]);
        any = any || h.meaning[i];
        if (!h.meaning[i] && !is_known_unused(h.names[i]))
            rows.unknown_column(h.names[i], options.ignore);
        drop_bare_twin(h, i, bare_names);
    }
    if (!left_out.empty())
        rows.note(ReadNote::Kind::Info, h.line, "columns", "left out as asked: " + left_out);
    if (!bare_names.empty())
        rows.note(ReadNote::Kind::Warning, h.line, "columns",
                  "not used, as another column says the same quantity with a unit: " + bare_names);
    for (std::size_t i = 0; i < h.names.size(); ++i)
        if (h.meaning[i] && !h.meaning[i]->assumed_unit.empty())
            add_to_list(assumed, shown(trimmed(h.names[i])) + " taken as " +
                                     std::string(h.meaning[i]->assumed_unit));
    if (!assumed.empty())
        rows.note(ReadNote::Kind::Info, h.line, "columns", "their names say no unit: " + assumed);
    if (!h.times.found() || !any) {
        throw Error("weather: line " + std::to_string(h.line) + ": the header '" +
                        shown(table.header) + "' has no " +
                        (h.times.found() ? "known weather column" : "time column"),
                    "Name the columns as in: "
                    "time,air_temp_c,rel_humidity_pct,wind_m_s,precip_mm,sw_down_w_m2; the time "
                    "may also be date,time or date,hour or year,month,day,hour.");
    }
    // A table of depths beside one of weather is joined with it; one of what no model here reads is
    // somebody's observations.
    const bool measured = std::all_of(h.meaning.begin(), h.meaning.end(), [](const auto& m) {
        return !m || (is_field(*m) && field_info(m->field).observed);
    });
    if (measured && rows.has_strange_columns())
        throw Error("weather: this table has observations alone",
                    "Give the weather, and this file with --observed.");
    if (table.title_line > 0)
        rows.note(ReadNote::Kind::Info, table.title_line, "title",
                  "'" + shown(table.title) + "': the names of the columns are in line " +
                      std::to_string(h.line));
    if (table.units_line > 0)
        rows.note(ReadNote::Kind::Info, table.units_line, "columns", "the units of the columns");
    rows.check_columns();
    return h;
}

// Which way round dates such as 01/02/2024 are: as asked, else as one of them shows.
//   throws  Error where none shows it, or they differ
void find_date_order(Header& h, const PlainTable& table, RowCollector& rows,
                     const ReadOptions& options)
{
    if (h.times.stamp == CsvTimes::kNone) return;
    DateOrders orders;
    std::vector<std::string_view> cells;
    Lines lines = table.rows();
    while (const auto line = lines.next()) {
        const auto t = trimmed(*line);
        if (t.empty() || t.front() == '#') continue;
        table.cells(*line, cells);
        if (cells.size() == h.names.size()) orders.add(cells[h.times.stamp]);
        // Tables of another kind of dates are not read twice.
        if (orders.either().empty() && orders.day_first().empty() && orders.month_first().empty())
            return;
    }
    h.times.order = options.date_order;
    if (options.date_order != DateOrder::Unknown) return;
    const bool any =
        !orders.either().empty() || !orders.day_first().empty() || !orders.month_first().empty();
    if (!any) return;  // no rows: that is said later
    constexpr const char* kFix =
        "Write them as 2024-02-01, or say --date-order dmy or mdy (in a scenario [weather] "
        "date_order)";
    if (!orders.short_year().empty()) {
        throw Error("weather: column '" + shown(h.names[h.times.stamp]) + "' has dates as '" +
                        orders.short_year() + "', whose year has two digits: any part may be it",
                    std::string(kFix) + "; then the last part is the year, 1970 to 2069.");
    }
    if (!orders.day_first().empty() && !orders.month_first().empty()) {
        throw Error("weather: column '" + shown(h.names[h.times.stamp]) + "' has dates as '" +
                        orders.day_first() + "' and as '" + orders.month_first() +
                        "': day and month are not always in the same place",
                    std::string(kFix) + "; rows of the other order are then reported.");
    }
    h.times.order = orders.order();
    if (h.times.order == DateOrder::Unknown) {
        throw Error("weather: column '" + shown(h.names[h.times.stamp]) + "' has dates as '" +
                        orders.either() +
                        "', and no row shows whether the day or the month comes first",
                    std::string(kFix) + ".");
    }
    const bool day = h.times.order == DateOrder::DayFirst;
    rows.note(ReadNote::Kind::Info, 0, "time",
              std::string("dates are read as ") + (day ? "day/month/year" : "month/day/year") +
                  ", as '" + (day ? orders.day_first() : orders.month_first()) + "' can only be");
}

// Seconds that the amounts of each row stand for: those to the next one. Empty where the table has
// rates alone.
std::vector<double> seconds_of_amounts(const Header& h, const std::vector<TimedRow>& table_rows,
                                       RowCollector& rows)
{
    const auto has_amounts = [&](bool energy) {
        return std::any_of(h.meaning.begin(), h.meaning.end(), [&](const auto& m) {
            return m && m->amount &&
                   (field_info(m->field).unit == std::string_view("W/m2")) == energy;
        });
    };
    const bool energy = has_amounts(true);
    if (!energy && !has_amounts(false)) return {};
    std::vector<std::int64_t> times;
    for (const TimedRow& row : table_rows)
        if (row.timed && (times.empty() || row.time_us > times.back()))
            times.push_back(row.time_us);
    const std::int64_t usual_us = usual_step_us(times);
    std::vector<double> seconds;
    bool even = true;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const std::int64_t step_us = step_of_row_us(times, i, usual_us);
        even = even && step_us == usual_us;
        seconds.push_back(static_cast<double>(step_us) * 1e-6);
    }
    rows.note(ReadNote::Kind::Info, 0, energy ? "amounts" : "precip",
              std::string(energy ? "what falls or shines is" : "amounts are")
                  .append(" for the interval that begins at their row, ")
                  .append(std::to_string(usual_us / 1000000))
                  .append(even ? " s" : " s or as long as it is to the next one"));
    return seconds;
}

// Values of a row that only together make a field.
struct Parts {
    double snow_share = kMissing, vapour_pa = kMissing, air_k = kMissing, precip = kMissing;
};

void set_from_parts(RowCollector& rows, const Parts& p)
{
    if (!std::isnan(p.vapour_pa) && p.air_k > 173.15 && p.air_k < 333.15) {
        rows.set(Field::RelHumidity,
                 std::min(100.0 * p.vapour_pa / saturation_pressure_water_pa(p.air_k), 100.0));
    }
    if (p.snow_share >= 0.0 && p.snow_share <= 1.0 && !std::isnan(p.precip)) {
        rows.set(Field::Snow, p.precip * p.snow_share);
        rows.set(Field::Rain, p.precip * (1.0 - p.snow_share));
    }
}

// Words of cells, and how often each was seen.
using Words = std::map<std::string, std::size_t>;

// Numbers of nines alone that loggers write for "no value", and that some columns may have.
bool may_be_code(std::string_view text)
{
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    return text.size() >= 3 && text.substr(0, 3) == "999" &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return c == '9' || c == '.' || c == ','; });
}

// In a row where such a number stands for what it cannot be, it is one where it could be, too: the
// text; empty where there is none.
std::string_view code_of_row(const Header& h, const std::vector<std::string_view>& cells,
                             const PlainTable& table)
{
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!h.meaning[i] || !is_field(*h.meaning[i]) || !may_be_code(cells[i])) continue;
        const auto value = cell_number(cells[i], table);
        // Amounts are divided by seconds: of those hundreds of mm are enough.
        const ColumnMeaning& m = *h.meaning[i];
        const FieldInfo& info = field_info(m.field);
        const double si = value ? *value * m.scale + m.offset : 0.0;
        if (value && (m.amount ? si >= 999.0 : si > info.high)) return cells[i];
    }
    return {};
}

bool is_no_direction(std::string_view text)
{
    const std::string low = lower(text);
    return low == "calm" || low == "vrb" || low == "variable" || low == "var";
}
bool is_trace(std::string_view text)
{
    const std::string low = lower(text);
    return low == "t" || low == "tr" || low == "trace";
}

// What the cells of the table turned out to be, for notes below it.
struct Seen {
    Words missing, traces;
    std::vector<GaugeCount> counts;
    std::int64_t time_us = 0;  // of the row
};

void read_cell(std::string_view text, std::size_t column, const ColumnMeaning& m,
               const PlainTable& table, std::string_view code, double amount_s, RowCollector& rows,
               Parts& parts, Seen& seen)
{
    const bool field = is_field(m);
    if (is_missing_word(text) || (!code.empty() && text == code) ||
        (field && m.field == Field::WindFrom && is_no_direction(text))) {
        if (field) rows.missing(m.field);
        const std::string word(trimmed(text));
        ++seen.missing[word.empty() ? "an empty cell" : "'" + shown(word) + "'"];
        return;
    }
    auto value = cell_number(text, table);
    if (!value && field && m.field == Field::WindFrom) value = compass_deg(text);
    const bool falls =
        field && (m.field == Field::Precip || m.field == Field::Rain || m.field == Field::Snow);
    if (!value && falls && is_trace(text)) {
        ++seen.traces["'" + shown(text) + "'"];
        value = 0.0;
    }
    if (!value) {
        if (field) rows.unreadable(m.field, text);
    } else if (m.percent_snow) {
        parts.snow_share = *value;
    } else if (m.vapour_pressure) {
        parts.vapour_pa = *value;
    } else {
        double si = *value * m.scale + m.offset;
        if (m.amount) {
            seen.counts[column].add(si, seen.time_us);
            si /= amount_s;
        }
        if (m.field == Field::AirTemp) parts.air_k = si;
        if (m.field == Field::Precip) parts.precip = si;
        rows.set(m.field, si);
    }
}

// Rows that had to be put in order, rows that stand there twice, and clocks that jump.
void note_clock(const RowOrder& order, const std::vector<TimedRow>& rows, bool zoned,
                RowCollector& out)
{
    note_order(order, out);
    if (zoned) return;
    const SummerTime summer = summer_time(rows);
    if (summer.skipped.empty() && summer.repeated.empty()) return;
    std::string said = "the clock of the file ";
    if (!summer.skipped.empty()) said += "skips an hour on " + summer.skipped;
    if (!summer.repeated.empty())
        said +=
            (summer.skipped.empty() ? "repeats one on " : " and repeats one on ") + summer.repeated;
    out.note(
        ReadNote::Kind::Warning, 0, "time",
        said +
            ": it seems to keep summer time, which is not taken away; write UTC or standard time, "
            "or +01:00 behind each time");
}

}  // namespace

static void read_forcing_csv(std::string_view text, RowCollector& rows, const ReadOptions& options)
{
    const PlainTable table(text);
    read_place(text, table, rows);
    Header h = read_header(table, rows, options);
    find_date_order(h, table, rows, options);
    RowOrder order;
    const std::vector<TimedRow> table_rows = rows_in_order(table, h.times, order);
    const std::vector<double> amount_s = seconds_of_amounts(h, table_rows, rows);

    Seen seen;
    seen.counts.resize(h.names.size());
    std::size_t plain_numbers = 0;  // where a time should be
    bool zoned = true;
    std::size_t stamp_length = 0, other_zone = 0;  // of the first row; rows that differ in naming it
    std::vector<std::string_view> cells;
    for (const TimedRow& row : table_rows) {
        table.cells(row.text, cells);
        if (cells.size() != h.names.size()) {
            rows.wrong_columns(row.line, cells.size(), h.names.size());
            continue;
        }
        if (!row.timed) {
            const std::string found = h.times.shown_cells(cells);
            plain_numbers += to_number(found).has_value();
            const char* order_said = h.times.order == DateOrder::DayFirst     ? " (day/month/year)"
                                     : h.times.order == DateOrder::MonthFirst ? " (month/day/year)"
                                                                              : "";
            rows.bad_row(row.line, "time",
                         "'" + found + "' is not a date and time as 2005-10-01T06:00" + order_said);
            continue;
        }
        if (!rows.begin_row(row.time_us, row.line)) continue;
        // NetCDF and GRIB come through here, with times that say UTC whatever they meant.
        if (rows.rows() == 1 && rows.report().format == "forcing CSV") {
            zoned = h.times.name_zone(h.names, cells);
            if (zoned)
                rows.times_name_their_zone();
            else if (std::isnan(options.utc_offset_h) && std::isnan(rows.site().utc_offset_h))
                rows.note(ReadNote::Kind::Info, row.line, "time",
                          "the times name no zone: taken as UTC; --file-zone HOURS says another");
        }
        if (h.times.stamp != CsvTimes::kNone) {
            const std::size_t length = trimmed(cells[h.times.stamp]).size();
            if (stamp_length == 0) stamp_length = length;
            // A zone takes place: times as long as the first are as it is.
            other_zone += length != stamp_length && h.times.name_zone(h.names, cells) != zoned;
        }
        const double row_s = amount_s.empty() ? 0.0 : amount_s[rows.rows() - 1];
        const std::string_view code = code_of_row(h, cells, table);
        Parts parts;
        seen.time_us = row.time_us;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (h.meaning[i])
                read_cell(cells[i], i, *h.meaning[i], table, code, row_s, rows, parts, seen);
        }
        set_from_parts(rows, parts);
    }
    note_clock(order, table_rows, zoned, rows);
    if (other_zone > 0 && rows.report().format == "forcing CSV") {
        const std::size_t without = zoned ? other_zone : rows.rows() - other_zone;
        rows.note(ReadNote::Kind::Warning, 0, "time",
                  std::to_string(without) + " of " + std::to_string(rows.rows()) +
                      " times name no zone, the others do: they are taken as UTC; "
                      "write a zone behind all of them or behind none");
    }
    const auto& counts = seen.counts;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const bool by_day = counts[i].counts_up_by_day();
        if (!by_day && !counts[i].counts_up()) continue;
        throw Error(
            "weather: column '" + shown(h.names[i]) + "' never falls while it rises again and again" +
                (by_day ? ", but where a day begins: a total of the day, not that of each row"
                        : ": a total since some beginning, not that of each row"),
            "Give the differences of its rows, or leave it out with --ignore " + shown(h.names[i]) +
                ".");
    }
    if (rows.rows() == 0 && plain_numbers > 0 && h.times.stamp != CsvTimes::kNone) {
        throw Error(
            "weather: column '" + shown(h.names[h.times.stamp]) +
                "' holds plain numbers, not dates and times",
            "Give times as 2005-10-01T06:00; for keys of the artist model, name the columns "
            "time_s,temperature_c,rainfall.");
    }
    for (const auto& [word, count] : seen.traces)
        rows.note(ReadNote::Kind::Info, 0, "precip",
                  word + " is a trace, taken as 0, " + std::to_string(count) + " times");
    for (const auto& [code, count] : seen.missing) {
        rows.note(ReadNote::Kind::Info, 0, "missing",
                  std::string(code)
                      .append(" means no value, ")
                      .append(std::to_string(count))
                      .append(" times"));
    }
}

namespace {

bool recognise(const FileHead& head)
{
    for (std::size_t i = 0; i < head.lines.size(); ++i) {
        const std::string low = lower(trimmed(head.lines[i]));
        if (low.rfind("#", 0) == 0) continue;
        // A table with unnamed times: its header begins with a separator.
        if (head.lines[i].find_first_of(",;\t") == 0 && i + 1 < head.lines.size() &&
            head.lines[i + 1].find_first_of("0123456789") == 0) {
            return true;
        }
        const bool dated = low.find("time") != std::string::npos ||
                           low.find("date") != std::string::npos || low.rfind("year", 0) == 0;
        if (dated && low.find_first_of(",;\t") != std::string::npos) return true;
        break;
    }
    // Below a title, or between blanks.
    const PlainTable table(head.text);
    Lines below = table.rows();
    return is_plain_header(table.header, below.next().value_or(""));
}

}  // namespace

extern const Reader forcing_csv_reader;
const Reader forcing_csv_reader{"forcing CSV",
                                "any table with a time column and units in its header", recognise,
                                read_forcing_csv};

}  // namespace petrichor::weather
