#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_CSV_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_CSV_H

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "weather/models/artist/model.h"
#include "weather/models/artist/timeline.h"
#include "weather/text/csv.h"

namespace petrichor::weather {

/// A timeline read from text, and the rows that were left out.
struct TimelineReading {
    Timeline timeline;
    std::vector<Problem>
        bridged;  ///< bad rows among good ones: skipped, the keys around them remain
};

/// Reads keys from comma-separated text.
///
/// Columns, letter case ignored: time_s (>= 0, ascending), temperature_c (-100..100), rainfall
/// (0..1), and any parameter of ArtistParams (>= 0; snow_start_height_m any; script_controlled 0 or
/// 1, always held), and the states wetness, cracks, puddles, snow, water_to_snow (0..1), which
/// count while script_controlled is 0. An empty cell is no key of that column.
///
/// Throws Error with the list of problems (line, column) for an empty, binary or differently
/// separated text, missing or unknown columns, times out of order or twice, or bad cells. Where bad
/// rows are at most one in twenty they are left out instead and listed in `bridged`.
TimelineReading parse_timeline_csv(std::string_view text, Interpolation interpolation);

/// The columns of the artist model's table, in order.
inline constexpr std::array<const char*, 22> kArtistColumns{"time_s",
                                                            "temperature_c",
                                                            "rainfall",
                                                            "rain",
                                                            "snowfall",
                                                            "wetness",
                                                            "cracks",
                                                            "puddles",
                                                            "water",
                                                            "snow",
                                                            "water_to_snow",
                                                            "snow_melt",
                                                            "freeze_exp",
                                                            "melt",
                                                            "melt_exp",
                                                            "flood_cracks",
                                                            "flood_puddles",
                                                            "film_albedo",
                                                            "film_smoothness",
                                                            "snow_amount",
                                                            "rain_particles_s",
                                                            "snow_particles_s"};

/// One row of that table.
std::array<double, kArtistColumns.size()> artist_row(double time_s, const ArtistState& state,
                                                     const ArtistOutputs& outputs);

}  // namespace petrichor::weather

#endif
