// The weather where a point lies: of its patch, or of the frame under whatever shelters the point.
#ifndef PETRICHOR_SURFACE_LOCAL_WEATHER_GLSL
#define PETRICHOR_SURFACE_LOCAL_WEATHER_GLSL

#include "formulas/noise/noise.h"
#include "formulas/weather/ground_relief.h"
#include "gpu/passes/surface/shelter.glsl"
#include "gpu/frame/place.glsl"

struct LocalWeather {
    float open;    // share of what falls that reaches the point
    float film;    // of the frame's film, on any slope where `placed`
    vec2 flood;    // level of water in cracks, in puddles
    float snow;    // amount, before slope and material
    float frost;
    float frozen;  // share of the water
    float still;   // how far frost has stilled it
    float pond_m;  // depth below the water of a hollow
    float level;   // of the water in the relief, in its heights, where `volume`
    bool volume;   // the relief holds what a patch says; else as `flood` says
    bool placed;   // from a patch
};

LocalWeather weather_everywhere(SurfaceInput at, bool asked)
{
    LocalWeather here;
    const Exposure open = exposure_to_sky(at, asked);
    here.open = min(open.rain, 1.0);
    const FallShares shares = fall_shares(open.rain);
    here.film = shares.film;
    // Beside patches the frame's film is a closed one (gpu/frame/frame_constants.h): how much of it
    // lies in the open is told by its water.
    if (PLACE != 0u && frame.place.grid.levels > 0u) here.film *= wetness_of_film(frame.weather.film_mm);
    here.flood = vec2(frame.weather.flood_cracks, frame.weather.flood_puddles) * shares.flood;
    here.snow = 0.0;
    if (SNOW != 0u) {
        here.snow = cover_of_share(frame.weather.snow_amount, open.snow * drifted_cover(at.position.xz, frame.weather.snow_depth_m));
    }
    // Hoar is of the air: it grows where heat is lost to the sky, most of which is overhead.
    here.frost = frame.weather.frost * min(open.sky, 1.0);
    here.frozen = frame.weather.water_to_snow;
    here.still = frame.weather.freeze_exp;
    here.pond_m = 0.0;
    here.level = 0.0;
    here.volume = false;
    here.placed = false;
    return here;
}

// Of the water in the relief of this material: the heights of another one mean nothing here.
float level_in_relief(SurfaceInput at, uvec2 near, float other)
{
    if (uint(place_state(near.y, 3).w) == at.material_id) return other - 2.0;
    if (uint(place_state(near.x, 3).w) == at.material_id) return place_state(near.x, 1).w - 2.0;
    return -1.0;
}

// What the open holds, under whatever shelters a point of it.
void below_what_is_near(inout LocalWeather here, SurfaceInput at)
{
    const Exposure open = exposure_to_sky(at, true);
    here.open *= min(open.rain, 1.0);
    const FallShares shares = fall_shares(open.rain);
    here.film *= shares.film;
    if (!here.volume) here.flood *= shares.flood;
    if (SNOW != 0u) here.snow = cover_of_share(here.snow, open.snow * drifted_cover(at.position.xz, frame.weather.snow_depth_m));
    here.frost *= min(open.sky, 1.0);
}

// A patch has the material of most of its cell: of that of the point one is looked for a cell further, on
// four sides from a random one on. A wall does not blend into the lamp before it, nor a path into the lawn.
uint patch_of_material(SurfaceInput at, uvec2 near, vec3 turn)
{
    if (near.y == kNoPatch) return near.y;
    const uint found = uint(place_state(near.y, 3).w);
    if (found == at.material_id) return near.y;
    vec3 way = turn - at.normal * dot(turn, at.normal);
    way /= max(max(abs(way.x), max(abs(way.y), abs(way.z))), 1.0e-3);
    for (int side = 0; side < 4; ++side) {
        const uint other = place_patch(at.position, at.normal, way);
        if (uint(place_state(other, 3).w) == at.material_id) return other;
        way = side == 1 ? cross(at.normal, way) : -way;
    }
    return found == uint(place_state(near.x, 3).w) ? near.y : near.x;
}

// Below the water of a hollow; what is steep stands in none (gpu/upload/steep_triangles.cpp).
float pond_m(SurfaceInput at)
{
    if ((WATER & WATER_STEEP) != 0u) return 0.0;
    return at.normal.y > 0.3 ? place_depth(at.position) : 0.0;
}

LocalWeather local_weather(SurfaceInput at)
{
    if (PLACE == 0u) return weather_everywhere(at, true);
    // A turn of its own for every pixel, evenly spread over its samples: their mean blends between
    // patches.
    const ivec2 pixel = picture_pixel(at.pixel);
    const uint seed = hash_u3(uint(pixel.x), uint(pixel.y), 29u);
    const vec3 first = vec3(hash_f(seed), hash_f(seed ^ 0x9e3779b9u), hash_f(seed ^ 0x7f4a7c15u));
    const vec3 turn =
        fract(first + float(frame.sample_index) * vec3(0.8191725, 0.6710436, 0.5497005));
    uvec2 near = place_patches(at.position, at.normal, turn - 0.5);
    near.y = patch_of_material(at, near, turn - 0.5);
    const bool beyond = near.y == kNoPatch;
    // Ground goes on beyond its patches as they are in the open, or a border would show.
    if (beyond && place_open(at.normal, at.material_id)) near = uvec2(frame.place.open_patch);
    if (near.y == kNoPatch) {
        LocalWeather everywhere = weather_everywhere(at, true);
        everywhere.pond_m = pond_m(at);
        return everywhere;
    }
    const vec4 first_texel = place_state(near.y, 0);
    const vec4 second_texel = place_state(near.y, 1);
    LocalWeather here;
    here.open = min(second_texel.z, 1.0);
    here.film = first_texel.x;
    here.flood = first_texel.yz;
    here.snow = first_texel.w;
    here.frost = second_texel.x;
    here.frozen = second_texel.y;
    here.still = 1.0 - exp2(-10.0 * here.frozen);
    here.pond_m = pond_m(at);
    here.volume = WATER != 0u && second_texel.w > 0.0;
    here.level = here.volume ? level_in_relief(at, near, second_texel.w) : 0.0;
    here.placed = true;
    if (beyond) below_what_is_near(here, at);
    return here;
}

#endif
