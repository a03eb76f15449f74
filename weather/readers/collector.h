#ifndef PETRICHOR_WEATHER_READERS_COLLECTOR_H
#define PETRICHOR_WEATHER_READERS_COLLECTOR_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "weather/forcing/forcing.h"

namespace petrichor::weather {

/// Gathers the rows of a file while it is read: checks every value and time, remembers what was
/// wrong, and makes a table out of what was right. Used by every reader.
class RowCollector {
public:
    explicit RowCollector(std::string format);

    Site& site() { return site_; }
    ReadReport& report() { return report_; }

    /// Begins a row at a time. Rows must come in order; one that does not is dropped and noted.
    /// Returns whether the row was accepted; values of a refused row are ignored.
    bool begin_row(std::int64_t time_us, std::size_t line);
    /// A row that could not be read at all.
    void bad_row(std::size_t line, const std::string& field, const std::string& why);
    /// Value of the current row, SI. Out of range: noted and left missing.
    void set(Field field, double value);
    /// The file says that the value is missing.
    void missing(Field field);
    /// The file's text could not be read as a number.
    void unreadable(Field field, std::string_view text);
    /// Amount (kg/m2) that fell in the `hours` before the current row's time.
    void fell_before(Field field, double amount_kg_m2, double hours);
    /// Values of this field are means of the interval that ends at the row's time.
    void means_of_past(Field field) { past_mean_[static_cast<std::size_t>(field)] = true; }
    /// Values of this field hold `seconds` after (or, negative, before) the row's time.
    void holds_after(Field field, double seconds)
    {
        held_after_s_[static_cast<std::size_t>(field)] = seconds;
    }
    void note(ReadNote::Kind kind, std::size_t line, std::string field, std::string text);

    std::size_t rows() const { return times_.size(); }
    /// Name of the current row's line for messages.
    std::size_t line() const { return line_; }

    /// The table and the report.
    ///   throws  Error listing the problems with their lines, when nothing useful was read or more
    ///   than a
    ///           tenth of the rows (and more than two) were bad
    ForcingTable finish();

private:
    struct Fallen {
        std::size_t row;
        Field field;
        double amount, hours;
    };
    std::size_t report_index(Field field);
    void spread_amounts(ForcingTable& table);

    Site site_;
    ReadReport report_;
    std::vector<std::int64_t> times_;
    std::array<std::vector<double>, kFieldCount> values_;
    std::array<std::size_t, kFieldCount> report_of_{};
    std::array<bool, kFieldCount> past_mean_{};
    std::array<double, kFieldCount> held_after_s_{};
    std::vector<Fallen> fallen_;
    std::vector<std::string> problems_;
    std::size_t line_ = 0;
    bool in_row_ = false;
};

}  // namespace petrichor::weather

#endif
