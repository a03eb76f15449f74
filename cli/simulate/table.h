#ifndef PETRICHOR_CLI_SIMULATE_TABLE_H
#define PETRICHOR_CLI_SIMULATE_TABLE_H

#include <cstdint>
#include <string>
#include <vector>

namespace petrichor::cli {

/// One line of a plot.
struct PlotSeries {
    std::string column;  ///< name of a column of the table
    std::string label;
    std::string color;   ///< "#rrggbb"
    bool filled = false;  ///< shaded down to the lower end of the axis
};

/// One pair of axes over the common time axis.
struct PlotPanel {
    std::string title;  ///< with the unit
    bool forcing = false;  ///< forcing is drawn above, smaller; state below
    std::vector<PlotSeries> series;
    double low = 0.0;  ///< range of the axis; low == high: from the data, with 0 inside
    double high = 1.0;
};

struct SimulationEvent {
    double time_s = 0.0;
    std::string text;
};

/// What every model hands to the writers of CSV, JSON, plots and reports. A new model fills this and
/// gets them all.
struct SimulationTable {
    std::string title;  ///< of plots: the name of the input
    std::string model;  ///< "artist"
    std::string mode;   ///< "exact", "stepped"
    std::vector<std::string> columns;       ///< the first is time_s
    bool utc = false;               ///< the CSV has time_utc after time_s
    std::int64_t utc_start_us = 0;  ///< of time_s 0, microseconds since 1970
    std::vector<std::vector<double>> rows;  ///< as many numbers a row as columns
    std::vector<SimulationEvent> events;    ///< ascending
    std::vector<PlotPanel> panels;
    std::vector<std::string> notes;  ///< what was read, what was left out
    std::uint64_t state_hash = 0;    ///< of the last state
    std::uint64_t table_hash = 0;    ///< of the states of all rows, in order
};

/// 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

/// Header and rows, 17 significant digits; with `with_hash` a last line "# hash ...".
std::string csv_text(const SimulationTable& table, bool with_hash = false);

/// Columns, rows, events, hashes and notes.
std::string json_text(const SimulationTable& table);

/// The same without the rows, with the range of every column: for --json.
std::string json_summary(const SimulationTable& table);

}  // namespace petrichor::cli

#endif
