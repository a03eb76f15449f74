#ifndef PETRICHOR_WEATHER_READERS_ISD_GROUPS_H
#define PETRICHOR_WEATHER_READERS_ISD_GROUPS_H

#include <string_view>
#include <vector>

#include "weather/readers/collector.h"

// The coded groups of NOAA's Integrated Surface Data, which its fixed columns and its CSV share.
// Source: Federal Climate Complex Data Documentation for Integrated Surface Data, NOAA NCEI.
namespace petrichor::weather {

/// One report while it is read. Values whose quality is suspect (2, 6) or wrong (3, 7) are left out
/// and counted.
class IsdReport {
public:
    /// `elevation_m` brings pressures of the sea level and altimeter settings to the station.
    IsdReport(RowCollector& rows, double elevation_m) : rows_(rows), elevation_m_(elevation_m) {}
    /// Begins a report, after the row of the collector.
    void begin();

    // The fields of a group as text, in the order of the documentation.
    void wind(std::string_view direction, std::string_view type, std::string_view speed,
              std::string_view quality);
    void visibility(std::string_view metres, std::string_view quality);
    void air(std::string_view tenths_c, std::string_view quality);
    void dew(std::string_view tenths_c, std::string_view quality);
    void sea_level_pressure(std::string_view tenths_hpa, std::string_view quality);
    /// AA precipitation, AJ snow depth, AU AW MW present weather, GA GD GF sky, GH sun, MA pressure
    /// of altimeter and station. Others are left unread. `id` is two letters and a digit.
    void group(std::string_view id, const std::vector<std::string_view>& fields);
    /// A METAR of the remarks, for what the groups of this report do not say.
    void metar(std::string_view text);
    /// Sky and weather of all groups of the report.
    void end();

    std::size_t dropped() const { return dropped_; }
    bool has_amounts() const { return amounts_; }
    bool lacks_sky_or_air() const { return cloud_ != cloud_ || air_k_ != air_k_; }

private:
    bool good(std::string_view quality);

    RowCollector& rows_;
    double elevation_m_;
    double cloud_ = kMissing, air_k_ = kMissing, sea_pa_ = kMissing;
    double rain_mm_h_ = 0.0, snow_mm_h_ = 0.0;
    bool station_pressure_ = false, falls_ = false, amounts_ = false, total_cloud_ = false;
    std::size_t dropped_ = 0;
};

}  // namespace petrichor::weather

#endif
