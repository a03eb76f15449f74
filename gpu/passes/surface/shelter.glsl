// How much of what falls from the sky reaches a point.
#ifndef PETRICHOR_SURFACE_SHELTER_GLSL
#define PETRICHOR_SURFACE_SHELTER_GLSL

#include "formulas/light/place_cells.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/depth_quads.h"
#include "formulas/weather/falls_here.h"
#include "formulas/weather/wander.h"
#include "gpu/passes/surface/textures.glsl"
#include "gpu/frame/picture_pixel.glsl"
#include "gpu/frame/place_falls_io.h"

struct Exposure {
    float rain;  // share of that on open flat ground
    float snow;
    float sky;  // as the snow, the less the more it looks away
};

// Along the surface, so that it does not shelter itself.
vec3 stray(SurfaceInput at)
{
    const vec2 way = (0.8 * wander(at.position.xz) + 0.7 * on_circle(dither(picture_pixel(at.pixel), frame.sample_index + 3u))) * frame.shelter_spread_m;
    const vec3 flat_way = vec3(way.x, 0.0, way.y);
    return flat_way - at.normal * dot(at.normal, flat_way);
}

// By a number that is known as the shader runs alone: texels, since words of a uniform block cost a CPU several times
// as much then. They lie behind the states of patches; how far off the surface is not among them.
FallConstants fall_by_texels(int k)
{
    const uint patches = frame.place.grid.patches;
    const int first = int(patches * kPlaceTexels + (patches + 1u) * PLACE_STATE_TEXELS) + k * PLACE_FALL_TEXELS;
    FallConstants fall;
    fall.column = uintBitsToFloat(texelFetch(place_states, first));
    fall.row = uintBitsToFloat(texelFetch(place_states, first + 1));
    fall.depth = uintBitsToFloat(texelFetch(place_states, first + 2));
    const vec4 level_rain = uintBitsToFloat(texelFetch(place_states, first + 3));
    const vec2 snow_layer = uintBitsToFloat(texelFetch(place_states, first + 4).xy);
    fall.level = level_rain.xyz;
    fall.rain = level_rain.w;
    fall.snow = snow_layer.x;
    fall.layer = int(snow_layer.y);
    return fall;
}

// Adds what falls along one direction. lifted: off the surface.
void fall_on(inout Exposure open, SurfaceInput at, vec4 lifted, FallConstants fall)
{
    const vec3 map = vec3(dot(fall.column, lifted), dot(fall.row, lifted), dot(fall.depth, lifted));
    // What lies beside the map is open, as its rim is (depth_quads.comp.glsl).
    const vec2 p = clamp(map.xy, vec2(0.0), vec2(float(SKY_MAP_SIZE - 1)));
    const ivec2 texel = ivec2(p);
    const int place = (fall.layer * SKY_MAP_SIZE + texel.y) * SKY_MAP_SIZE + texel.x;
    const float seen = share_passed(texelFetch(shelter_quads, place).rg, map.z, p - vec2(texel));
    const float facing = facing_on_level(at.normal, fall.level);
    open.rain += fall.rain * seen * facing;
    // The relief of land has places that face it.
    open.snow += fall.snow * seen * ((BESIDES & BESIDES_WIDE_GROUND) != 0u ? 1.0 : snow_facing_share(facing));
    open.sky += fall.snow * seen * facing;
}

// By the depth maps of the sky, along the few directions that rain and snow come from: as many as the pipeline is
// made for, one by one. A CPU gathers constants of a loop for each pixel of a group, those of a fixed place once.
Exposure exposure_to_sky(SurfaceInput at, bool asked)
{
    Exposure open;
    open.rain = 1.0;
    open.snow = 1.0;
    open.sky = 1.0;
    if ((frame.flags & FRAME_SHELTER) == 0u) return open;
    open.rain = 0.0;
    open.snow = 0.0;
    open.sky = 0.0;
    const vec4 lifted = vec4(at.position + stray(at) + at.normal * fall_of(0).lift_m, 1.0);
    if (PLACE != 0u) {
        // Most ask their patch: a loop ends where none of a group does not.
        // It asks at its end: a CPU takes a loop that asks at its beginning once more, for nobody.
        int k = 0;
        do {
            if (asked && k < FALLS) fall_on(open, at, lifted, fall_by_texels(k));
        } while (++k < (asked ? FALLS : 0));
        return open;
    }
#define FALL(k) if (FALLS > k) fall_on(open, at, lifted, fall_of(k));
    FALL(0) FALL(1) FALL(2) FALL(3) FALL(4) FALL(5) FALL(6) FALL(7)
    FALL(8) FALL(9) FALL(10) FALL(11) FALL(12) FALL(13) FALL(14) FALL(15)
#undef FALL
    return open;
}

#endif
