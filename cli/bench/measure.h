#ifndef PETRICHOR_CLI_BENCH_MEASURE_H
#define PETRICHOR_CLI_BENCH_MEASURE_H

#include <functional>
#include <vector>

namespace petrichor::cli {

/// Time that one piece of work took: of all threads together, and by the clock on the wall.
struct Cost {
    double cpu_ms = 0.0;
    double wall_ms = 0.0;
    double peak_mib = 0.0;  ///< most memory that one of its processes held; 0: not measured
};
Cost timed(const std::function<void()>& work);

/// Middle of the values, or the mean of the middle two; 0 for none.
double median(std::vector<double> values);
/// Median of each clock; the largest memory.
Cost median_of_costs(const std::vector<Cost>& costs);
/// Median of each clock over `repeat` runs of the work, repeat >= 1.
Cost median_cost(int repeat, const std::function<void()>& work);

/// The most memory this process has held so far, MiB.
long peak_memory_mib();

}  // namespace petrichor::cli

#endif
