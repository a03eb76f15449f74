#ifndef PETRICHOR_GPU_FRAME_WEATHER_MAPS_H
#define PETRICHOR_GPU_FRAME_WEATHER_MAPS_H

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace petrichor::gpu {

/// A square RGBA8 map that repeats; empty: the renderer draws its own.
struct WeatherMap {
    int size = 0;                 ///< texels a side, a power of two, 16..4096
    std::vector<std::byte> rgba;  ///< size * size * 4, first row at v = 0
};

/// What feet and tyres have pressed into snow, from above; empty: nothing. One texel a cell, x to the right
/// and z down; a texel beyond its edge is as one at it, so the edge should be untouched.
struct TrackMap {
    int width = 0;  ///< texels, multiples of 64
    int height = 0;
    glm::vec2 corner_m{0.0f};     ///< world x and z of the first texel's corner
    float texel_m = 0.01f;
    float low_m = 0.0f;           ///< only what lies between these heights of the world
    float high_m = 0.0f;
    bool over_time = false;       ///< of all of a film; what of it is there in a frame a TrackSource says
    /// R: share of the depth that is pressed away, G and B: 0.5 + a quarter of the slope along x and z.
    std::vector<std::byte> rgba;
};

/// How far snow is pressed at a place, 0..1: as trodden_at() of gpu/passes/surface/tracks.glsl, of the nearest texel.
inline float pressed_at(const TrackMap& tracks, const glm::vec3& at)
{
    if (!(at.y >= tracks.low_m && at.y <= tracks.high_m)) return 0.0f;
    const glm::vec2 texel = (glm::vec2(at.x, at.z) - tracks.corner_m) / tracks.texel_m;
    if (!(texel.x >= 0.0f && texel.y >= 0.0f && texel.x < static_cast<float>(tracks.width) &&
          texel.y < static_cast<float>(tracks.height)))
        return 0.0f;
    const std::size_t index = static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(tracks.width) +
                              static_cast<std::size_t>(texel.x);
    return static_cast<float>(tracks.rgba[4 * index]) / 255.0f;
}

/// Tracks as they are at a second of the film (FrameSettings::time_s): as large as WeatherMaps::tracks and where that is.
using TrackSource = std::function<TrackMap(double film_s)>;

/// Maps that weather is drawn with, instead of those of formulas/weather/weather_maps.h.
struct WeatherMaps {
    WeatherMap drops;  ///< as rain_drops(): envelope, direction, time offset
    WeatherMap snow;   ///< as snow_texel(): normal xy, mask, smoothness
    TrackMap tracks;
    WeatherMap water;  ///< normal xy of moving water; it stands still, its phases move it
};

}  // namespace petrichor::gpu

#endif
