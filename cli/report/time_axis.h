#ifndef PETRICHOR_CLI_REPORT_TIME_AXIS_H
#define PETRICHOR_CLI_REPORT_TIME_AXIS_H

#include <cstdint>
#include <string>
#include <vector>

namespace petrichor::cli {

struct TimeTick {
    double time_s = 0.0;
    std::string label;
};

/// Ticks of an axis that counts from the start of the run: round seconds, minutes, hours or days.
std::vector<TimeTick> elapsed_ticks(double first_s, double last_s, int most);

/// Ticks of an axis of dates (UTC): round minutes and hours, days of the month ("6 Jan"), first
/// days of months
/// ("Feb"; "2006" in January), years. The first tick of a longer span is named in full.
std::vector<TimeTick> calendar_ticks(std::int64_t start_us, double first_s, double last_s,
                                     int most);

}  // namespace petrichor::cli

#endif
