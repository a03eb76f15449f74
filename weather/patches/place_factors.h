#ifndef PETRICHOR_WEATHER_PATCHES_PLACE_FACTORS_H
#define PETRICHOR_WEATHER_PATCHES_PLACE_FACTORS_H

#include <array>
#include <cstddef>
#include <span>

#include "weather/patches/patches.h"

namespace petrichor::weather {

/// The weather that factors are means of.
struct PlaceClimate {
    double wind_m_s = 2.0;
    double wind_from_deg = 240.0;
    double rain_mm_h = 5.0;
    double latitude_deg = 50.0;
    double day_of_year = 80.0;  ///< of the sun whose path is averaged
    double north_deg = 0.0;     ///< azimuth, clockwise from the scene's -z, of true north
};

/// What a place makes of the weather, over open flat ground: for models that have no energy and no
/// wind (scene-weather, 0).
struct PlaceFactors {
    double rain = 1.0;      ///< of the rain that meets it, >= 0
    double drying = 1.0;    ///< mean of its share of the day's sun and of the wind, 0..1
    double freezing = 1.0;  ///< by its share of the sky, 0..1
    double snow = 1.0;      ///< of the snow that stays on it, 0..1
};
PlaceFactors place_factors(const WeatherPatch& patch, const PatchKind& kind,
                           const PlaceClimate& climate);

/// The sun of a climate's day, by the hour: the same for all patches.
struct SunPath {
    static constexpr std::size_t kHours = 12;
    std::array<Direction, kHours> towards;  ///< up 0 or less: below the horizon
    std::array<VisibleLookup, kHours> at;
};
SunPath sun_path(const PlaceClimate& climate);

/// Winds that share a day.
struct WeightedClimate {
    PlaceClimate climate;
    double weight = 1.0;  ///< all add up to 1
};
/// The mean over climates of a latitude, a day and a north, whose sun goes along `path`.
PlaceFactors place_factors(const WeatherPatch& patch, const PatchKind& kind,
                           std::span<const WeightedClimate> climates, const SunPath& path);

}  // namespace petrichor::weather

#endif
