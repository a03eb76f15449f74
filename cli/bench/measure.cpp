#include "cli/bench/measure.h"

#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <cstddef>

namespace petrichor::cli {
namespace {

double clock_ms(clockid_t clock)
{
    timespec now{};
    clock_gettime(clock, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

Cost timed(const std::function<void()>& work)
{
    const double cpu_before_ms = clock_ms(CLOCK_PROCESS_CPUTIME_ID);
    const double wall_before_ms = clock_ms(CLOCK_MONOTONIC);
    work();
    Cost cost;
    cost.wall_ms = clock_ms(CLOCK_MONOTONIC) - wall_before_ms;
    cost.cpu_ms = clock_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_before_ms;
    return cost;
}

double median(std::vector<double> values)
{
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Cost median_of_costs(const std::vector<Cost>& costs)
{
    std::vector<double> cpu, wall;
    double peak_mib = 0.0;
    for (const Cost& cost : costs) {
        cpu.push_back(cost.cpu_ms);
        wall.push_back(cost.wall_ms);
        peak_mib = std::max(peak_mib, cost.peak_mib);
    }
    return {median(cpu), median(wall), peak_mib};
}

Cost median_cost(int repeat, const std::function<void()>& work)
{
    std::vector<Cost> costs;
    for (int i = 0; i < repeat; ++i) costs.push_back(timed(work));
    return median_of_costs(costs);
}

long peak_memory_mib()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

}  // namespace petrichor::cli
