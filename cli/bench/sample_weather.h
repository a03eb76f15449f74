#ifndef PETRICHOR_CLI_BENCH_SAMPLE_WEATHER_H
#define PETRICHOR_CLI_BENCH_SAMPLE_WEATHER_H

#include <cstddef>
#include <string>
#include <vector>

#include "weather/forcing/forcing.h"
#include "weather/models/artist/timeline.h"
#include "weather/models/physical/physical_grid.h"

namespace petrichor::cli {

// Weather for timing: made up, the same every time, with the ups and downs that cost time (fronts,
// rain, thaw).

inline constexpr int kSampleYear = 2023, kSampleMonth = 10;

/// Hourly weather from the first of that month on, complete.
///   days   1..365
///   snowy  a mountain at 1300 m with months of snow; otherwise a town in the plain with next to
///   none
weather::ForcingTable sample_year(int days, bool snowy);

/// The same weather as files: EPW, and a METAR report each hour (which says the day, not the
/// month).
std::string epw_of(const weather::ForcingTable& table);
std::string metar_of(const weather::ForcingTable& table);

/// A hillside of cells: heights over 1000 m upwards of `base_m`, all slopes and aspects, grass with
/// some asphalt.
std::vector<weather::GridCell> sample_cells(std::size_t count, double base_m);

/// Keys of temperature and rainfall ten seconds apart, joined by lines.
weather::Timeline sample_timeline(int segments);

}  // namespace petrichor::cli

#endif
