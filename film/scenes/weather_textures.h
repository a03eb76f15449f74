#ifndef PETRICHOR_FILM_SCENES_WEATHER_TEXTURES_H
#define PETRICHOR_FILM_SCENES_WEATHER_TEXTURES_H

#include <filesystem>
#include <string>

#include "film/scenario/scenario.h"
#include "gpu/frame/weather_maps.h"

namespace petrichor::film {

/// What the renderer takes instead of what it draws; of snow, the half that no file gives is drawn.
/// Paths are relative to `folder`. Throws Error for a file that is not square with a power of two of
/// texels a side (16 to 4096), or lacks channels, or when mask and bump differ in size.
gpu::WeatherMaps read_weather_textures(const WeatherTextures& files,
                                       const std::filesystem::path& folder);

/// Of the files' bytes; "" without any.
std::string weather_textures_fingerprint(const WeatherTextures& files,
                                         const std::filesystem::path& folder);

}  // namespace petrichor::film

#endif
