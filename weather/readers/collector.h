#ifndef PETRICHOR_WEATHER_READERS_COLLECTOR_H
#define PETRICHOR_WEATHER_READERS_COLLECTOR_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "weather/forcing/forcing.h"

namespace petrichor::weather {

/// The step of a series: its median, or what nearly all steps are below where that is two hours at
/// most. An hour for less than two times.
std::int64_t usual_step_us(const std::vector<std::int64_t>& time_us);
/// How long the values of a row hold: to the next row, or the usual step where that is a gap (more
/// than one and a half of it) and for the last row.
std::int64_t step_of_row_us(const std::vector<std::int64_t>& time_us, std::size_t row,
                            std::int64_t usual_us);

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
    /// One with another number of columns than the header.
    void wrong_columns(std::size_t line, std::size_t has, std::size_t wants);
    /// A day that a year put together from several has not.
    void leap_day_left_out(std::size_t line);
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
    /// Rows with the time of the row before add to it what it lacks; without this they are bad.
    void join_same_times() { join_same_times_ = true; }
    /// Rate that present weather of the current row stands for, kg m-2 s-1; used only when
    /// use_seen_precipitation(true) is called, for files without any amount.
    void precipitation_seen(double kg_m2_s);
    void use_seen_precipitation(bool use) { use_seen_ = use; }
    /// A column that no reader of this format understands. It is a problem where its name speaks of
    /// weather and it is not ignored (ReadOptions::ignore), else a note.
    void unknown_column(std::string_view name, const std::vector<std::string>& ignored);
    /// Columns of a known format that were not read, for a note: all, or of a long header those
    /// whose names speak of weather.
    void unread_columns(const std::vector<std::string>& names);
    bool has_strange_columns() const { return !strange_columns_.empty(); }
    ///   throws  Error that names the columns of unknown_column that are a problem
    void check_columns();
    void note(ReadNote::Kind kind, std::size_t line, std::string field, std::string text);

    /// Times of the file say in which zone they are: nobody else can.
    void times_name_their_zone() { zone_named_ = true; }
    bool zone_named() const { return zone_named_; }

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
    // Values of a field that were refused or pulled back into its range.
    struct Odd {
        std::size_t count = 0, first_line = 0;
        double low = 0.0, high = 0.0;
        void add(double value, std::size_t line);
    };
    std::size_t report_index(Field field);
    void note_odd();
    void refuse_misnamed() const;
    void refuse_warm_dew() const;
    void refuse_impossible_damp() const;
    void drop_lone_zeros();
    void drop_empty_columns();
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
    std::array<Odd, kFieldCount> refused_{}, noise_{}, impossible_{}, unreadable_{};
    std::array<std::string, kFieldCount> unreadable_text_{};
    std::vector<std::string> strange_columns_, other_columns_;
    std::vector<double> seen_;
    bool use_seen_ = false;
    std::size_t line_ = 0, joined_ = 0, last_bad_line_ = 0;
    bool zone_named_ = false;
    bool in_row_ = false, join_same_times_ = false, joining_ = false;
};

}  // namespace petrichor::weather

#endif
