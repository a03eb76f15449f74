// Light: lamps of each kind, many of them, shadows of the sun, occlusion, mirrors on a wet floor.
#include <random>

#include "tests/golden/stage.h"

namespace petrichor::golden {
namespace {

using gpu::Light;
using gpu::LightKind;
using gpu::look;
using gpu::Material;
using gpu::plain_material;
using gpu::quad;

// A room without daylight: floor, back wall, three balls of different roughness.
Shot dark_room()
{
    Shot shot = plain_day(look({0, 1.6f, 5}, {0, 0.6f, 0}, 0.6f));
    const std::uint32_t grey = shot.add(plain_material(glm::vec3(0.6f), 0.5f));
    shot.add(ground(4.0f, grey));
    shot.add(quad({-4, 0, -2}, {8, 0, 0}, {0, 4, 0}, grey));
    for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<float>(i);
        shot.add(sphere(
            {-1.2f + 1.2f * at, 0.45f, 0}, 0.45f,
            shot.add(plain_material({0.8f, 0.7f, 0.5f}, 0.1f + 0.35f * at, i == 2 ? 1.0f : 0.0f))));
    }
    shot.frame.sky.analytic_sun = false;
    shot.frame.settings.image_based_light = false;
    shot.frame.settings.exposure = 0.15f;
    return shot;
}

Light lamp(const glm::vec3& at, const glm::vec3& color, float candela, float range_m = 0.0f)
{
    Light light;
    light.position_m = at;
    light.color = color;
    light.intensity = candela;
    light.range_m = range_m;
    return light;
}

Shot lights_point()
{
    Shot shot = dark_room();
    shot.add(lamp({-1.5f, 1.3f, 0.8f}, {1.0f, 0.5f, 0.2f}, 6.0f));
    shot.add(lamp({1.5f, 0.9f, 1.0f}, {0.3f, 0.5f, 1.0f}, 8.0f, 2.0f));
    shot.frame.extra_lights.push_back(lamp({0, 2.2f, -1.2f}, {0.4f, 1.0f, 0.4f}, 4.0f));
    shot.frame.scene_light_scale = 0.8f;
    return shot;
}

Shot lights_spot()
{
    Shot shot = dark_room();
    for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<float>(i);
        Light light =
            lamp({-1.6f + 1.6f * at, 2.2f, 1.0f}, glm::vec3(1.0f, 0.9f - 0.2f * at, 0.7f), 120.0f);
        light.kind = LightKind::Spot;
        light.direction = glm::normalize(glm::vec3(0.4f - 0.4f * at, -1.0f, -0.7f));
        light.outer_cone_rad = 0.2f + 0.15f * at;
        light.inner_cone_rad = i == 1 ? light.outer_cone_rad - 0.01f : 0.0f;
        if (i == 2) light.range_m = 3.5f;
        shot.add(light);
    }
    return shot;
}

// The first directional light of the scene takes the sun's place and casts shadows; the second
// fills.
Shot lights_directional()
{
    Shot shot = dark_room();
    Light key;
    key.kind = LightKind::Directional;
    key.intensity = 20.0f;
    key.color = {1.0f, 0.9f, 0.7f};
    key.direction = glm::normalize(glm::vec3(-1.0f, -1.2f, -0.8f));
    shot.add(key);
    key.intensity = 5.0f;
    key.color = {0.3f, 0.4f, 1.0f};
    key.direction = glm::normalize(glm::vec3(1.0f, -0.5f, -0.3f));
    shot.add(key);
    return shot;
}

Shot lights_many()
{
    Shot shot = dark_room();
    std::mt19937 random(7);  // its numbers are the same everywhere; distributions are not
    const auto unit = [&random] { return static_cast<float>(random() >> 8) / 16777216.0f; };
    for (int i = 0; i < 300; ++i) {
        const float x = unit(), y = unit(), z = unit();
        const float r = unit(), g = unit(), b = unit();
        Light light = lamp({6.0f * (x - 0.5f), 1.5f * y, 4.0f * (z - 0.5f)}, {r, g, b}, 0.5f,
                           0.4f + 0.8f * unit());
        light.kind = i % 3 == 0 ? LightKind::Spot : LightKind::Point;
        shot.add(light);
    }
    return shot;
}

// A wall, a leaning board, a ball: contact, distance and slope of a shadow of the afternoon sun.
Shot shadows_sun()
{
    Shot shot = plain_day(look({0, 3.2f, 6}, {0, 0.4f, 0}, 0.6f));
    const std::uint32_t grey = shot.add(plain_material(glm::vec3(0.5f), 0.9f));
    shot.add(ground(6.0f, grey));
    shot.add(box({-2.6f, 0, -1.2f}, {-0.8f, 1.5f, -1.0f}, grey));
    shot.add(sphere({0.5f, 0.9f, 0}, 0.5f, grey));
    Material board = plain_material({0.6f, 0.4f, 0.2f}, 0.8f);
    board.double_sided = true;
    shot.add(quad({1.6f, 0, 0.6f}, {1.2f, 0, 0}, {0.2f, 1.2f, -0.8f}, shot.add(board)));
    shot.frame.sky.sun_elevation_rad = 0.45f;
    shot.frame.sky.sun_azimuth_rad = 1.1f;
    shot.frame.settings.samples = 4;
    return shot;
}

