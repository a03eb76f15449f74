// The sky and the air, other cameras, and what the display makes of it.
#include "tests/golden/stage.h"

namespace petrichor::golden {
namespace {

using gpu::look;
using gpu::plain_material;
using gpu::quad;

// A plain with a ball and a column, a good part of the picture is sky.
Shot plain_land(const gpu::Camera& camera)
{
    Shot shot = plain_day(camera);
    const std::uint32_t soil = shot.add(plain_material({0.3f, 0.27f, 0.2f}, 0.9f));
    shot.add(ground(40.0f, soil));
    shot.add(
        sphere({-1.2f, 0.8f, -3}, 0.8f, shot.add(plain_material(glm::vec3(0.9f), 0.1f, 1.0f))));
    const std::uint32_t chalk = shot.add(plain_material(glm::vec3(0.7f), 0.9f));
    shot.add(box({0.8f, 0, -3.5f}, {1.4f, 2.4f, -2.9f}, chalk));
    return shot;
}

gpu::Camera outlook()
{
    return look({0, 1.4f, 4}, {0, 1.9f, -3}, 0.8f);
}

Shot sky_clear()
{
    return plain_land(outlook());
}

Shot sky_hazy()
{
    Shot shot = plain_land(outlook());
    shot.frame.sky.turbidity = 7.0f;
    shot.frame.sky.ground_albedo = 0.6f;
    shot.frame.sky.sun_azimuth_rad = 0.9f;
    return shot;
}

Shot sky_cloudy()
{
    Shot shot = plain_land(outlook());
    shot.frame.sky.cloud_cover = 0.55f;
    shot.frame.weather.wind_m_s = {6.0f, 2.0f};
    shot.frame.settings.time_s = 20.0;
    return shot;
}

Shot sky_overcast()
{
    Shot shot = plain_land(outlook());
    shot.frame.sky.cloud_cover = 1.0f;
    return shot;
}

// The sun stands in the picture, four degrees high.
Shot sky_low_sun()
{
    Shot shot = plain_land(outlook());
    shot.frame.sky.sun_elevation_rad = 0.07f;
    shot.frame.sky.sun_azimuth_rad = 0.35f;
    shot.frame.sky.cloud_cover = 0.3f;
    return shot;
}

Shot sky_dusk()
{
    Shot shot = plain_land(outlook());
    shot.frame.sky.sun_elevation_rad = -0.13f;
    shot.frame.sky.sun_azimuth_rad = 0.3f;
    gpu::Light lamp;
    lamp.color = {1.0f, 0.7f, 0.4f};
    lamp.intensity = 40.0f;
    lamp.position_m = {0, 1.8f, -2};
    shot.add(lamp);
    return shot;
}

// A studio: a bright window on one side, a warm lamp on the other, a dark floor, a seam at -z.
gpu::EnvironmentMap studio()
{
    gpu::EnvironmentMap map;
    map.width = 64;
    map.height = 32;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            glm::vec3 c = y < 16 ? glm::vec3(0.5f, 0.6f, 0.8f) : glm::vec3(0.15f, 0.12f, 0.1f);
            if (x >= 40 && x < 50 && y >= 6 && y < 14) c = glm::vec3(20.0f, 22.0f, 25.0f);
            if (x >= 10 && x < 13 && y >= 8 && y < 11) c = glm::vec3(60.0f, 30.0f, 10.0f);
            if (x == 32) c = glm::vec3(0.9f, 0.1f, 0.1f);
            map.rgb.insert(map.rgb.end(), {c.r, c.g, c.b});
        }
    }
    return map;
}

Shot environment()
{
    Shot shot = plain_land(outlook());
    shot.environment = studio();
    shot.frame.sky.analytic_sun = false;
    shot.frame.sky.environment_scale = 100.0f;
    shot.frame.sky.environment_rotation_rad = 0.5f;
    return shot;
}

// Rows of columns that fade into fog of 40 m.
Shot fog()
{
    Shot shot = plain_land(look({0, 1.6f, 4}, {0, 1.5f, -10}, 0.7f));
    for (int i = 0; i < 6; ++i) {
        const float z = -4.0f - 5.0f * static_cast<float>(i);
        for (const float x : {-3.5f, 3.0f}) shot.add(box({x, 0, z}, {x + 0.7f, 3, z + 0.7f}, 2));
    }
    shot.frame.weather.visibility_m = 40.0f;
    shot.frame.sky.cloud_cover = 0.7f;
    return shot;
}

// The plain from above, half a turn to the side, without perspective; rain on it.
Shot orthographic()
{
    Shot shot = plain_land(look({6, 8, 4}, {0, 0.5f, -3}));
    shot.frame.camera.orthographic_height_m = 6.0f;
    shot.frame.weather.film_albedo = 0.8f;
    shot.frame.weather.film_smoothness = 0.5f;
    shot.frame.weather.flood_puddles = 0.6f;
    gpu::Light lamp;
    lamp.intensity = 30000.0f;
    lamp.color = {1.0f, 0.6f, 0.3f};
    lamp.position_m = {0, 1.5f, -1.5f};
    lamp.range_m = 3.0f;
    shot.add(lamp);
    return shot;
}

// A wide lens, another sample pattern, a given exposure without the film curve, no sky drawn.
Shot plain_display()
{
    Shot shot = plain_land(look({0, 1.4f, 2}, {0, 1.0f, -3}, 1.6f));
    shot.frame.camera.near_m = 0.5f;
    shot.frame.settings.exposure = 0.00008f;
    shot.frame.settings.tone_map = gpu::ToneMap::Linear;
    shot.frame.settings.draw_sky = false;
    shot.frame.settings.seed = 5;
    shot.frame.settings.samples = 3;
    return shot;
}

// Metered, then half a stop less; neither shadows nor occlusion.
Shot exposure_bias()
{
    Shot shot = plain_land(outlook());
    shot.frame.settings.exposure_bias_stops = -0.5f;
    shot.frame.settings.shadows = false;
    shot.frame.settings.ambient_occlusion = false;
    return shot;
}

Shot empty_scene()
{
    Shot shot = plain_day(look({0, 1, 0}, {0, 1.2f, -1}, 1.0f));
    shot.add(plain_material(glm::vec3(0.5f)));
    return shot;
}

}  // namespace

std::vector<Case> sky_cases()
{
    return {
        {"sky_clear", "a clear noon", sky_clear},
        {"sky_hazy", "turbidity 7 and bright ground", sky_hazy},
        {"sky_cloudy", "55 % of clouds, moved by 20 s of wind", sky_cloudy},
        {"sky_overcast", "no sun through full clouds", sky_overcast},
        {"sky_low_sun", "the sun in the picture, four degrees high", sky_low_sun},
        {"sky_dusk", "the sun below the horizon, a lamp", sky_dusk},
        {"environment", "an HDR map, turned and scaled", environment},
        {"fog", "columns that fade within 40 m", fog},
        {"orthographic", "without perspective, wet, one lamp", orthographic},
        {"plain_display", "given exposure, no film curve, no sky, a wide lens", plain_display},
        {"exposure_bias", "half a stop below the meter; no shadows, no occlusion", exposure_bias},
        {"empty_scene", "nothing but sky", empty_scene},
    };
}

}  // namespace petrichor::golden
