#ifndef PETRICHOR_WEATHER_MODELS_PHYSICAL_COUPLING_H
#define PETRICHOR_WEATHER_MODELS_PHYSICAL_COUPLING_H

#include <cstdint>
#include <string>

#include "weather/models/physical/observed_start.h"

namespace petrichor::weather {

/// What a measured road tells about the radiation that it gets: shade, haze, a cloud that nobody
/// forecast, walls that are warmer than the sky.
///
/// Over the last hours of the measurements the model is run again and again, until a factor on its
/// shortwave or longwave brings its surface to the last measured temperature. The factor is kept
/// and fades after that, as METRo couples (Crevier & Delage 2001, J. Appl. Meteor. 40, 2026) and
/// FMI's model does (Karsisto et al. 2016, Meteorol. Appl. 23, 503).
struct CouplingParams {
    double window_h = 3.0;  ///< of measurements that are gone through, 0..48; FMI's
    /// Of measurements before the window, 0..48. Until then the ground below is a guess, and the
    /// surface tells of the ground and not of the sky: a window begins so much later.
    double settling_h = 3.0;
    double relaxation_h = 4.0;  ///< later the factor less 1 fades by exp(-t / this), above 0..1000
};

/// A factor on what the sky sends down.
struct RadiationCorrection {
    enum class Flux : std::uint8_t { None, Shortwave, Longwave };
    Flux flux = Flux::None;
    double factor = 1.0;        ///< at the end of the window and before it; 1 far after it
    std::int64_t begin_us = 0;  ///< of the window
    std::int64_t end_us = 0;
    double relaxation_h = 4.0;
    double missed_k = 0.0;  ///< modelled less measured at the end of the window, uncorrected
    double left_k = 0.0;    ///< the same with the factor: 0 unless a bound was met
    bool at_bound = false;
};

/// Shortwave is corrected from 0 to 3 times: from none to where FMI's coupling gives up. Longwave
/// from 0.7 to 1.4 times: as much as between a clear sky and an overcast one.
inline constexpr double kLeastShortwaveFactor = 0.0, kMostShortwaveFactor = 3.0;
inline constexpr double kLeastLongwaveFactor = 0.7, kMostLongwaveFactor = 1.4;

/// The correction that brings the model to the last measured temperature.
///
/// By day the shortwave is corrected, else the longwave. It is day, as for METRo, where the model's
/// sun gives more than 100 W/m2 at the end of the window and some at its beginning and an hour
/// after its end. No correction (Flux::None, factor 1) where less than an hour lies between the
/// first and the last temperature of the window, or where radiation does not move the surface.
/// Always the same bits; the factor rises with the last measured temperature.
///   table     filled weather over the window at least
///   measured  as for observed_start
///   throws    Error as observed_start, and for params out of range
RadiationCorrection couple_radiation(const ForcingTable& table, const PhysicalParams& params,
                                     const RoadTemperatures& measured,
                                     const CouplingParams& coupling = {});

/// The factor at a time.
double correction_at(const RadiationCorrection& correction, std::int64_t time_us);

/// Corrects the radiation of a filled table, row by row. Flux::None leaves every bit.
void correct_radiation(ForcingTable& table, const RadiationCorrection& correction);

/// "sunlight x 0.63 over the last 3.0 h brings ..": a sentence for reports.
std::string to_text(const RadiationCorrection& correction);

}  // namespace petrichor::weather

#endif