// Posts along a road of 150 m: shadows in every cascade and beyond the last.
Shot shadows_cascades()
{
    Shot shot = plain_day(look({0, 3, 4}, {0, 0, -25}, 0.6f));
    const std::uint32_t road = shot.add(plain_material(glm::vec3(0.45f), 0.9f));
    const std::uint32_t paint = shot.add(plain_material({0.8f, 0.3f, 0.2f}, 0.7f));
    shot.add(quad({-30, 0, 6}, {60, 0, 0}, {0, 0, -160}, road));
    for (int i = 0; i < 18; ++i) {
        const float z = -0.35f * static_cast<float>(i * i) - 2.0f;
        for (const float x : {-3.0f, 3.0f}) {
            shot.add(box({x - 0.2f, 0, z - 0.2f}, {x + 0.2f, 2.2f, z + 0.2f}, paint));
        }
    }
    shot.frame.sky.sun_elevation_rad = 0.5f;
    shot.frame.sky.sun_azimuth_rad = 4.9f;
    return shot;
}

// Niches and gaps under an overcast sky: occlusion alone makes the depth.
Shot ambient_occlusion()
{
    Shot shot = plain_day(look({0.6f, 2.2f, 5}, {0, 0.5f, 0}, 0.6f));
    const std::uint32_t white = shot.add(plain_material(glm::vec3(0.7f), 0.9f));
    shot.add(ground(5.0f, white));
    shot.add(quad({-5, 0, -2}, {10, 0, 0}, {0, 3, 0}, white));
    for (int i = 0; i < 4; ++i) {
        const float x = -2.2f + 1.1f * static_cast<float>(i);
        shot.add(
            box({x, 0, -1.4f}, {x + 0.9f - 0.15f * static_cast<float>(i), 1.0f, -0.4f}, white));
    }
    shot.add(box({-1.6f, 0.7f, 0.2f}, {1.6f, 0.8f, 1.0f}, white));  // a table top
    shot.frame.sky.cloud_cover = 1.0f;
    shot.frame.settings.samples = 8;
    return shot;
}

// Bright plates mirrored in a wet, smooth floor.
Shot reflections()
{
    Shot shot = plain_day(look({0, 0.9f, 5}, {0, 0.5f, 0}, 0.6f));
    Material asphalt = plain_material(glm::vec3(0.1f), 0.6f);
    asphalt.weather.default_height = 0.0f;
    shot.add(ground(6.0f, shot.add(asphalt)));
    const glm::vec3 colors[] = {{0.9f, 0.15f, 0.1f}, {0.9f, 0.8f, 0.2f}, {0.2f, 0.5f, 0.9f}};
    for (int i = 0; i < 3; ++i) {
        const float x = -2.1f + 1.5f * static_cast<float>(i);
        shot.add(box({x, 0.0f, -0.6f}, {x + 1.0f, 0.5f + 0.4f * static_cast<float>(i), -0.4f},
                     shot.add(plain_material(colors[i], 0.7f))));
    }
    Material lamp_glass = plain_material(glm::vec3(0.2f));
    lamp_glass.emissive = glm::vec3(20000.0f, 15000.0f, 8000.0f);
    shot.add(sphere({0.2f, 1.3f, 0.4f}, 0.15f, shot.add(lamp_glass)));
    shot.frame.weather.film_albedo = 0.85f;
    shot.frame.weather.film_smoothness = 0.5f;
    shot.frame.weather.flood_puddles = 1.0f;
    shot.frame.sky.cloud_cover = 0.8f;
    shot.frame.emissive_scale = 0.7f;
    shot.frame.settings.samples = 4;
    return shot;
}

}  // namespace

std::vector<Case> light_cases()
{
    return {
        {"lights_point", "three point lights, one with a range, one added to the scene's",
         lights_point},
        {"lights_spot", "soft and sharp cones of three widths", lights_spot},
        {"lights_directional", "a light of the scene as the sun, with shadows, and a second",
         lights_directional},
        {"lights_many", "300 coloured lamps of short range", lights_many},
        {"shadows_sun", "contact, slope and distance of the sun's shadows", shadows_sun},
        {"shadows_cascades", "shadows along 150 m", shadows_cascades},
        {"ambient_occlusion", "niches under an overcast sky", ambient_occlusion},
        {"reflections", "plates and a lamp mirrored in wet asphalt", reflections},
    };
}

}  // namespace petrichor::golden
