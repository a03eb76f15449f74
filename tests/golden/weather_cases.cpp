// Each cover that weather lays over a surface, alone, on the same courtyard.
#include <glm/gtc/matrix_transform.hpp>

#include "tests/golden/stage.h"

namespace petrichor::golden {
namespace {

using gpu::look;
using gpu::Material;
using gpu::plain_material;
using gpu::quad;
using shared::WeatherMoment;

// A floor of stones with a hollow in its middle, a ramp at the left, a ball and a step at the
// right, a plastered wall behind. The floor has a height map, a normal map and a puddle mask.
Shot courtyard()
{
    Shot shot = plain_day(look({0, 1.9f, 5.2f}, {0, 0.35f, 0}, 0.62f));
    Material floor = plain_material(glm::vec3(1.0f), 0.85f);
    floor.base_color_texture = shot.add(chequers({0.62f, 0.58f, 0.54f}, {0.5f, 0.47f, 0.45f}, 6));
    floor.normal_texture = shot.add(stone_normals());
    floor.weather.height = shot.add(stone_heights());
    for (gpu::TextureUse* use :
         {&floor.base_color_texture, &floor.normal_texture, &floor.weather.height}) {
        use->scale = glm::vec2(2.0f);
    }
    floor.weather.puddle_mask = shot.add(blot());
    floor.weather.water_accumulation.w = 1.7f;  // the hollow fills over its stones
    shot.add(ground(2.4f, shot.add(floor)));
    const std::uint32_t plaster = shot.add(plain_material({0.6f, 0.5f, 0.4f}, 0.9f));
    shot.add(quad({-2.4f, 0, -2.0f}, {4.8f, 0, 0}, {0, 2.2f, 0}, plaster));
    // A ramp of thirty degrees that looks to the right.
    shot.add(quad({-1.3f, 0, 0.9f}, {0, 0, -1.8f}, {-1.0f, 0.58f, 0}, plaster));
    const std::uint32_t smooth = shot.add(plain_material({0.25f, 0.4f, 0.55f}, 0.35f));
    shot.add(sphere({1.4f, 0.55f, -0.4f}, 0.55f, smooth));
    shot.add(box({0.7f, 0, 0.7f}, {1.6f, 0.3f, 1.4f}, plaster));
    return shot;
}

WeatherMoment film_only()
{
    WeatherMoment w;
    w.film_albedo = 0.85f;
    w.film_smoothness = 0.5f;
    return w;
}

WeatherMoment puddles_only()
{
    WeatherMoment w = film_only();
    w.flood_cracks = 0.55f;
    w.flood_puddles = 0.95f;
    return w;
}

WeatherMoment snow_only(float amount)
{
    WeatherMoment w;
    w.snow_amount = amount;
    w.water_to_snow = 1.0f;
    w.freeze_exp = 0.999f;
    return w;
}

Shot rain_film()
{
    Shot shot = courtyard();
    shot.frame.weather = film_only();
    return shot;
}

// Spheres, dense to porous from left to right; dry above, wet below.
Shot porosity()
{
    Shot shot = plain_day(look({0, 0, 8}, {0, 0, 0}, 0.36f));
    for (int row = 0; row < 2; ++row) {
        for (int i = 0; i < 5; ++i) {
            Material m = plain_material({0.6f, 0.45f, 0.3f}, i == 4 ? 0.15f : 0.8f);
            m.weather.porosity = i < 3 ? 0.5f * static_cast<float>(i) : -1.0f;
            m.weather.sheltered = row == 0;
            shot.add(sphere({static_cast<float>(i) - 2.0f, row == 0 ? 0.55f : -0.55f, 0}, 0.45f,
                            shot.add(m)));
        }
    }
    shot.frame.weather = film_only();
    shot.frame.settings.shelter = false;  // the upper row is no roof
    return shot;
}

Shot puddles()
{
    Shot shot = courtyard();
    shot.frame.weather = puddles_only();
    return shot;
}

// Water of a material's own: murky ditches that do not need rain, and masks at the vertices.
Shot murky_water()
{
    Shot shot = courtyard();
    Material& floor = shot.scene.materials[0];
    floor.weather.puddle_mask = {};
    floor.weather.water_accumulation = {0.7f, 0.5f, 1.4f, 0.2f};
    floor.weather.water_color = {0.12f, 0.09f, 0.04f, 0.7f};
    gpu::Primitive& p = shot.scene.meshes[0].primitives[0];
    p.weather = {{1, 1, 1, 1}, {1, 0, 1, 1}, {1, 0, 1, 1}, {1, 1, 1, 1}};
    Material& ball = shot.scene.materials[2];  // algae on metal
    ball.metallic = 1.0f;
    ball.weather.water_slope_damp = 1.0f;
    ball.weather.water_accumulation = {1.0f, 0.0f, 1.0f, 0.0f};
    ball.weather.water_color = {0.1f, 0.2f, 0.05f, 0.6f};
    shot.frame.weather.flood_cracks = 0.2f;
    shot.frame.weather.flood_puddles = 0.4f;
    return shot;
}

// Rings of drops on level water, streams on the ramps, in wind.
Shot ripples_flow()
{
    Shot shot = plain_day(look({0, 0.8f, 1.9f}, {0, 0.05f, 0}, 0.7f));
    Material stone = plain_material({0.35f, 0.33f, 0.3f}, 0.8f);
    stone.base_color_texture = shot.add(chequers(glm::vec3(0.9f), glm::vec3(0.5f)));
    stone.weather.default_height = 0.1f;
    stone.weather.water_slope_damp = 1.0f;
    stone.weather.flow_speed = 0.6f;
    stone.weather.flow_tiling = 1.4f;
    stone.weather.flow_interval_s = 1.7f;
    stone.weather.flow_normal_strength = 1.5f;
    stone.weather.flow_refraction = 0.1f;
    const std::uint32_t id = shot.add(stone);
    shot.add(quad({-0.8f, 0, 1.5f}, {1.6f, 0, 0}, {0, 0, -3.0f}, id));
    shot.add(quad({-0.8f, 0, 1.5f}, {0, 0, -3.0f}, {-1.2f, 0.5f, 0}, id));
    shot.add(quad({0.8f, 0, -1.5f}, {0, 0, 3.0f}, {1.2f, 1.1f, 0}, id));
    WeatherMoment& w = shot.frame.weather;
    w = puddles_only();
    w.rain = 1.0f;
    w.flood_cracks = 0.8f;
    w.wind_m_s = {4.0f, -2.0f};
    shot.frame.settings.time_s = 1.3;
    shot.frame.sky.sun_elevation_rad = 0.5f;
    shot.frame.sky.sun_azimuth_rad = 0.2f;
    shot.frame.settings.samples = 4;
    return shot;
}

Shot snow()
{
    Shot shot = courtyard();
    shot.scene.materials[0].weather.snow_mask = shot.add(blot());
    shot.frame.weather = snow_only(1.0f);
    return shot;
}

Shot snow_first_flakes()
{
    Shot shot = courtyard();
    gpu::Primitive& p = shot.scene.meshes[0].primitives[0];  // less to the right, by the vertices
    p.weather = {{1, 1, 1, 1}, {1, 1, 0, 1}, {1, 1, 0.3f, 1}, {1, 1, 1, 1}};
    shot.frame.weather = snow_only(0.35f);
    return shot;
}

// Terraces and slopes of a hillside around the snow line; the step in front glows through its snow.
Shot snow_line()
{
    Shot shot = plain_day(look({0, 7, 18}, {0, 2.4f, 0}, 0.55f));
    Material rock = plain_material({0.35f, 0.32f, 0.3f}, 0.9f);
    const std::uint32_t even = shot.add(rock);
    rock.weather.snow_slope_damp = 3.0f;
    rock.weather.snow_normal_strength = 1.7f;
    rock.weather.snow_detail_strength = 0.9f;
    const std::uint32_t shedding = shot.add(rock);
    rock.weather.snow_accumulation = {0.3f, 0.7f};
    const std::uint32_t always = shot.add(rock);
    for (int i = 0; i < 7; ++i) {
        const auto at = static_cast<float>(i);
        shot.add(quad({-6, at, 3 - at}, {4, 0, 0}, {0, 0, -1}, even));
        shot.add(quad({-2, at, 3 - at}, {-4, 0, 0}, {0, -1, 0}, even));
    }
    shot.add(quad({-2, 0, 3.5f}, {4, 0, 0}, {0, 7, -7}, shedding));
    shot.add(quad({2, 0, 3.5f}, {4, 0, 0}, {0, 7, -7}, always));
    Material lamp = plain_material(glm::vec3(0.1f));
    lamp.emissive = {9000.0f, 5000.0f, 1500.0f};
    lamp.weather.snow_opacity = 0.6f;
    shot.add(box({-0.8f, 0, 4.2f}, {0.8f, 1.2f, 5.4f}, shot.add(lamp)));
    shot.add(ground(12.0f, even));
    WeatherMoment& w = shot.frame.weather;
    w = snow_only(0.8f);
    w.snow_start_height_m = 0.5f;
    w.snow_height_blend_m = 4.0f;
    shot.frame.look.snow_color = {0.85f, 0.9f, 1.0f};
    return shot;
}

Shot melt()
{
    Shot shot = courtyard();
    WeatherMoment& w = shot.frame.weather;
    w = snow_only(0.5f);
    w.water_to_snow = 0.6f;
    w.freeze_exp = 0.98f;
    w.melt = 0.5f;
    w.melt_exp = 0.97f;
    w.film_albedo = 0.5f;
    w.film_smoothness = 0.3f;
    return shot;
}

Shot frost()
{
    Shot shot = courtyard();
    shot.frame.weather.frost = 0.8f;
    return shot;
}

// Puddles that turn to ice, in rain that turns to snow.
Shot freezing()
{
    Shot shot = courtyard();
    WeatherMoment& w = shot.frame.weather;
    w = puddles_only();
    w.rain = 0.4f;
    w.snowfall = 0.4f;
    w.water_to_snow = 0.5f;
    w.freeze_exp = 0.96f;
    w.snow_amount = 0.15f;
    w.frost = 0.3f;
    shot.frame.settings.time_s = 0.8;
    return shot;
}

// A roof over the left half, in wind: rain is driven in below its edge.
Shot under_a_roof(const WeatherMoment& weather)
{
    Shot shot = courtyard();
    const std::uint32_t tin = shot.add(plain_material({0.5f, 0.52f, 0.55f}, 0.4f, 1.0f));
    shot.add(box({-2.4f, 1.25f, -2.0f}, {0.0f, 1.32f, 1.0f}, tin));
    shot.frame.weather = weather;
    shot.frame.weather.wind_m_s = {-3.0f, 0.0f};
    shot.frame.sky.cloud_cover = 0.9f;
    return shot;
}

Shot shelter_rain()
{
    WeatherMoment w = puddles_only();
    w.rain = 0.8f;
    w.flood_puddles = 1.2f;
    w.flood_cracks = 0.9f;
    return under_a_roof(w);
}

Shot shelter_snow()
{
    return under_a_roof(snow_only(0.9f));
}

// Plates of copper and iron, smooth and rough: dry, wet, under standing water.
Shot wet_metal()
{
    Shot shot = plain_day(look({0, 2.4f, 3.4f}, {0, 0, 0}, 0.62f));
    const glm::vec3 colors[] = {{0.95f, 0.64f, 0.54f}, {0.56f, 0.57f, 0.58f}};
    for (int metal = 0; metal < 2; ++metal) {
        for (int i = 0; i < 3; ++i) {
            for (int rough = 0; rough < 2; ++rough) {
                Material m = plain_material(colors[metal], rough == 0 ? 0.25f : 0.7f, 1.0f);
                m.weather.sheltered = i == 0;
                if (i == 2) m.weather.water_accumulation = {1.0f, 0.0f, 1.0f, 0.0f};
                const float x =
                    -1.8f + 1.2f * static_cast<float>(i) + 0.6f * static_cast<float>(rough);
                const float z = metal == 0 ? -0.1f : 1.2f;
                shot.add(quad({x, 0, z}, {0.55f, 0, 0}, {0, 0, -1.1f}, shot.add(m)));
            }
        }
    }
    shot.frame.weather = film_only();
    shot.frame.sky.cloud_cover = 0.4f;
    return shot;
}

}  // namespace

std::vector<Case> weather_cases()
{
    return {
        {"rain_film", "a wet film: porous stone darkens, all of it shines", rain_film},
        {"porosity", "film on porosity 0, 0.5, 1 and from the roughness; dry above", porosity},
        {"puddles", "standing water in cracks and in the masked hollow", puddles},
        {"murky_water", "water of a material's own, coloured, masked at the vertices", murky_water},
        {"ripples_flow", "rings on level water, streams on two slopes, wind", ripples_flow},
        {"snow", "full cover; a mask on the floor; steep faces stay free", snow},
        {"snow_first_flakes", "35 % of snow: patches by the two-frequency mask", snow_first_flakes},
        {"snow_line", "snow by height and slope, on terraces and slopes; a glowing block",
         snow_line},
        {"melt", "half-molten snow and the water around it", melt},
        {"frost", "hoar frost on what sees the sky", frost},
        {"freezing", "puddles turn to ice, rain to snow", freezing},
        {"shelter_rain", "a roof keeps rain off, wind drives it in", shelter_rain},
        {"shelter_snow", "a roof keeps snow off", shelter_snow},
        {"wet_metal", "copper and iron: dry, wet, under water", wet_metal},
    };
}

}  // namespace petrichor::golden
