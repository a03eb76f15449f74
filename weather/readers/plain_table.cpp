#include "weather/readers/plain_table.h"

#include <algorithm>

#include "base/error.h"
#include "weather/readers/units.h"

namespace petrichor::weather {

namespace {

constexpr std::size_t kMostColumns = 256;
constexpr std::size_t kMostTitleLines = 20;

bool is_comment(std::string_view line)
{
    const auto t = trimmed(line);
    return t.empty() || t.front() == '#';
}

char separator_of(std::string_view header)
{
    char separator = ' ';
    std::ptrdiff_t most = 0;
    for (const char c : {',', ';', '\t'}) {
        const auto n = std::count(header.begin(), header.end(), c);
        if (n > most) {
            most = n;
            separator = c;
        }
    }
    return separator;
}

void cut(std::string_view line, char separator, std::vector<std::string_view>& out)
{
    if (separator == ' ')
        words(line, out, kMostColumns);
    else
        split(line, separator, out, kMostColumns);
}

// Whether a name means weather, with this unit or its own.
enum class Known : std::uint8_t { No, Yes, UnitIsNot };
Known known(std::string_view name, std::string_view unit = {})
{
    try {
        return column_meaning(name, unit) ? Known::Yes : Known::No;
    } catch (const Error&) {
        return Known::UnitIsNot;
    }
}

bool is_time(std::string_view cell)
{
    return time_of_cell(cell, DateOrder::DayFirst) || time_of_cell(cell, DateOrder::MonthFirst);
}

// A line of words alone: below the names it is no row of values.
bool is_words(const std::vector<std::string_view>& cells)
{
    bool any = false;
    for (const auto cell : cells) {
        const std::string low = lower(cell);
        if (low.empty() || low == "-" || low == "na" || low == "nan") continue;
        if (to_number(cell) || is_time(cell)) return false;
        // "-6,3", "1:00 PM"
        if (cell.front() >= '0' && cell.front() <= '9') return false;
        if (cell.size() > 1 && cell.front() == '-' && cell[1] >= '0' && cell[1] <= '9')
            return false;
        any = true;
    }
    return any;
}

// "-6,3": a comma with digits on both sides and nothing else. `thousands` where three follow it.
bool has_comma_inside(std::string_view cell, bool& thousands)
{
    const auto comma = cell.find(',');
    if (comma == std::string_view::npos || comma + 1 == cell.size()) return false;
    std::string_view left = cell.substr(0, comma);
    const std::string_view right = cell.substr(comma + 1);
    if (!left.empty() && (left.front() == '-' || left.front() == '+')) left.remove_prefix(1);
    const auto digits = [](std::string_view t) {
        return !t.empty() &&
               std::all_of(t.begin(), t.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    if (!digits(left) || !digits(right)) return false;
    thousands = right.size() == 3 && left.size() <= 3;
    return true;
}

}  // namespace

bool is_plain_header(std::string_view line, std::string_view next)
{
    std::vector<std::string_view> names, first;
    const char separator = separator_of(line);
    cut(line, separator, names);
    if (names.size() < 2) return false;
    cut(next, separator, first);
    if (!find_csv_times(names, first).found()) return false;
    return std::any_of(names.begin(), names.end(),
                       [](std::string_view name) { return known(name) != Known::No; });
}

PlainTable::PlainTable(std::string_view text) : below_(text)
{
    // The line that is a header beyond doubt, else the first one: what it lacks is said then.
    Lines lines(text);
    Lines first_below = lines;
    std::size_t first_line = 0, looked = 0;
    std::string_view first;
    bool found = false;
    while (const auto line = lines.next()) {
        if (is_comment(*line)) continue;
        if (first_line == 0) {
            first_line = lines.number();
            first = *line;
            first_below = lines;
        }
        Lines below = lines;
        if (is_plain_header(*line, below.next().value_or(""))) {
            header_line = lines.number();
            header = *line;
            below_ = lines;
            found = true;
            break;
        }
        if (++looked > kMostTitleLines) break;
    }
    if (first_line == 0) return;
    if (!found) {
        header_line = first_line;
        header = first;
        below_ = first_below;
    } else if (first_line != header_line) {
        title_line = first_line;
        title = first;
    }
    separator = separator_of(header);
    cut(header, separator, names);
    take_units();
    find_decimal_comma();
    // A separator behind the last name, and nothing behind that of the rows: no column.
    Lines below = below_;
    std::vector<std::string_view> row;
    cut(below.next().value_or(""), separator, row);
    if (names.size() > 2 && names.back().empty() && row.size() <= names.size() &&
        (row.size() < names.size() || row.back().empty()))
        names.pop_back();
}

void PlainTable::take_units()
{
    std::vector<std::string_view> units;
    bool taken = false;
    // Loggers write a line of units and one of how values were averaged.
    for (int i = 0; i < 2; ++i) {
        Lines lines = below_;
        const auto line = lines.next();
        if (!line) return;
        cut(*line, separator, units);
        if (units.size() != names.size() || !is_words(units)) return;
        const bool any = std::any_of(units.begin(), units.end(), [&](const std::string_view& unit) {
            const auto at = static_cast<std::size_t>(&unit - units.data());
            // A name that says its own unit takes any other.
            return !unit.empty() && known(names[at], unit) == Known::Yes &&
                   known(names[at], "no unit") == Known::UnitIsNot;
        });
        if (!taken && any) {
            for (std::size_t c = 0; c < names.size(); ++c) {
                if (units[c].empty() || known(names[c], "no unit") != Known::UnitIsNot) continue;
                named_with_units.push_back(std::string(names[c]) + " (" + std::string(units[c]) +
                                           ")");
                names[c] = named_with_units.back();
            }
            taken = true;
            units_line = lines.number();
        }
        below_ = lines;
    }
}

void PlainTable::find_decimal_comma()
{
    if (separator != ',') {
        decimal_comma = true;
        return;
    }
    constexpr int kRows = 500;
    Lines lines = below_;
    std::vector<std::string_view> row;
    bool any = false;
    for (int i = 0; i < kRows; ++i) {
        const auto line = lines.next();
        if (!line) break;
        if (line->find('"') == std::string_view::npos) continue;
        cut(*line, separator, row);
        for (const auto cell : row) {
            if (cell.find('.') != std::string_view::npos && to_number(cell)) return;
            bool thousands = false;
            any = any || (has_comma_inside(cell, thousands) && !thousands);
        }
    }
    decimal_comma = any;
}

void PlainTable::cells(std::string_view line, std::vector<std::string_view>& out) const
{
    cut(line, separator, out);
    if (separator != ' ' && out.size() == names.size() + 1 && out.back().empty()) out.pop_back();
}

std::optional<double> cell_number(std::string_view text, const PlainTable& table)
{
    const auto value = to_number(text);
    if (value || !table.decimal_comma || std::count(text.begin(), text.end(), ',') != 1)
        return value;
    std::string point;
    std::size_t since = 0;  // digits since the last point between thousands
    bool grouped = false;
    for (const char c : text) {
        if (c == '.') {
            if (grouped && since != 3) return std::nullopt;
            grouped = true;
            since = 0;
        } else if (c == ',') {
            if (grouped && since != 3) return std::nullopt;
            grouped = false;
            point += '.';
        } else {
            point += c;
            ++since;
        }
    }
    if (grouped) return std::nullopt;
    return to_number(point);
}

RowOrder put_in_order(std::vector<TimedRow>& rows, bool all)
{
    RowOrder order;
    const TimedRow* last = nullptr;
    bool rises = false;
    for (const TimedRow& row : rows) {
        if (!row.timed) continue;
        if (last) {
            order.moved += row.time_us < last->time_us;
            rises = rises || row.time_us > last->time_us;
        }
        last = &row;
    }
    order.newest_first = order.moved > 0 && !rises;
    if (!order.newest_first && !all) order.moved = 0;
    if (order.moved > 0) {
        std::stable_sort(rows.begin(), rows.end(), [](const TimedRow& a, const TimedRow& b) {
            return a.time_us < b.time_us;
        });
    }
    const auto same = [](const TimedRow& a, const TimedRow& b) {
        return a.timed && b.timed && a.time_us == b.time_us && trimmed(a.text) == trimmed(b.text);
    };
    const auto end = std::unique(rows.begin(), rows.end(), same);
    order.repeated = static_cast<std::size_t>(rows.end() - end);
    rows.erase(end, rows.end());
    return order;
}

void note_order(const RowOrder& order, RowCollector& out)
{
    if (order.moved > 0) {
        out.note(ReadNote::Kind::Time, 0, "time",
                 order.newest_first ? std::string("the newest row stands first: read from the end")
                                    : std::to_string(order.moved) +
                                          (order.moved == 1 ? " row stands" : " rows stand") +
                                          " behind a later one: read in the order of their times");
    }
    if (order.repeated > 0) {
        out.note(ReadNote::Kind::Time, 0, "time",
                 std::to_string(order.repeated) +
                     (order.repeated == 1 ? " row stands" : " rows stand") +
                     " in the file again, letter by letter: read once");
    }
}

std::vector<TimedRow> rows_in_order(const PlainTable& table, const CsvTimes& times, RowOrder& order)
{
    std::vector<TimedRow> rows;
    std::vector<std::string_view> cells;
    Lines lines = table.rows();
    std::int64_t last = 0;
    while (const auto line = lines.next()) {
        if (is_comment(*line)) continue;
        TimedRow row{*line, lines.number(), last, false};
        table.cells(*line, cells);
        if (cells.size() == table.names.size()) {
            if (const auto us = times.time_of(cells)) {
                row.time_us = *us;
                row.timed = true;
            }
        }
        if (row.timed) last = row.time_us;
        rows.push_back(row);
    }
    order = put_in_order(rows, true);
    return rows;
}

SummerTime summer_time(const std::vector<TimedRow>& rows)
{
    constexpr std::int64_t kHour_us = 3600LL * 1000000, kDay_us = 24 * kHour_us;
    constexpr std::size_t kOtherGaps = 2;
    SummerTime found;
    std::int64_t step = kHour_us;
    std::size_t other_gaps = 0;  // as long, at other times
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (!rows[i].timed || !rows[i - 1].timed) continue;
        const std::int64_t at = rows[i - 1].time_us, apart = rows[i].time_us - at;
        const std::int64_t day = at / kDay_us, of_day = at % kDay_us;
        // 1970-01-01 was a Thursday; clocks change between 1 and 3 h of a Sunday in spring or
        // autumn.
        const bool sunday = at >= 0 && (day + 4) % 7 == 0 && of_day < 4 * kHour_us;
        if (sunday && step <= kHour_us) {
            const int month = civil_from_us(at).month;
            const bool season = (month >= 3 && month <= 4) || (month >= 9 && month <= 11);
            std::string& said = apart == 0 ? found.repeated : found.skipped;
            if (season && said.empty() && (apart == 0 || apart == step + kHour_us))
                said = iso_from_us(at).substr(0, 10);
        } else {
            other_gaps += apart == step + kHour_us;
        }
        if (apart > 0 && (apart < step || i == 1)) step = apart;
    }
    if (other_gaps > kOtherGaps && found.repeated.empty()) found.skipped.clear();
    return found;
}

}  // namespace petrichor::weather
