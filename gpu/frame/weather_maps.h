#ifndef PETRICHOR_GPU_FRAME_WEATHER_MAPS_H
#define PETRICHOR_GPU_FRAME_WEATHER_MAPS_H

#include <cstddef>
#include <vector>

namespace petrichor::gpu {

/// A square RGBA8 map that repeats; empty: the renderer draws its own.
struct WeatherMap {
    int size = 0;                 ///< texels a side, a power of two, 16..4096
    std::vector<std::byte> rgba;  ///< size * size * 4, first row at v = 0
};

/// Maps that weather is drawn with, instead of those of formulas/weather/weather_maps.h.
struct WeatherMaps {
    WeatherMap drops;  ///< as rain_drops(): envelope, direction, time offset
    WeatherMap snow;   ///< as snow_texel(): normal xy, mask, smoothness
    WeatherMap water;  ///< normal xy of moving water; it stands still, its phases move it
};

}  // namespace petrichor::gpu

#endif
