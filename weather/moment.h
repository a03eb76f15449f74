#ifndef PETRICHOR_WEATHER_MOMENT_H
#define PETRICHOR_WEATHER_MOMENT_H

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formulas/weather/moment.h"
#include "weather/forcing/forcing.h"
#include "weather/models/artist/exact.h"
#include "weather/models/artist/timeline.h"
#include "weather/models/physical/mapping.h"
#include "weather/models/physical/physical.h"

namespace petrichor::weather {

// What a renderer gets, from either model: the weather of a moment, its clock, its place and its
// sun. Every function here depends on its arguments alone, so any frame can be rendered alone.

/// Where the sun stands.
struct SunAngles {
    double elevation_rad = 0.0;
    double azimuth_rad = 0.0;  ///< clockwise from north, 0 .. 2 pi
};

/// The weather of a moment. Place, clock and sun are there when the weather comes from a file that
/// (or whose reader) knows them.
struct Moment {
    shared::WeatherMoment values{.cloud_fraction = 0.1f};
    std::optional<std::int64_t> utc_us;                 ///< microseconds since 1970
    std::optional<double> latitude_deg, longitude_deg;  ///< north and east positive
    std::optional<double> elevation_m;                  ///< above the sea
    std::optional<SunAngles> sun;
};

/// The sun over a place at a UTC time, good to 0.1 degrees (weather/physics/solar.h).
SunAngles sun_angles(std::int64_t utc_us, double latitude_deg, double longitude_deg);
/// The same by local solar time (weather/physics/solar.h: sun_by_solar_time).
SunAngles sun_angles_by_solar_time(double day_of_year, double solar_hour, double latitude_deg);

/// Fills clock, place and sun of a moment, as far as the site knows its place.
void set_clock(Moment& moment, std::int64_t utc_us, const Site& site);

/// Where the air goes, x east and z south, from where it comes from: 0 degrees north (-z), 90 east.
glm::vec2 wind_vector_m_s(double speed_m_s, double from_deg);

/// How far one sees at 2 % contrast, metres, where nobody measured: 20 km in clear air, about 3 km
/// in full rain and 600 m in full snowfall (extinctions add up, Koschmieder's law). Ours.
double visibility_in_m(double rain, double snowfall);

/// A finite value in every row.
bool has_every_row(const ForcingTable& table, Field field);

/// Where the wind comes from at a time, degrees, between two rows by the shorter way round. The
/// table has a direction in every row.
double wind_from_deg_at(const ForcingTable& table, std::int64_t utc_us);

/// Humidity, pressure and radiation as the file has them at a time (its row's values, linear
/// between); sunlight is split by Erbs 1982 where the file does not. `table` is complete.
void set_measured(shared::WeatherMoment& moment, const ForcingTable& table, std::int64_t utc_us);

// ---- artist model -----------------------------------------------------------------------------

/// The sky that goes with the keys of the artist model; channels that are empty are derived.
struct SkyChannels {
    Channel cloud_cover;                              ///< 0..1; empty: from the rainfall around
    Channel wind_m_s = constant_channel(2.0);         ///< speed
    Channel wind_from_deg = constant_channel(240.0);  ///< may pass 360
    Channel visibility_m;                             ///< empty: from what falls
};

/// Hoar frost, 0..1: grows in the cold while nothing falls, faster the colder (full after about 12
/// s of clear -10 C), goes four times as fast above zero. time_scale speeds it up as it does the
/// model. The minute before the time decides; a fixed grid of quarter seconds keeps frames
/// independent. Ours.
double frost_at(const Timeline& timeline, double time_s, double time_scale);

/// Clouds come a little before rain and leave a little after: the rainfall around the time, spread
/// over a twelfth of the timeline, mapped from 0.12 (dry) to 0.95. Ours.
double cloud_cover_at(const Timeline& timeline, double time_s);

/// The moment of the artist model. SI values are the inverse of part C's maps, on asphalt: what the
/// physical model would hold when it showed the same; what no map knows stays unknown.
Moment artist_moment(const ArtistTimeline& weather, const Timeline& timeline,
                     const SkyChannels& sky, double time_s);

// ---- physical model ---------------------------------------------------------------------------

/// The physical model over a weather file, as moments. Runs the whole file once; a moment then
/// costs at most 50 steps, is the same in any order and on any number of threads. Copies share
/// their run.
class PhysicalMoments {
public:
    /// `table` must have been through fill_forcing. Throws Error for parameters out of range.
    PhysicalMoments(ForcingTable table, const PhysicalParams& params,
                    const MappingParams& mapping = {});

    /// The state by part C; SI straight from the state and the file. Two departures from the
    /// artist's published values: snow_amount is part C's S of the depth alone (thin snow on a wet
    /// road has a small frozen share, and is white all the same), and frost is the hoar of the last
    /// 12 hours that is still there, 1 - exp(-m / 0.03 kg/m2).
    Moment at(std::int64_t utc_us) const;

    std::int64_t begin_us() const;
    std::int64_t end_us() const;
    /// What the file did not say and was taken instead, a line each.
    const std::vector<std::string>& guesses() const;

private:
    struct Impl;
    std::shared_ptr<const Impl> impl_;
};

}  // namespace petrichor::weather

#endif
