#ifndef PETRICHOR_CLI_BENCH_WEATHER_BENCH_H
#define PETRICHOR_CLI_BENCH_WEATHER_BENCH_H

#include <cstddef>
#include <string>
#include <vector>

#include "cli/bench/measure.h"
#include "cli/bench/rival.h"

namespace petrichor::cli {

/// What `petrichor bench weather` times.
struct WeatherBenchOptions {
    std::string file{};   ///< a weather file instead of the made-up weather; empty: none
    int repeat = 5;       ///< of each row
    int grid_repeat = 1;  ///< of the rows of many cells
    int cells = 10000;
    int days = 365;   ///< of the made-up weather
    int threads = 0;  ///< 0: all
    bool json = false;
    std::vector<Rival> rivals{};  ///< other programs, timed first and whole
};

/// One line of the report.
struct BenchRow {
    std::string name;         ///< stable: scripts look for it
    std::string what;         ///< that one time covers
    Cost cost;                ///< medians
    double goal_ms = 0.0;     ///< CPU time it should stay below; 0: none
    double memory_mib = 0.0;  ///< of the model itself; 0: not counted
};
/// Times every row, in the order of the report. Throws Error when the file cannot be read or a
/// rival fails.
std::vector<BenchRow> weather_rows(const WeatherBenchOptions& options);

/// The report for programs.
std::string json_report(const WeatherBenchOptions& options, const std::vector<BenchRow>& rows);

/// Times and prints.
void run_weather_bench(const WeatherBenchOptions& options);

}  // namespace petrichor::cli

#endif
