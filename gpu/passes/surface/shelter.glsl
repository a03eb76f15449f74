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

// Adds what falls along one direction. lifted: off the surface. asks: a CPU reads for all pixels of a group, these for themselves.
void fall_on(inout Exposure open, SurfaceInput at, vec4 lifted, FallConstants fall, bool asks)
{
    const vec3 map = vec3(dot(fall.column, lifted), dot(fall.row, lifted), dot(fall.depth, lifted));
    // What lies beside the map is open, as its rim is (depth_quads.comp.glsl).
    const vec2 p = clamp(map.xy, vec2(0.0), vec2(float(SKY_MAP_SIZE - 1)));
    const ivec2 texel = ivec2(p);
    const int place = asks ? (fall.layer * SKY_MAP_SIZE + texel.y) * SKY_MAP_SIZE + texel.x : 0;
    const float seen = share_passed(texelFetch(shelter_quads, place).rg, map.z, p - vec2(texel));
    const float facing = facing_on_level(at.normal, fall.level);
    open.rain += fall.rain * seen * facing;
    // The relief of land has places that face it.
    open.snow += fall.snow * seen * ((BESIDES & BESIDES_WIDE_GROUND) != 0u ? 1.0 : snow_facing_share(facing));
    open.sky += fall.snow * seen * facing;
}

// Off the surface, where looks to the sky begin.
vec4 lifted_point(SurfaceInput at) { return vec4(at.position + stray(at) + at.normal * fall_of(0).lift_m, 1.0); }

bool shelters_are_known() { return (frame.flags & FRAME_SHELTER) != 0u; }

// By the depth maps of the sky, along the few directions that rain and snow come from: as many as the pipeline is
// made for, one by one. A CPU gathers constants of a loop for each pixel of a group, those of a fixed place once.
Exposure exposure_to_sky(SurfaceInput at)
{
    if (!shelters_are_known()) return Exposure(1.0, 1.0, 1.0);
    Exposure open = Exposure(0.0, 0.0, 0.0);
    const vec4 lifted = lifted_point(at);
#define FALL(k) if (FALLS > k) fall_on(open, at, lifted, fall_of(k), true);
    FALL(0) FALL(1) FALL(2) FALL(3) FALL(4) FALL(5) FALL(6) FALL(7)
    FALL(8) FALL(9) FALL(10) FALL(11) FALL(12) FALL(13) FALL(14) FALL(15)
#undef FALL
    return open;
}

// What a point asks the table of states (gpu/frame/place.glsl).
struct PlaceAnswer {
    vec4 first;  // texels 0, 1 and 3 of a state
    vec4 second;
    vec4 last;
    Exposure open;
};

#ifdef LOOKS_LATER
// Few points beside patches look to the sky, and a CPU takes for all what one of a group asks. So a shader that says LOOKS_LATER
// leaves such a point alone, answers all that wait at once and shades them again (surface_resolve.comp.glsl).
bool later() { return LANES != 0u && PLACE != 0u && WATER != 0u && (WATER & WATER_BEADS) == 0u; }  // beads ask at two points
struct SkyLook {
    bool asked;  // by the point that was shaded last: what it has is not known
    bool known;  // what the point that is shaded has
    vec3 position;
    vec3 normal;
    ivec2 pixel;
    Exposure open;
};
SkyLook sky_look;

void look_to_sky()
{
    SurfaceInput at;
    at.position = sky_look.position;
    at.normal = sky_look.normal;
    at.pixel = sky_look.pixel;
    sky_look.open = exposure_to_sky(at);
    sky_look.known = sky_look.asked;
}

PlaceAnswer place_answer_or_later(SurfaceInput at, uint number, bool beyond)
{
    const bool looks = beyond && shelters_are_known();
    const int from = int(frame.place.grid.patches * kPlaceTexels) + (number == kNoPatch ? 0 : int(number) * PLACE_STATE_TEXELS);
    PlaceAnswer answer;
    answer.first = uintBitsToFloat(texelFetch(place_states, from));
    answer.second = uintBitsToFloat(texelFetch(place_states, from + 1));
    answer.last = uintBitsToFloat(texelFetch(place_states, from + 3));
    answer.open = Exposure(1.0, 1.0, 1.0);
    if (looks) answer.open = sky_look.open;
    sky_look.asked = looks && !sky_look.known;
    if (sky_look.asked) {
        sky_look.position = at.position;
        sky_look.normal = at.normal;
        sky_look.pixel = at.pixel;
    }
    return answer;
}
#endif

// number: of a state, kNoPatch for none; beyond: how open it is to the sky is asked. Where rain comes from lies behind the states
// (place_falls_io.h), since words of a uniform block cost a CPU several times as much once their number is known as the shader runs
// alone. So a turn of one loop reads five texels either way, and a group of pixels that all have a patch, as most do, reads no others.
PlaceAnswer place_answer(SurfaceInput at, uint number, bool beyond)
{
#ifdef LOOKS_LATER
    if (later()) return place_answer_or_later(at, number, beyond);
#endif
    const bool looks = beyond && shelters_are_known();
    const float none = looks ? 0.0 : 1.0;
    PlaceAnswer answer;
    answer.first = vec4(0.0);
    answer.second = vec4(0.0);
    answer.last = vec4(0.0);
    answer.open = Exposure(none, none, none);
    const vec4 lifted = lifted_point(at);
    const uint patches = frame.place.grid.patches;
    const int states = int(patches * kPlaceTexels);
    const int falls = states + int(patches + 1u) * PLACE_STATE_TEXELS;
    const int turns = looks ? FALLS : 0;
    int k = -1;
    // It asks at its end: a CPU takes a loop that asks at its beginning once more, for nobody. All points that look take as many turns,
    // and one that does not reads its state in each, since a CPU keeps what points come to that have left a loop before others.
    do {
        const bool state = k < 0 || !looks;
        const int from = state && number != kNoPatch ? states + int(number) * PLACE_STATE_TEXELS : falls + max(k, 0) * PLACE_FALL_TEXELS;
        const vec4 a = uintBitsToFloat(texelFetch(place_states, from));
        const vec4 b = uintBitsToFloat(texelFetch(place_states, from + 1));
        const vec4 c = uintBitsToFloat(texelFetch(place_states, from + 2));
        const vec4 d = uintBitsToFloat(texelFetch(place_states, from + 3));
        const vec4 e = uintBitsToFloat(texelFetch(place_states, state ? from : from + 4));  // not the next state, from another line
        answer.first = state ? a : answer.first;
        answer.second = state ? b : answer.second;
        answer.last = state ? d : answer.last;
        FallConstants fall;
        fall.column = a;
        fall.row = b;
        fall.depth = c;
        fall.level = d.xyz;
        fall.rain = d.w;
        fall.snow = e.x;
        fall.layer = state ? 0 : int(e.y);
        if (!state) fall_on(answer.open, at, lifted, fall, !state);
    } while (++k < turns);
    return answer;
}

#endif
