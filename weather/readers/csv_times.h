#ifndef PETRICHOR_WEATHER_READERS_CSV_TIMES_H
#define PETRICHOR_WEATHER_READERS_CSV_TIMES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace petrichor::weather {

/// Which comes first in dates such as 01/02/2024.
enum class DateOrder : std::uint8_t { Unknown, DayFirst, MonthFirst };

/// Where the rows of a CSV say when they are: one column ("time", "datetime", "valid_time", ..), a
/// date and a clock ("date,time", "date,hour"), or parts ("year,month,day,hour,minute" or
/// "year,doy,hour").
struct CsvTimes {
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    enum Part : std::uint8_t { Year, Month, Day, DayOfYear, Hour, Minute, Second, kParts };

    std::size_t stamp = kNone;  ///< the one column, or the date
    std::size_t clock = kNone;  ///< beside a date
    std::array<std::size_t, kParts> part = {kNone, kNone, kNone, kNone, kNone, kNone, kNone};

    DateOrder order =
        DateOrder::Unknown;  ///< of 01/02/2024; such times are none while it is unknown

    bool found() const { return stamp != kNone || part[Year] != kNone; }
    /// Whether a column says when its row is, so that it says nothing else.
    bool uses(std::size_t column) const;
    /// The time of a row with as many cells as the header has names; nothing when it is none.
    std::optional<std::int64_t> time_of(const std::vector<std::string_view>& cells) const;
    /// Whether the times of such a row say their zone, by their header or by themselves.
    bool name_zone(const std::vector<std::string_view>& names,
                   const std::vector<std::string_view>& cells) const;
    /// The cells that time_of reads, for a message.
    std::string shown_cells(const std::vector<std::string_view>& cells) const;
};

/// Finds them by name. A first column without a name counts when it holds times: `first_row` is the
/// line below the header.
CsvTimes find_csv_times(const std::vector<std::string_view>& names,
                        const std::vector<std::string_view>& first_row);

/// Whether a cell with a date and time says its zone: Z, UTC, +01:00, or seconds since 1970.
bool names_zone(std::string_view text, DateOrder order = DateOrder::Unknown);

/// A date and time in one cell: ISO 8601; 31.12.2024 or 31.12.24, 2-Jan-2021, Jan 2 2021 or January
/// 2, 2021, and with an order 1/2/2021, 01-02-2021 or 1/2/21 (1970 to 2069), with 13:00, 13:00:15 or
/// 1:00 PM behind them; 2021010206 with or without minutes and seconds; seconds or milliseconds
/// since 1970.
std::optional<std::int64_t> time_of_cell(std::string_view text,
                                         DateOrder order = DateOrder::Unknown);

/// Which order the dates of a column have, by those whose one part is above 12. An example of each
/// kind; empty where there is none.
class DateOrders {
public:
    void add(std::string_view cell);
    /// Unknown where no date shows it, or where they contradict each other.
    DateOrder order() const;
    const std::string& either() const { return either_; }
    const std::string& day_first() const { return day_first_; }
    const std::string& month_first() const { return month_first_; }
    /// One whose year has two digits: 20/02/04 may begin with its year as well.
    const std::string& short_year() const { return short_year_; }

private:
    std::string either_, day_first_, month_first_, short_year_;
};

}  // namespace petrichor::weather

#endif
