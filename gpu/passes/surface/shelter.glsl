// How much of what falls from the sky reaches a point.
#ifndef PETRICHOR_SURFACE_SHELTER_GLSL
#define PETRICHOR_SURFACE_SHELTER_GLSL

#include "formulas/weather/falls_here.h"
#include "formulas/noise/noise.h"
#include "gpu/passes/surface/textures.glsl"

struct Exposure {
    float rain;  // share of that on open flat ground
    float snow;
    float sky;  // as the snow, the less the more it looks away
};

// Splashes and eddies carry what falls a bit to the side: the edge of a shelter wanders and is soft.
// Along the surface, so that it does not shelter itself.
vec3 stray(SurfaceInput at)
{
    const float turn = 6.2831853 * dither(at.pixel, frame.sample_index + 3u);
    const float tiling = 0.7;
    const int level = quad_level(frame.snow_size, at.position_dx.xz * tiling, at.position_dy.xz * tiling);
    const vec2 wander = quad_texel(snow_quads, frame.snow_size, at.position.xz * tiling, level) - 0.5;
    const vec2 way = (5.0 * wander + 0.7 * vec2(cos(turn), sin(turn))) * frame.shelter_spread_m;
    const vec3 flat_way = vec3(way.x, 0.0, way.y);
    return flat_way - at.normal * dot(at.normal, flat_way);
}

// Share of four texels around a point that what falls passes; at: u, v, depth, inside the map. By hand: a CPU
// reads texels of a buffer several times as fast as it asks an image.
float open_above(vec3 at, int direction)
{
    const vec2 p = at.xy * float(SKY_MAP_SIZE) - 0.5;
    const vec2 low = floor(p);
    const vec2 share = p - low;
    const ivec2 a = max(ivec2(low), ivec2(0));
    const ivec2 b = min(ivec2(low) + 1, ivec2(SKY_MAP_SIZE - 1));
    const int above = (direction * SKY_MAP_SIZE + a.y) * SKY_MAP_SIZE;
    const int below = (direction * SKY_MAP_SIZE + b.y) * SKY_MAP_SIZE;
    const vec4 depth = vec4(texelFetch(shelter_rows, above + a.x).r, texelFetch(shelter_rows, above + b.x).r,
                            texelFetch(shelter_rows, below + a.x).r, texelFetch(shelter_rows, below + b.x).r);
    const vec4 seen = vec4(greaterThanEqual(vec4(at.z), depth));
    const vec2 rows = seen.xz + (seen.yw - seen.xz) * share.x;
    return rows.x + (rows.y - rows.x) * share.y;
}

// Adds what falls along one direction.
void fall_on(inout Exposure open, SurfaceInput at, vec3 strayed, int k)
{
    const FallConstants fall = frame.falls[k];
    const vec3 lifted = strayed + at.normal * (fall.from.w * 1.2) + fall.from.xyz * (fall.from.w * 0.8);
    const vec4 map = fall.map_from_world * vec4(lifted, 1.0);
    const bool inside = all(lessThanEqual(abs(map.xyz - 0.5), vec3(0.5)));
    const float seen = inside ? open_above(clamp(map.xyz, vec3(0.0), vec3(1.0)), fall.layer) : 1.0;
    const float facing = facing_share(at.normal, fall.from.xyz);
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
    const vec3 strayed = at.position + stray(at);
    if (PLACE != 0u) {
        // Most ask their patch: a loop ends where none of a group does not.
        for (int k = 0; k < (asked ? FALLS : 0); ++k) fall_on(open, at, strayed, k);
        return open;
    }
#define FALL(k) if (FALLS > k) fall_on(open, at, strayed, k);
    FALL(0) FALL(1) FALL(2) FALL(3) FALL(4) FALL(5) FALL(6) FALL(7)
    FALL(8) FALL(9) FALL(10) FALL(11) FALL(12) FALL(13) FALL(14) FALL(15)
#undef FALL
    return open;
}

#endif
