// Snow on a surface point: where it lies, and its relief.
#ifndef PETRICHOR_SURFACE_SNOW_GLSL
#define PETRICHOR_SURFACE_SNOW_GLSL

#include "formulas/weather/falls_here.h"
#include "formulas/weather/ground_relief.h"
#include "formulas/weather/land_relief.h"
#include "formulas/weather/snow_in_turf.h"
#include "formulas/weather/surface_weather.h"
#include "gpu/passes/surface/sets.glsl"
#include "gpu/passes/surface/textures.glsl"

const float SNOW_MEAN_RELIEF = 0.7;   // of stones and their joints, in height maps
const float SNOW_SETTLES_M = 0.008;  // what lies so much lower is a joint

const float kTurfSlopeUp = 0.94;     // land less level than this holds snow by its relief

// Y of the normal of the triangle itself: smoothed normals at the upper edge of a wall look half up.
float face_up(SurfaceInput at)
{
    const vec3 across = cross(at.position_dx, at.position_dy);
    const float size = dot(across, across);
    return size > 0.0 ? abs(across.y) * inversesqrt(size) : 1.0;
}

// How far a point is a ledge of the relief of something steep, 0..1. facet_up: y of the normal of the normal map.
float ledge_of(SurfaceInput at, float facet_up)
{
    return smooth_edge(0.45, 0.75, facet_up) * smooth_edge(0.1, 0.3, facet_up - at.normal.y);
}

// Before it is saturated: the amount that falls here, and what the material always has.
float snow_amount_raw(SurfaceInput at, float lies, float ledge)
{
    // What falls does not cling to walls, whatever the slope damp of the material; on their ledges it lies.
    float clinging = 1.0;
    if ((SNOW & SNOW_GRASS) == 0u) {
        // Of land its relief says so (snow_caught).
        if ((BESIDES & BESIDES_WIDE_GROUND) == 0u) clinging = smooth_edge(0.0, 0.4, at.normal.y);
        const bool body = (SNOW & SNOW_BODY) != 0u && at.weather.a < 0.999;
        if (!body && at.normal.y < 0.9) clinging *= smooth_edge(0.02, 0.12, face_up(at));
        clinging = max(clinging, ledge);
    }
    return lies * clinging * material.snow_accumulation.y +
           material.snow_accumulation.x;
}

// Numbers of the maps of the snow, in the order of their tilings.
const int kSnowRelief = 0;
const int kSnowDetail = 1;
const int kSnowMask = 2;
const int kSnowMaskDetail = 3;

vec4 snow_map_at(SurfaceInput at, int number)
{
    if ((SNOW & SNOW_LOCAL) != 0u) {
        const float tiling = material.snow_local_tiling[number];
        return textureGrad(snow_map, at.uv.xy * tiling, at.uv_dx.xy * tiling, at.uv_dy.xy * tiling);
    }
    return texel_from_above(snow_map, at, frame.look.snow_tiling[number], vec2(0.0));
}

// How far the masks are read from the side: from above they would be streaks on what is steep.
float mask_beside(SurfaceInput at) { return 1.0 - smooth_edge(0.5, 0.7, at.normal.y); }

float snow_mask_at(SurfaceInput at, int number)
{
    if ((SNOW & SNOW_LOCAL) != 0u) return snow_map_at(at, number).b;
    const float tiling = frame.look.snow_tiling[number];
    const float beside = mask_beside(at);
    float mask = 0.0;
    if (beside < 1.0) mask += (1.0 - beside) * texel(snow_map, scaled(metres_above(at), tiling)).b;
    if (beside > 0.0) mask += beside * texel(snow_map, scaled(metres_beside(at), tiling)).b;
    return mask;
}

// Where snow lies first. Of wide ground by two readings of the map, whatever map that is: its coarsest level is its mean.
float snow_mask(SurfaceInput at)
{
    const float first = snow_mask_at(at, kSnowMask);
    if ((BESIDES & BESIDES_WIDE_GROUND) == 0u || (SNOW & SNOW_LOCAL) != 0u) return first;
    const float tiling = frame.look.snow_tiling[kSnowMask];
    const Uv along = scaled(metres_along(at), tiling);
    const Uv other = Uv(place_across(along.at), place_across(along.dx), place_across(along.dy));
    return mask_of_two(first, texel(snow_map, other).b, textureLod(snow_map, along.at, 16.0).b);
}

