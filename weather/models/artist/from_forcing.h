#ifndef PETRICHOR_WEATHER_MODELS_ARTIST_FROM_FORCING_H
#define PETRICHOR_WEATHER_MODELS_ARTIST_FROM_FORCING_H

#include "weather/forcing/forcing.h"
#include "weather/models/artist/timeline.h"
#include "weather/models/physical/mapping.h"

namespace petrichor::weather {

/// Seconds of the artist model for a second of a weather file: an hour of weather is a second of
/// the model, whose rates are made for a few seconds. The same scale as that of --fit-artist.
inline constexpr double kFileTimeScale = 1.0 / 3600.0;

/// Keys of the artist model from a weather file; time 0 is the first row.
///
/// temperature_c: the air, straight lines between rows. rainfall: the logarithm of all
/// precipitation (MappingParams), R = ln(1 + p/P0) / ln(1 + P1/P0), held from row to row.
///   throws  Error when the table has not been through fill_forcing
Timeline artist_keys(const ForcingTable& table, const MappingParams& mapping = {});

/// One more channel of a table that starts at 0 as above: a field, linear between rows. `scale` and
/// `offset` convert.
Channel channel_of_field(const ForcingTable& table, Field field, double scale = 1.0,
                         double offset = 0.0);

}  // namespace petrichor::weather

#endif
