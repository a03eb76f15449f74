#ifndef PETRICHOR_CLI_REPORT_PLOT_AXES_H
#define PETRICHOR_CLI_REPORT_PLOT_AXES_H

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "cli/report/table.h"

// What plots and reports need to know of a table: values, ranges, ticks.
namespace petrichor::cli {

/// Index of a column; the number of columns when there is none.
std::size_t column_index(const SimulationTable& table, const std::string& name);

/// The values of a series, one a row, in the unit of the panel; NaN where there is nothing to show.
/// `column` is the series' own or one of its band. Empty when the table has no such column.
std::vector<double> series_values(const SimulationTable& table, const PlotSeries& series,
                                  const std::string& column);

/// Rows to draw: all of them, or about `most` evenly spread ones, the first and the last included.
std::vector<std::size_t> rows_to_draw(const SimulationTable& table, std::size_t most);

/// Up to about `most` round numbers inside low..high, evenly spaced (steps of 1, 2, 5 x 10^n; for
/// times also minutes, hours and days).
std::vector<double> axis_ticks(double low, double high, int most, bool time);

/// "12 s", "3 min", "2 h", "5 d": a time of the axis with its spacing in mind.
std::string time_label(double time_s, double spacing_s);

/// The range of a panel's axis: fixed, or that of the data with 0 inside and rounded outwards.
std::pair<double, double> axis_range(const SimulationTable& table, const PlotPanel& panel);

/// Decimals that tell the ticks of an axis apart.
int decimals_of(const std::vector<double>& ticks);

/// At most so many decimals, without zeros at the end.
std::string number_text(double value, int decimals);

/// The unit of a score as it is written behind a number: " kg/m2" with a raised 2, or nothing.
std::string unit_text(const Score& score);

}  // namespace petrichor::cli

#endif
