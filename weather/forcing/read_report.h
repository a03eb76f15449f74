#ifndef PETRICHOR_WEATHER_FORCING_READ_REPORT_H
#define PETRICHOR_WEATHER_FORCING_READ_REPORT_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace petrichor::weather {

/// One thing a reader or the filling noticed. `line` is 1-based, 0 when it concerns the whole file.
struct ReadNote {
    enum class Kind : std::uint8_t { Info, Filled, OutOfRange, BadRow, Time, Warning };
    Kind kind = Kind::Info;
    std::size_t line = 0;
    std::string field;
    std::string text;
};
/// What was there, what was missing, how it was filled.
struct FieldReport {
    std::string name{};
    std::size_t present = 0;  ///< values read
    std::size_t missing = 0;  ///< rows without a value
    std::size_t first_missing_line =
        0;  ///< of the file, where the file says that a value is missing; else 0
    std::size_t out_of_range = 0;  ///< values refused
    std::size_t filled = 0;        ///< rows filled afterwards
    std::string filled_by;         ///< how
};
/// Time without rows between two of a file.
struct ReadGap {
    std::int64_t from_us = 0, to_us = 0;
};
struct ReadReport {
    std::string format;  ///< as recognised
    std::size_t rows = 0;
    std::size_t bad_rows = 0;   ///< dropped and bridged
    bool typical_year = false;  ///< months of different years, placed in one
    std::vector<FieldReport> fields;
    std::vector<ReadNote> notes;  ///< at most kMostNotes, then a count
    std::size_t notes_dropped = 0;
    std::vector<ReadGap> gaps;  ///< ascending

    static constexpr std::size_t kMostNotes = 200;
    void add(ReadNote note);
};
/// The report of a field of this name, begun when there is none yet.
FieldReport& field_report(ReadReport& report, const std::string& field);
/// Adds to a field that `count` rows were filled, and how; nothing for no rows.
void note_filled(ReadReport& report, const std::string& field, std::size_t count,
                 const std::string& how);
/// Plain text of a report, one line a fact.
std::string to_text(const ReadReport& report);
/// The same as a JSON object.
std::string to_json(const ReadReport& report);

}  // namespace petrichor::weather

#endif
