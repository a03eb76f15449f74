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

// Share of a surface under clear ice, which shows as its film does.
float glaze_of(uint patch_number) { return wetness_of_film(place_state(patch_number, 3).z); }

LocalWeather weather_everywhere(SurfaceInput at, Exposure open)
{
    LocalWeather here;
    here.open = min(open.rain, 1.0);
    const FallShares shares = fall_shares(open.rain);
    here.film = shares.film;
    // Beside patches the frame's film is a closed one (gpu/frame/frame_constants.h): how much of it
    // lies in the open is told by its water.
    if (PLACE != 0u && frame.place.grid.levels > 0u) {
        here.film *= max(wetness_of_film(frame.weather.film_mm), frame.place.open_patch != kNoPatch ? glaze_of(frame.place.open_patch) : 0.0);
    }
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

// What the open holds, under whatever shelters a point of it.
void below_what_is_near(inout LocalWeather here, SurfaceInput at, Exposure open)
{
    here.open *= min(open.rain, 1.0);
    const FallShares shares = fall_shares(open.rain);
    here.film *= shares.film;
    if (!here.volume) here.flood *= shares.flood;
    if (SNOW != 0u) here.snow = cover_of_share(here.snow, open.snow * drifted_cover(at.position.xz, frame.weather.snow_depth_m));
    here.frost *= min(open.sky, 1.0);
}

// Below the water of a hollow; what is steep stands in none (gpu/upload/steep_triangles.cpp).
float pond_m(SurfaceInput at)
{
    if ((WATER & WATER_STEEP) != 0u) return 0.0;
    return at.normal.y > 0.3 ? place_depth(at.position) : 0.0;
}

LocalWeather local_weather(SurfaceInput at)
{
    if (PLACE == 0u) return weather_everywhere(at, exposure_to_sky(at));
    PlaceFound near = place_found(frame.place.grid, at.position, at.normal, place_turn(picture_pixel(at.pixel), frame.sample_index), at.material_id);
    const bool beyond = near.number == kNoPatch;
    // Ground goes on beyond its patches as they are in the open, or a border would show.
    if (beyond && at.normal.y > 0.3) near.number = frame.place.open_patch;
    const PlaceAnswer answer = place_answer(at, near.number, beyond);
    const float pond = pond_m(at);
    if (beyond) near.of_material = near.number != kNoPatch && uint(answer.last.w) == at.material_id;
    if (beyond && !near.of_material) {
        LocalWeather everywhere = weather_everywhere(at, answer.open);
        everywhere.pond_m = pond;
        return everywhere;
    }
    LocalWeather here;
    here.open = min(answer.second.z, 1.0);
    here.film = max(answer.first.x, wetness_of_film(answer.last.z));
    here.flood = answer.first.yz;
    here.snow = answer.first.w;
    here.frost = answer.second.x;
    here.frozen = answer.second.y;
    here.still = 1.0 - exp2(-10.0 * here.frozen);
    here.pond_m = pond;
    here.volume = WATER != 0u && answer.second.w > 0.0;
    // The heights of another material's relief mean nothing here.
    here.level = !here.volume ? 0.0 : near.of_material ? answer.second.w - 2.0 : -1.0;
    here.placed = true;
    if (beyond) below_what_is_near(here, at, answer.open);
    return here;
}

#endif
