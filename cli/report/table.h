#ifndef PETRICHOR_CLI_REPORT_TABLE_H
#define PETRICHOR_CLI_REPORT_TABLE_H

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace petrichor::cli {

/// One line of a plot.
struct PlotSeries {
    std::string column;  ///< name of a column of the table
    std::string label;
    std::string color;                    ///< "#rrggbb"
    bool filled = false;                  ///< shaded down to the lower end of the axis
    double scale = 1.0;                   ///< from the unit of the column to that of the panel
    std::string band_low{}, band_high{};  ///< columns between which a band is shaded, or empty
    /// A gap is left where this column is not above the number: without snow its albedo means
    /// nothing. Empty: no gaps.
    std::string only_where{};
    double only_above = 0.0;
    bool steps = false;  ///< means of the time up to each row: flat between rows, no slope
};

/// Dots of a plot: what was observed.
struct PlotDots {
    std::string label;
    std::string color;
    std::vector<double> time_s;
    std::vector<double> values;  ///< in the unit of the panel
};

/// One pair of axes over the common time axis.
struct PlotPanel {
    std::string title;     ///< with the unit
    bool forcing = false;  ///< forcing is drawn above, smaller; state below
    std::vector<PlotSeries> series;
    double low = 0.0;  ///< range of the axis; low == high: from the data, with 0 inside
    double high = 1.0;
    std::vector<PlotDots> dots{};
    std::string group{};  ///< what --plot asks for: weather, snow, heat, water, masks
};

/// How well a column agrees with observations.
struct Score {
    std::string column;
    std::string unit;
    std::size_t count = 0;  ///< observations used
    double rmse = 0.0;
    double bias = 0.0;  ///< model less observation
    std::string how;    ///< what was compared: "at 12 h", "daily mean, snow deeper than 0.1 m"
    /// Of classes: share of the observations in which both say the same; `rmse` and `bias` are 0.
    std::optional<double> agreement = {};
};

struct SimulationEvent {
    double time_s = 0.0;
    std::string text;
};

/// What every model hands to the writers of CSV, JSON, plots and reports. A new model fills this
/// and gets them all.
struct SimulationTable {
    std::string title;                 ///< of plots: the name of the input
    std::string model;                 ///< "artist"
    std::string mode;                  ///< "exact", "stepped"
    std::vector<std::string> columns;  ///< the first is time_s
    bool utc = false;                  ///< the CSV has time_utc after time_s
    bool dated = false;                ///< the axes show dates
    double utc_offset_s = 0.0;         ///< of the clock that times are shown in, east positive
    bool typical_year = false;         ///< months of different years
    std::int64_t utc_start_us = 0;     ///< of time_s 0, microseconds since 1970, when utc or dated
    std::vector<std::vector<double>> rows;  ///< as many numbers a row as columns
    std::vector<SimulationEvent> events;    ///< ascending
    /// Times of which the input has no rows: what is drawn there was made up.
    std::vector<std::pair<double, double>> gaps_s;
    std::vector<PlotPanel> panels;
    std::vector<std::string> notes;     ///< what was read, what was left out
    std::vector<std::string> warnings;  ///< what a reader of the plot must know
    std::vector<Score> scores;
    std::vector<std::pair<std::string, std::string>>
        json_parts;                ///< more of the JSON: key and JSON text
    std::uint64_t state_hash = 0;  ///< of the last state
    std::uint64_t table_hash = 0;  ///< of the states of all rows, in order
};

/// 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

/// The clock of a table: "UTC", "UTC-7", "UTC+5:30".
std::string clock_name(const SimulationTable& table);

/// The time of a row for people: "2005-12-01 06:00" by that clock when dated, else seconds.
std::string time_text(const SimulationTable& table, double time_s);

/// What the shaded times of plots and reports are: how many days in how many gaps; empty without any.
std::string gaps_text(const SimulationTable& table);

/// Header and rows, as many digits as give the same bits again; times in `time_utc`, or where the
/// file has another clock in `time_local` with its offset. With `with_hash` a last line "# hash
/// ...".
std::string csv_text(const SimulationTable& table, bool with_hash = false);

/// Columns, rows, events, hashes and notes.
std::string json_text(const SimulationTable& table);

/// The same without the rows, with the range of every column: for --json.
std::string json_summary(const SimulationTable& table);

}  // namespace petrichor::cli

#endif
