#ifndef PETRICHOR_WEATHER_TEXT_CSV_H
#define PETRICHOR_WEATHER_TEXT_CSV_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace petrichor::weather {

/// Something wrong at one place of a text file.
struct Problem {
    std::size_t line = 0;  ///< from 1; 0: the file as a whole
    std::string field;     ///< column or field name, may be empty
    std::string message;
};
/// "line 12, rainfall: not a number: abc", one a line; at most `most`, then "... and N more".
std::string list_problems(const std::vector<Problem>& problems, std::size_t most = 20);

/// A comma-separated table: a header and rows of as many cells. Cells are trimmed, quotes removed.
struct CsvTable {
    std::vector<std::string> header;             ///< as written
    std::vector<std::vector<std::string>> rows;  ///< only rows with as many cells as the header
    std::vector<std::size_t> lines;              ///< line number of each row
    std::vector<Problem> problems;               ///< rows left out, and why
    bool usable = false;  ///< false: not a comma-separated text at all; `problems` says why

    /// Index of the column of that name, letter case ignored.
    std::optional<std::size_t> column(std::string_view name) const;
};

/// Reads comma-separated text: UTF-8 with or without byte order mark, any line ends; empty lines
/// and lines that start with '#' are skipped. Never throws: a binary file, an empty text, another
/// separator or rows of the wrong length end up in `problems`.
CsvTable parse_csv(std::string_view text);

/// A decimal number with '.', surrounded by nothing; NaN and infinity are refused.
std::optional<double> parse_number(std::string_view text);

/// The number with 17 significant digits ("%.17g"): reads back as the same bits.
std::string number_17(double value);

std::string lower_case(std::string_view text);

}  // namespace petrichor::weather

#endif
