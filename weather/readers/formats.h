#ifndef PETRICHOR_WEATHER_READERS_FORMATS_H
#define PETRICHOR_WEATHER_READERS_FORMATS_H

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weather/readers/collector.h"
#include "weather/readers/read_weather.h"

// The kinds of weather files. A new kind is one file that defines a `const Reader name_reader`, its
// line in CMakeLists.txt and its name in the list of formats.cpp; what reads, lists, tests and
// fuzzes weather files finds it there.
namespace petrichor::weather {

/// The beginning of a text, prepared once for all that want to recognise it.
struct FileHead {
    /// `text` without a byte order mark, not empty.
    explicit FileHead(std::string_view text);
    std::string_view text;                ///< at most 64 KiB
    std::vector<std::string_view> lines;  ///< the first 40 that are not blank, as they stand
    std::string first;                    ///< the first of them: trimmed, lower case, no quotes

    /// Whether the first line, blanks before it left out, begins so.
    bool begins(std::string_view prefix) const;
    /// Whether the first line has all of these words as whole cells between , ; | or tabs.
    bool has_columns(std::initializer_list<std::string_view> names) const;
};

/// One kind of weather file. `read` puts rows into the collector and throws Error only for a header
/// that cannot be understood.
struct Reader {
    const char* name;   ///< in reports
    const char* about;  ///< who makes such files, for lists
    bool (*recognise)(const FileHead& head);
    void (*read)(std::string_view text, RowCollector& rows, const ReadOptions& options);
};

/// All kinds, in the order in which they are asked whether a text is theirs: those with a clear
/// mark first, those that are only numbers or any table last.
std::span<const Reader* const> weather_readers();

/// Whether every one of the words is a number.
bool all_numbers(const std::vector<std::string_view>& fields);

/// Months of a typical year come from different years; they are placed in one year without a leap
/// day.
struct TypicalYear {
    bool typical = false;
    long long year = 0;
    /// Watches year and month of every row, in order, before the rows are read.
    void watch(long long row_year, int row_month);
    /// Decides; notes it in the report.
    void decide(RowCollector& rows);
    long long of(long long row_year) const { return typical ? year : row_year; }

private:
    long long first_ = 0, last_ = 0;
    int last_month_ = 0;
};

}  // namespace petrichor::weather

#endif
