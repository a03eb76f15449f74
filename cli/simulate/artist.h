#ifndef PETRICHOR_CLI_SIMULATE_ARTIST_H
#define PETRICHOR_CLI_SIMULATE_ARTIST_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cli/report/table.h"
#include "cli/rooms.h"
#include "film/scenario/weather_script.h"
#include "film/weather/times.h"

namespace petrichor::cli {

/// How the artist model is run and which rows are wanted.
struct ArtistRun {
    bool stepped = false;
    Fraction step_s{1, 60};             ///< stepped only
    Fraction every_s{1, 1};             ///< rows at whole multiples of this
    double from_s = 0.0;                ///< rows from here; the run itself starts at 0
    std::optional<double> to_s;         ///< to here; default: the script's duration
    std::string resume;                 ///< text of a checkpoint to continue from, or empty
    std::string* checkpoint = nullptr;  ///< where to put a checkpoint of the end, or null
};

/// Runs the artist model over a script and tabulates it by kArtistColumns.
///
/// Row 0 is the initial state, with rain and snowfall 0. A row at time t holds the inputs in force
/// until t: of the step that ends there. Stepped: the state of the last step that ends at or before
/// t. Resumed runs give the rows after the checkpoint, with the bits of a run that was never
/// stopped.
///
/// Throws Error for more than 20 million rows, a window that is empty, a checkpoint of another run.
SimulationTable run_artist(const WeatherScript& script, const ArtistRun& run);

}  // namespace petrichor::cli

#endif
