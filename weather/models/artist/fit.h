#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_FIT_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_FIT_H

#include <cstddef>

#include "weather/models/artist/model.h"
#include "weather/models/physical/mapping.h"
#include "weather/models/physical/physical.h"

namespace petrichor::weather {

/// One rate, fitted by least squares, and how well it does.
struct FittedRate {
    double per_hour = 0.0;
    double rms_residual = 0.0;  ///< of the hourly change of the mask, 0..1
    std::size_t hours = 0;      ///< that told something about it; 0: the artist's default is kept
};
/// Rates of the artist model that follow the physical model over a weather file.
struct ArtistFit {
    FittedRate wetness, cracks, puddles, snow;        ///< accumulation at rainfall 1
    FittedRate dry_wetness, dry_cracks, dry_puddles;  ///< evaporation at 40 C
    /// Parameters with time in hours per second of the artist model: time_scale 1/3600, fitted
    /// rates.
    ArtistParams params;
};

/// Least squares over all steps: mask changes of the physical model against the terms of the artist
/// model (rainfall times rate while it rains and is warm, min(|T|/40, 1) times rate while it
/// dries), which stop where the mask is full or empty. Full and empty masks are left out.
ArtistFit fit_artist(const ForcingTable& table, const PhysicalParams& params,
                     const MappingParams& mapping = {});

}  // namespace petrichor::weather

#endif
