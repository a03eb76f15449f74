#ifndef PETRICHOR_WEATHER_READERS_TABLE_ROWS_H
#define PETRICHOR_WEATHER_READERS_TABLE_ROWS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "weather/readers/csv_times.h"
#include "weather/readers/plain_table.h"
#include "weather/readers/tables.h"

// Rows and cells of tables: what read_table_rows is made of, for readers that walk their rows by
// themselves because a row needs more than its columns, as those of services do: several stations,
// intervals with two times, units that are known only at the end.
namespace petrichor::weather {

using Cells = std::vector<std::string_view>;

/// Rows below a header.
struct DatedRows {
    char separator = ',';
    /// When a row is; nothing: a bad row.
    std::function<std::optional<std::int64_t>(const Cells&)> time_of;
    std::function<bool(const Cells&)> skip{};  ///< rows of other stations; may be empty
    const char* lacks = "has no time";         ///< said of a bad row
};
/// One of them.
struct DatedRow {
    std::int64_t time_us = 0;
    std::size_t line = 0;
    const Cells& cells;
};
/// Calls `use` for every row that has a time; empty lines are passed over, bad rows told. A table whose
/// newest row stands first is read from its end, a row that stands there again at once is read once.
void for_dated_rows(Lines& lines, const DatedRows& how, RowCollector& rows,
                    const std::function<void(const DatedRow&)>& use);

/// Year, month, day, hour and minute that a row writes, in the file's own clock.
using RowDate = std::array<long long, 5>;
/// The lines that are left, empty ones out, for readers that take them one by one: oldest first where they
/// stand newest first from end to end, in a typical year by their days alone; a line that stands there
/// again at once only once. What was done is noted.
///   date_of  nothing: the line stays behind the one that it follows
std::vector<TimedRow> oldest_first(
    Lines& lines, const std::function<std::optional<RowDate>(std::string_view)>& date_of,
    RowCollector& rows);

/// The usual distance of the rows below a header, hours; rows out of order do not count.
double usual_step_h(Lines lines, const DatedRows& how);

/// Number of a cell: nothing where it is empty or one of `none`, NaN where it is no number.
std::optional<double> number_or_none(std::string_view cell,
                                     std::initializer_list<std::string_view> none = {});

/// Puts the number of a cell into the current row as its column says: nothing is missing, NaN
/// unreadable.
void put_cell(const TableColumn& column, std::string_view cell, std::optional<double> value,
              RowCollector& rows);

/// A value of the current row in SI; NaN is missing.
void put_value(Field field, double si, RowCollector& rows);

/// Where wind comes from in words, degrees: N, NNE, .. NNW; nothing for other words.
std::optional<double> compass_deg(std::string_view text);

/// Which of day and month comes first in a column of dates: as asked, or as a row shows.
///   throws  Error where no row does, with the name of the format
DateOrder date_order_of(Lines lines, char separator, std::size_t stamp, const char* format,
                        const ReadOptions& options);

/// One station of a table that may hold several: the one that was asked for, else the first.
class OneStation {
public:
    ///   station  asked for; empty: nobody asked
    explicit OneStation(const std::string& station) : name_(station), asked_(!station.empty()) {}
    /// Whether a row is of another station.
    bool is_other(std::string_view who)
    {
        if (name_.empty()) name_ = std::string(who);
        (who == name_ ? found_ : others_) = true;
        return who != name_;
    }
    const std::string& name() const { return name_; }
    /// Once all rows were seen.
    ///   how     "by its number", how stations are named
    ///   throws  Error where several are there and none of them was asked for
    void check(const char* format, const char* how) const;

private:
    std::string name_;
    bool asked_, found_ = false, others_ = false;
};

/// Cells that are no numbers, the first few of which are told.
class OddCells {
public:
    explicit OddCells(RowCollector& rows) : rows_(&rows) {}
    /// The number of a cell, NaN where it has none.
    double number_of(std::string_view cell, std::size_t line, const char* name);

private:
    RowCollector* rows_;
    std::size_t count_ = 0;
};

/// Columns of numbers that a reader gathers in rows of its own, until it knows what they mean.
template <class Row>
struct NumberColumn {
    const char* name;
    double Row::*value;
};
template <class Row>
class NumberColumns {
public:
    NumberColumns(const TableHeader& header, std::span<const NumberColumn<Row>> columns,
                  RowCollector& rows)
        : columns_(columns), odd_(rows)
    {
        for (const NumberColumn<Row>& c : columns) at_.push_back(header.at(c.name));
    }
    void read(const Cells& cells, std::size_t line, Row& row)
    {
        for (std::size_t i = 0; i < at_.size(); ++i)
            row.*columns_[i].value = odd_.number_of(cell_of(cells, at_[i]), line, columns_[i].name);
    }

private:
    std::span<const NumberColumn<Row>> columns_;
    std::vector<std::size_t> at_;
    OddCells odd_;
};

}  // namespace petrichor::weather

#endif
