#ifndef PETRICHOR_WEATHER_READERS_METAR_H
#define PETRICHOR_WEATHER_READERS_METAR_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weather/forcing/forcing.h"
#include "weather/physics/friction.h"

namespace petrichor::weather {

/// State of a runway as seen (group Rrr/ECDDBB): the only direct observation of surface water in
/// such files.
struct RunwayState {
    int runway = 88;   ///< 88 all runways, 99 repeated from before
    int deposit = -1;  ///< 0 dry, 1 damp, 2 wet, 3 frost, 4 dry snow, 5 wet snow, 6 slush, 7 ice, 8
                       ///< packed, 9 ruts
    int extent = -1;   ///< 1 up to 10 %, 2 to 25 %, 5 to 50 %, 9 to 100 %
    double depth_mm = kMissing;
    double friction = kMissing;  ///< coefficient 0..0.9; NaN for braking action codes
    bool cleared = false;
};
const char* deposit_name(int deposit);

/// What the deposit is among the conditions of a road: damp counts as wet, slush as water and snow,
/// ruts and packed snow as snow. None where it covers a quarter of the runway or less, where it was
/// cleared (by whom the model does not know), or where it is not told.
std::optional<RoadCondition> condition_of(const RunwayState& runway);

/// One report. What it does not say is NaN.
struct MetarReport {
    std::string station;
    int day = 1, hour = 0, minute = 0;
    long long year = 0;  ///< 0 when the file does not say
    int month = 0;
    std::size_t line = 0;
    bool nil = false;
    double wind_from_deg = kMissing, wind_m_s = kMissing, gust_m_s = kMissing;
    double visibility_m = kMissing;
    double cloud = kMissing;  ///< fraction of the largest layer
    double temp_c = kMissing, dew_c = kMissing;
    double qnh_pa = kMissing;  ///< altimeter setting or QNH: reduced to sea level
    /// Rates from present weather, mm/h: drizzle 0.1/0.3/0.8, rain 1/4.5/12, snow 0.5/1.5/3,
    /// showers the same.
    double rain_mm_h = 0.0, snow_mm_h = 0.0;
    bool weather_seen = false;         ///< a present weather group with precipitation was there
    double hour_precip_mm = kMissing;  ///< remark Pnnnn
    double six_hour_precip_mm =
        kMissing;                    ///< remark 6nnnn: of 6 h at 00, 06, 12, 18 UTC, else of 3 h
    double snow_depth_m = kMissing;  ///< remark 4/sss
    std::vector<RunwayState> runways;
    std::vector<std::string> not_understood;  ///< groups of the body, at most 8
};

/// Parses one report that begins at the station code, without METAR or SPECI. Never throws on odd
/// groups: they are listed. Nothing when there is no station or time.
std::optional<MetarReport> parse_metar(std::string_view text);

}  // namespace petrichor::weather

#endif
