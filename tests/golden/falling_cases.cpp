// What falls through the air, before the same street corner.
#include "tests/golden/stage.h"

namespace petrichor::golden {
namespace {

using gpu::look;
using gpu::plain_material;

// A dark wall with a roof over its left half, a post near the camera, an overcast sky.
Shot corner()
{
    Shot shot = plain_day(look({0, 1.6f, 3.0f}, {0, 1.5f, -4.0f}, 0.6f));
    const std::uint32_t stone = shot.add(plain_material({0.12f, 0.1f, 0.09f}, 0.9f));
    shot.add(ground(14.0f, stone));
    shot.add(box({-9.0f, 0.0f, -9.0f}, {9.0f, 4.0f, -8.0f}, stone));
    shot.add(box({-9.0f, 3.0f, -8.0f}, {-0.5f, 3.2f, 2.0f}, stone));
    shot.add(box({0.55f, 0.0f, 0.6f}, {0.7f, 1.8f, 0.75f}, stone));
    shot.frame.sky.cloud_cover = 1.0f;
    shot.frame.weather.visibility_m = 1500.0f;
    shot.frame.weather.wind_m_s = {6.0f, 1.0f};
    shot.frame.falling.air_m = {31.0, 7.0};
    shot.frame.settings.time_s = 2.5;
    shot.frame.settings.image_based_light = true;
    return shot;
}

Shot falling_rain()
{
    Shot shot = corner();
    shot.frame.weather.rain_kg_m2_s = 40.0f / 3600.0f;
    return shot;
}

Shot falling_snow()
{
    Shot shot = corner();
    shot.frame.weather.snowfall_kg_m2_s = 3.0f / 3600.0f;
    shot.frame.weather.air_temperature_k = 268.0f;
    shot.frame.weather.wind_m_s = {1.5f, 0.5f};
    return shot;
}

}  // namespace

std::vector<Case> falling_cases()
{
    return {
        {"falling_rain", "streaks that the wind slants, none under the roof or behind the post",
         falling_rain},
        {"falling_snow", "flakes of many sizes, near and far", falling_snow},
    };
}

}  // namespace petrichor::golden
