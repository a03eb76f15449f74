#include "weather/readers/table_rows.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace petrichor::weather {
namespace {

constexpr std::size_t kMostCells = 4096;
constexpr std::size_t kMostTold = 5;

}  // namespace

void for_dated_rows(Lines& lines, const DatedRows& how, RowCollector& rows,
                    const std::function<void(const DatedRow&)>& use)
{
    Cells cells;
    std::vector<TimedRow> found;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, how.separator, cells, kMostCells);
        if (how.skip && how.skip(cells)) continue;
        if (const auto us = how.time_of(cells))
            found.push_back({*line, lines.number(), *us, true});
        else
            rows.bad_row(lines.number(), "time", "'" + shown(*line) + "' " + how.lacks);
    }
    note_order(put_in_order(found, false), rows);
    for (const TimedRow& row : found) {
        split(row.text, how.separator, cells, kMostCells);
        use({row.time_us, row.line, cells});
    }
}

std::vector<TimedRow> oldest_first(
    Lines& lines, const std::function<std::optional<RowDate>(std::string_view)>& date_of,
    RowCollector& rows)
{
    // Only compared, so that days which no month has need no care.
    constexpr std::int64_t kPart = 10000, kYear = kPart * kPart;
    std::vector<TimedRow> found;
    bool falls = false, rises = false, days_fall = false;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        TimedRow row{*line, lines.number(), found.empty() ? 0 : found.back().time_us, false};
        const auto date = date_of(*line);
        if (date && std::all_of(date->begin(), date->end(),
                                [](long long part) { return part >= 0 && part < 10000; })) {
            const auto& [year, month, day, hour, minute] = *date;
            row.time_us = year * kYear + (month * 40 + day) * kPart + hour * 100 + minute;
            row.timed = true;
            falls = falls || (!found.empty() && row.time_us < found.back().time_us);
            rises = rises || (!found.empty() && row.time_us > found.back().time_us);
            days_fall = days_fall || (!found.empty() &&
                                      row.time_us % kYear < found.back().time_us % kYear);
        }
        found.push_back(row);
    }
    // Years alone that fall are those of a typical year.
    if (falls && !days_fall) return found;
    if (falls && rises) {
        // Months of different years: their days alone may still fall from end to end.
        std::vector<TimedRow> by_day = found;
        for (TimedRow& row : by_day) row.time_us %= kYear;
        const RowOrder order = put_in_order(by_day, false);
        if (order.newest_first) {
            note_order(order, rows);
            return by_day;
        }
    }
    note_order(put_in_order(found, false), rows);
    return found;
}

double usual_step_h(Lines lines, const DatedRows& how)
{
    std::vector<TimedRow> rows;
    Cells cells;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, how.separator, cells, kMostCells);
        if (how.skip && how.skip(cells)) continue;
        if (const auto us = how.time_of(cells)) rows.push_back({*line, lines.number(), *us, true});
    }
    put_in_order(rows, false);
    std::vector<std::int64_t> times;
    for (const TimedRow& row : rows)
        if (times.empty() || row.time_us > times.back()) times.push_back(row.time_us);
    return static_cast<double>(usual_step_us(times)) / 3600e6;
}

std::optional<double> number_or_none(std::string_view cell,
                                     std::initializer_list<std::string_view> none)
{
    const auto text = trimmed(cell);
    if (text.empty() || std::find(none.begin(), none.end(), text) != none.end())
        return std::nullopt;
    return to_number(text).value_or(kMissing);
}

void put_cell(const TableColumn& column, std::string_view cell, std::optional<double> value,
              RowCollector& rows)
{
    if (!value)
        rows.missing(column.field);
    else if (std::isnan(*value))
        rows.unreadable(column.field, cell);
    else if (column.fell_hours > 0.0)
        rows.fell_before(column.field, *value * column.scale, column.fell_hours);
    else
        rows.set(column.field, *value * column.scale + column.offset);
}

void put_value(Field field, double si, RowCollector& rows)
{
    if (std::isnan(si))
        rows.missing(field);
    else
        rows.set(field, si);
}

std::optional<double> compass_deg(std::string_view text)
{
    constexpr const char* kPoints[] = {"n", "nne", "ne", "ene", "e", "ese", "se", "sse",
                                       "s", "ssw", "sw", "wsw", "w", "wnw", "nw", "nnw"};
    const std::string low = lower(text);
    for (int i = 0; i < 16; ++i)
        if (low == kPoints[i]) return 22.5 * i;
    return std::nullopt;
}

DateOrder date_order_of(Lines lines, char separator, std::size_t stamp, const char* format,
                        const ReadOptions& options)
{
    if (options.date_order != DateOrder::Unknown) return options.date_order;
    DateOrders orders;
    Cells cells;
    while (const auto line = lines.next()) {
        if (trimmed(*line).empty()) continue;
        split(*line, separator, cells, kMostCells);
        orders.add(cell_of(cells, stamp));
    }
    if (orders.order() != DateOrder::Unknown) return orders.order();
    if (orders.either().empty()) return DateOrder::Unknown;
    throw Error(std::string("weather: ") + format + ": dates are as '" + orders.either() +
                    "', and no row shows whether the day or the month comes first",
                "Say --date-order dmy or mdy (in a scenario [weather] date_order).");
}

void OneStation::check(const char* format, const char* how) const
{
    if (!others_ || (asked_ && found_)) return;
    throw Error("weather: " + std::string(format) + ": several stations in the file" +
                    (found_ ? std::string() : ", and not '" + shown(name_) + "'"),
                "Say which one with --station, " + std::string(how) + ".");
}

double OddCells::number_of(std::string_view cell, std::size_t line, const char* name)
{
    const double value = to_number(cell).value_or(kMissing);
    if (std::isnan(value) && !trimmed(cell).empty() && ++count_ <= kMostTold)
        rows_->note(ReadNote::Kind::OutOfRange, line, name,
                    "'" + shown(cell) + "' is not a number, taken as missing");
    return value;
}

}  // namespace petrichor::weather
