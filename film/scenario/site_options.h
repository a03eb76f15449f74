#ifndef PETRICHOR_FILM_SCENARIO_SITE_OPTIONS_H
#define PETRICHOR_FILM_SCENARIO_SITE_OPTIONS_H

#include <optional>
#include <string>

namespace petrichor::film {

/// What a scenario or the command line says about a weather file. What is not given comes from the
/// file, then from defaults.
struct SiteOptions {
    std::optional<double> latitude_deg, longitude_deg, elevation_m, temp_height_m, wind_height_m;
    std::optional<double> sky_view, canopy_vai;  ///< as in weather::PhysicalParams
    std::string surface = "asphalt";
    std::string station;                 ///< of a METAR file
    std::string month;                   ///< "2024-02": of METAR reports, which name only the day
    std::string missing_precip = "dry";  ///< dry or estimate
    std::optional<double> file_zone_h;   ///< of times that name no zone, hours ahead of UTC
    std::string date_order;              ///< dmy or mdy: of dates such as 01/02/2024
    std::string ignore;                  ///< columns that may stay unread, by comma, or all
    double max_gap_days = 60.0;          ///< between two rows; longer ones are asked about
    std::string taf = "expected";        ///< expected, prevailing or worst: TEMPO and PROB groups
};

}  // namespace petrichor::film

#endif
