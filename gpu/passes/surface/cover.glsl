// All weather on a surface point. It comes before the material: it decides where that is read.
#ifndef PETRICHOR_SURFACE_COVER_GLSL
#define PETRICHOR_SURFACE_COVER_GLSL

#include "formulas/weather/ground_tone.h"
#include "gpu/passes/surface/frost.glsl"
#include "gpu/passes/surface/local_weather.glsl"
#include "gpu/passes/surface/snow.glsl"
#include "gpu/passes/surface/snow_body.glsl"
#include "gpu/passes/surface/tracks.glsl"
#include "gpu/passes/surface/water.glsl"

struct Cover {
    float film;
    float water;
    float snow;
    float frost;
    float snow_smoothness;
    vec3 normal;      // of the water or snow
    vec2 refraction;  // shift of the texture coordinates below the water
    float deeper_m;   // of the water, more than where it closes
    float lost;       // variance of the slopes of water that its normal does not show
    float around;     // SnowCover::melt: what snow lies near
    float slides;     // 1: the slope of the bumps is still to take its share of the film (shed_film)
};

// What lies by the slope of the bumps asks the normal map before the water above it is known. Rain alone does
// not: its film takes that slope afterwards, from the one normal that is read.
bool bumps_come_first() { return SNOW != 0u || FROST != 0u; }

// Share of a film that stays where the normal rises so much.
float stays_on(float up) { return saturate(up + 1.0 - material.water_slope_damp); }

// normal: with the bumps, world.
void shed_film(inout Cover c, vec3 normal) { c.film *= mix(1.0, stays_on(normal.y), c.slides); }

Cover no_cover(SurfaceInput at)
{
    Cover c;
    c.film = 0.0;
    c.water = 0.0;
    c.snow = 0.0;
    c.frost = 0.0;
    c.snow_smoothness = 0.0;
    c.normal = at.normal;
    c.refraction = vec2(0.0);
    c.deeper_m = 0.0;
    c.lost = 0.0;
    c.around = 0.0;
    c.slides = 0.0;
    return c;
}