// The material's own mask: 1 snow may lie .. 0 never.
float unique_mask(SurfaceInput at)
{
    float unique = at.weather.b;
    if (has(TEXTURE_SNOW_MASK)) {
        unique *= number_at(snow_mask_texture, TEXTURE_SNOW_MASK, at);
    }
    return unique;
}

float snow_masks_blurred(SurfaceInput at)
{
    const bool local = (SNOW & SNOW_LOCAL) != 0u;
    const vec4 tiling = local ? material.snow_local_tiling : frame.look.snow_tiling;
    const vec2 dx = local ? at.uv_dx.xy : at.position_dx.xz;
    const vec2 dy = local ? at.uv_dy.xy : at.position_dy.xz;
    return snow_mask_blurred(sqrt(max(dot(dx, dx), dot(dy, dy))), vec2(tiling[kSnowMask], tiling[kSnowMaskDetail]));
}

// How high the relief stands here over its mean, metres; 0 on what has none.
float stands_over_m(SurfaceInput at)
{
    if (!has_relief()) return 0.0;
    const float unit_m = material.height_scale_m > 0.0 ? material.height_scale_m : kGroundReliefUnit_m;
    return (relief_height(at) - SNOW_MEAN_RELIEF) * unit_m;
}

// smoothed_up: y of the pixel normal, smoothed by the snow's amount. over_m: as stands_over_m(). ledge: as
// ledge_of(). placed: a patch has told how much its slope holds.
SnowCover snow_on(SurfaceInput at, float amount, float smoothed_up, float over_m, float ledge, bool placed)
{
    // What falls first comes to rest between the stones.
    const float between = clamp(-over_m / SNOW_SETTLES_M, -1.0, 1.0);
    const float mask = saturate(snow_mask(at) * (1.0 + 0.45 * between * (1.0 - amount)));
    const float melt = frame.weather.melt * material.snow_accumulation.y;
    const float height = snow_line_factor(at.position, frame.weather.snow_start_height_m,
                                          frame.weather.snow_height_blend_m, frame.look.snow_line_ragged);
    if ((SNOW & SNOW_GRASS) != 0u) {
        SnowCover blade;
        blade.snow = snow_on_grass(amount, height, mask, at.color.r) * unique_mask(at);
        blade.melt = blade.snow;
        return blade;
    }
    const float detail = snow_mask_at(at, kSnowMaskDetail);
    const float blurred = snow_masks_blurred(at);
    if ((SNOW & SNOW_VERTEX) != 0u) {
        return snow_cover_of_vertices(amount, at.normal.y, material.snow_slope_damp, mask, detail, melt,
                                      blurred);
    }
    float holds = snow_rests(at.normal.y) + max(between, 0.0);
    // What lies on a ledge does not ask how steep the wall is.
    holds += ledge * max(1.0 - smoothed_up - holds, 0.0);
    const float unique = unique_mask(at);
    const bool slope_of_land = (BESIDES & BESIDES_WIDE_GROUND) != 0u && at.normal.y < kTurfSlopeUp;
    SlopeRelief relief;
    relief.flatter = 0.0;
    relief.lost = 0.0;
    if (slope_of_land) {
        const vec3 dx = at.position_dx, dy = at.position_dy;
        const float width_m = sqrt(max(dot(dx, dx), dot(dy, dy)));
        relief = with_gullies(slope_relief(at.position, width_m), at.position, width_m,
                              frame.look.ground_variation * land_relief_share(at.normal.y));
        relief.flatter *= 1.0 - smooth_edge(0.75, kTurfSlopeUp, at.normal.y);
        const bool capped = (SNOW & SNOW_BODY) != 0u && at.weather.a < 0.999;
        if (placed && !capped) {
            amount = cover_of_share(amount, snow_of_bend(at.normal.y, face_up(at)) * snow_of_relief(relief.flatter, amount));
        }
        // Level ground holds all of it; it counts from where snow would slide.
        holds += (1.0 - smooth_edge(0.7, 0.85, at.normal.y)) * snow_holds(relief);
    }
    SnowCover cover = snow_cover(amount, height, smoothed_up + holds, material.snow_slope_damp, unique, mask, detail,
                                 melt, blurred);
    if (slope_of_land) {
        const float caught = snow_caught(at.normal.y, relief);
        const SnowCover level = snow_cover(amount, height, 1.0, 0.0, unique, mask, detail, melt, blurred);
        cover.snow = max(cover.snow, caught * level.snow);
        cover.melt = max(cover.melt, caught * level.melt);
    }
    if ((BESIDES & BESIDES_WIDE_GROUND) != 0u) {
        cover = with_snow_in_turf(cover, snow_in_turf(amount * (placed ? 1.0 : turf_holds(at.normal.y)), mask, relief.flatter) * height * unique);
    }
    return cover;
}

