#ifndef PETRICHOR_WEATHER_READERS_PLAIN_TABLE_H
#define PETRICHOR_WEATHER_READERS_PLAIN_TABLE_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weather/readers/collector.h"
#include "weather/readers/csv_times.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

/// How a plain table is laid out: a line of names, which may stand below a title and above a line
/// of units, and rows of cells. # begins a comment.
struct PlainTable {
    std::size_t title_line = 0;  ///< the first line above the names that is no comment; 0: none
    std::string_view title;
    std::size_t header_line = 0;  ///< of the names; 0: the text has none
    std::string_view header;
    std::size_t units_line = 0;           ///< of the units below them; 0: none
    char separator = ',';                 ///< , ; tab, or a blank for any number of blanks
    bool decimal_comma = false;           ///< "-6,3" is a number
    std::vector<std::string_view> names;  ///< with the units of the line below, where it says them
    std::deque<std::string> named_with_units;  ///< holds those

    explicit PlainTable(std::string_view text);
    PlainTable(const PlainTable&) = delete;  // names look into named_with_units
    PlainTable& operator=(const PlainTable&) = delete;

    /// The lines below the names and units.
    Lines rows() const { return below_; }
    /// The cells of a row; an empty one behind a last separator is none, where the names have none.
    void cells(std::string_view line, std::vector<std::string_view>& out) const;

private:
    Lines below_;
    void take_units();
    void find_decimal_comma();
};

/// Whether the line is a header: names of times and at least one of weather. `next` is the line
/// below it.
bool is_plain_header(std::string_view line, std::string_view next);

/// A number of a table: a comma may be the decimal point where it is no separator, with points
/// between thousands then.
std::optional<double> cell_number(std::string_view text, const PlainTable& table);

/// A row of a table and when it is.
struct TimedRow {
    std::string_view text;
    std::size_t line = 0;
    std::int64_t time_us = 0;
    bool timed = false;  ///< its time could be read
};

/// What rows_in_order had to do.
struct RowOrder {
    std::size_t moved = 0;      ///< rows that stood behind a later one
    bool newest_first = false;  ///< all of them
    std::size_t repeated = 0;   ///< rows that stand in the table again, letter by letter: left out
};

/// Puts rows in the order of their times and takes out those that stand there again. Of rows that
/// are neither in order nor newest first throughout only where `all` are meant to be sorted: in a
/// file of an archive they may be those of two stations.
RowOrder put_in_order(std::vector<TimedRow>& rows, bool all);
void note_order(const RowOrder& order, RowCollector& out);

/// Rows in the order of their times, those without one behind the row that they follow.
std::vector<TimedRow> rows_in_order(const PlainTable& table, const CsvTimes& times,
                                    RowOrder& order);

/// Local days, as 2004-03-28, on which the clock of the rows skips an hour early on a Sunday, and
/// on which it repeats one: summer time. Empty: none.
struct SummerTime {
    std::string skipped, repeated;
};
SummerTime summer_time(const std::vector<TimedRow>& rows);

}  // namespace petrichor::weather

#endif