// mapped: tangent normal of the normal map.
Cover cover_on(SurfaceInput at, TangentFrame f, vec3 mapped)
{
    Cover c = no_cover(at);
    LocalWeather here;
    if ((SNOW & SNOW_GRASS) != 0u) {
        // What falls among blades meets them, however steep they stand.
        SurfaceInput above = at;
        above.normal = vec3(0.0, 1.0, 0.0);
        here = local_weather(above);
    } else if ((SNOW & SNOW_BODY) != 0u) {
        here = local_weather(below_snow(at));
    } else {
        here = local_weather(at);
    }
    const float open = here.open;
    Trodden trodden;
    trodden.pressed = 0.0;
    trodden.slope = vec2(0.0);
    if ((SNOW & SNOW_TRACKS) != 0u) {
        // What is pressed to a third of its depth covers as a third of it does.
        trodden = trodden_at(at);
        here.snow = cover_of_share(here.snow, 1.0 - trodden.pressed);
    }

    const float ledge = SNOW != 0u && (SNOW & SNOW_GRASS) == 0u ? ledge_of(at, to_world(f, mapped).y) : 0.0;
    const float amount_raw = snow_amount_raw(at, here.snow, ledge);
    // Deep snow knows no relief below it.
    const bool bodied = (SNOW & SNOW_BODY) != 0u && at.weather.a <= 0.0;
    const float over_m = SNOW != 0u && !bodied ? stands_over_m(at) : 0.0;
    const SnowBody own_body = snow_body(at, over_m, here.open);
    // What the material's mask keeps free is free under deep snow too.
    float body = own_body.share;
    if ((SNOW & SNOW_BODY) != 0u) body *= unique_mask(at);
    const float amount = max(saturate(amount_raw), body);
    const vec3 smoothed = normalize(
        to_world(f, normalize(mix(mapped, vec3(0.0, 0.0, 1.0), saturate(amount_raw * 0.5)))));
    SnowCover snow;
    snow.snow = 0.0;
    snow.melt = 0.0;
    // A patch knows how steep it is; of the pixel its relief alone counts.
    const float up = here.placed ? min(smoothed.y + 1.0 - saturate(at.normal.y), 1.0) : smoothed.y;
    if (SNOW != 0u && amount > 0.0) snow = snow_on(at, amount, up, over_m, ledge, here.placed);
    if ((SNOW & SNOW_BODY) != 0u) {
        snow.snow = max(snow.snow, body);
        snow.melt = max(snow.melt, own_body.wets);
    }

    StandingWater water;
    water.anywhere = 0.0;
    water.deep = 0.0;
    water.runs = 0.0;
    water.depth_m = 0.0;
    water.below = 0.0;
    water.stands_m = 0.0;
    water.deeper_m = 0.0;
    if (WATER != 0u) water = water_on(at, here);
    if (!is_steep() && max(here.pond_m, water.depth_m) > 0.0) {
        // A pond drowns what stands in it by and by.
        WaterCover pond = pond_cover(here.pond_m, water.stands_m);
        if ((BESIDES & BESIDES_WIDE_GROUND) != 0u) {
            const vec2 dx = at.position_dx.xz;
            const vec2 dy = at.position_dy.xz;
            const float relief_m = wide_relief_m(at.position.xz, sqrt(max(dot(dx, dx), dot(dy, dy))));
            pond = marsh_cover(here.pond_m, water.stands_m + relief_m);
        }
        water.anywhere = max(water.anywhere, max(water.below, pond.anywhere));
        water.deeper_m = max(water.deeper_m, max(water.depth_m, here.pond_m - water.stands_m) - kClosedWater_m);
        water.deep = max(water.deep, max(smooth_edge(0.0005, 0.006, water.depth_m), pond.deep));
    }
    const float soaked = water.anywhere;
    if ((SNOW & SNOW_BODY) != 0u) {
        water.anywhere *= 1.0 - body;
        water.deep *= 1.0 - body;
        here.film *= 1.0 - body;
    }
    // A patch knows which way it faces; the frame's film asks the slope.
    c.film = here.film * (material.film >= 0.0 ? material.film : 1.0);
    const float stays = here.placed ? 1.0 : stays_on(smoothed.y);
    water.runs *= c.film * stays;
    if (bumps_come_first()) {
        c.film *= stays;
    } else {
        c.slides = here.placed ? 0.0 : 1.0;
    }
    if (FROST != 0u) {
        const float facing = here.placed ? 1.0 : saturate(at.normal.y * 0.6 + 0.5);
        c.frost = frost_on(at, mapped, here.frost * facing) * (1.0 - water.anywhere);
    }

    const float left_m = frame.look.detail_distance_m - length(at.position - frame.camera_m);
    const float near = saturate(left_m / max(frame.look.detail_fade_m, 1.0e-3));
    const float fade = near * near;
    Rings ripple = Rings(vec3(0.0, 0.0, 1.0), 0.0);
    Wave flow;
    flow.lean = vec3(0.0);
    flow.up = 1.0;
    if ((WATER & WATER_RIPPLES) != 0u && !is_steep()) {
        const bool rings = frame.weather.rain * open > 0.0 && water.deep > 0.0;
        const Rings all = rings_on(at, water, open, fade, rings);
        if (rings) ripple = all;
    }
    if ((WATER & WATER_FLOWS) != 0u && max(water.anywhere, water.runs) > 0.0 && fade > 0.001) {
        const WaveAsked asked = waves_asked(at, water, here.still);
#ifdef LOOKS_LATER
        if (waves_later()) {
            waves_left.asked = asked.strength > 0.0;
            waves_left.waves = asked;
            waves_left.fade = fade;
        }
#endif
        if (!waves_later()) flow = flow_wave(asked);
    }
    const vec3 rings = vec3(ripple.normal.x, 0.0, ripple.normal.y);
    const vec4 bent = normalize(vec4(rings + flow.lean, ripple.normal.z * flow.up));
    const vec3 shift = rings * (frame.look.ripple_refraction * material.ripple_refraction) +
                       flow.lean * material.flow_refraction;
    if (!is_steep()) {
        c.refraction = vec2(dot(shift, f.tangent), dot(shift, f.bitangent)) * water.deep *
                       (1.0 - saturate(2.0 * snow.snow)) *
                       saturate(1.0 - here.frozen + water_accumulation(at).z) *
                       fade;
    }
    // Water that stands is level, whatever the ground below; what runs follows it.
    vec3 still = at.normal;
    if (!is_steep()) {
        still = normalize(mix(at.normal, vec3(0.0, 1.0, 0.0), level_share(at.normal.y, water.anywhere)));
    }
    c.normal = bent_normal(bent, still, fade);

    c.water = water.anywhere;
    c.deeper_m = water.deeper_m;
    c.lost = ripple.lost;
    c.snow = snow.snow;
    c.around = snow.melt;
    if (SNOW != 0u) {
        c.water = melt_wetness(water.anywhere, snow.melt, frame.weather.melt_exp);
        const float snow_share = snow.snow / max(snow.snow + c.water, 1.0e-4);
        SnowRelief relief = snow_relief(at, f, amount, smoothed, fade);
        if (has(TEXTURE_SNOW_MASK_NORMAL)) tread(relief, at, f, here.frozen);
        if ((SNOW & SNOW_TRACKS) != 0u) {
            const vec3 lean = vec3(trodden.slope.x, 0.0, trodden.slope.y);
            relief.normal = normalize(relief.normal - lean * amount);
            c.snow *= 1.0 - 0.12 * trodden.pressed;  // dense snow is darker
        }
        if ((SNOW & SNOW_BODY) != 0u) {
            if (frame.weather.melt_exp > 0.0) {
                const float thaws = at.weather.a < 0.999 ? 1.0 : 0.0;
                const vec3 wide = max(abs(at.position_dx), abs(at.position_dy));
                const vec2 slope = thaw_slope(own_body.slope, max(wide.x, wide.z), frame.weather.melt_exp) * thaws;
                relief.normal = normalize(relief.normal - vec3(slope.x, 0.0, slope.y));
                c.snow *= 1.0 - thaws * slush_share(snow_deep_m(at), soaked, own_body.ragged, at.position.xz, frame.weather.melt_exp);
            }
        }
        c.snow_smoothness = relief.smoothness;
        c.normal = normalize(mix(c.normal, relief.normal, saturate(snow_share)));
    }
    return c;
}

#endif