struct SnowRelief {
    vec3 normal;       // world
    float smoothness;
};

// Slopes of its relief, along x and z. Of wide ground half of their variance is that of a second reading, turned as
// place_across: of one alone a field of snow showed the lattice of its map.
vec3 coarse_snow(SurfaceInput at, vec2 first)
{
    const float strength = material.snow_normal_strength * frame.look.snow_strength.x;
    vec3 coarse = unpack_normal(first, strength);
    if ((BESIDES & BESIDES_WIDE_GROUND) == 0u || (SNOW & SNOW_LOCAL) != 0u) return coarse;
    const float tiling = frame.look.snow_tiling[kSnowRelief];
    const vec2 there = textureGrad(snow_map, place_across(at.position.xz * tiling), place_across(at.position_dx.xz * tiling),
                                   place_across(at.position_dy.xz * tiling)).xy;
    const vec3 other = unpack_normal(there, strength);
    const vec2 turned = vec2(0.76604444 * other.x + 0.64278761 * other.y, 0.76604444 * other.y - 0.64278761 * other.x);
    return normalize(vec3(0.70710678 * (coarse.xy + turned), 0.5 * (coarse.z + other.z)));
}

// A snow cover has its own, softer relief over that of the ground. smoothed: world.
SnowRelief snow_relief(SurfaceInput at, TangentFrame f, float amount, vec3 smoothed, float fade)
{
    const vec4 snow = snow_map_at(at, kSnowRelief);
    const vec2 detail_xy = snow_map_at(at, kSnowDetail).xy;
    const vec3 coarse = coarse_snow(at, snow.xy);
    const vec3 detail = unpack_normal(
        detail_xy, material.snow_detail_strength * frame.look.snow_strength.y * fade);
    SnowRelief relief;
    const vec2 slope = vec2(coarse.x + detail.x, coarse.y + detail.y);
    const vec3 lean = (SNOW & SNOW_LOCAL) != 0u ? f.tangent * slope.x + f.bitangent * slope.y
                                                : vec3(slope.x, 0.0, slope.y);
    relief.normal = normalize(lean +
                              mix(smoothed, at.normal, 0.3 + 0.7 * amount) * (coarse.z * detail.z));
    relief.smoothness = snow.a;
    return relief;
}

// Footprints and tyre tracks: what the material's mask takes away has a normal of its own. It is lost
// as the snow melts.
void tread(inout SnowRelief relief, SurfaceInput at, TangentFrame f, float frozen)
{
    const vec3 n = unpack_normal(
        texel(snow_mask_normal_texture, coordinates(TEXTURE_SNOW_MASK_NORMAL, at, vec2(0.0))).xy,
        material.snow_mask_normal_scale);
    const float trodden =
        (1.0 - unique_mask(at)) * saturate(frozen + material.snow_accumulation.x);
    relief.normal = normalize(mix(relief.normal, to_world(f, n), trodden));
}

#endif
