// Standing water on a surface point: where it stands, and how rain and flow bend it.
#ifndef PETRICHOR_SURFACE_WATER_GLSL
#define PETRICHOR_SURFACE_WATER_GLSL

#include "formulas/weather/deep_water.h"
#include "formulas/weather/ground_relief.h"
#include "formulas/weather/ripple.h"
#include "formulas/weather/surface_weather.h"
#include "gpu/passes/surface/sets.glsl"

struct StandingWater {
    float anywhere;  // as WaterCover
    float deep;
    float runs;  // 0..1: what falls on a slope and leaves it
    float depth_m;  // in the relief below a patch
    float below;    // share of the relief below that water
    float deeper_m;  // than where it closes over the ground
    float stands_m;  // how high the relief stands in the shallows of a hollow
};

// Only what falls reaches it (WATER_STEEP): no puddles, no rings, nothing to look through.
bool is_steep() { return (WATER & WATER_STEEP) != 0u; }

// By the level of the weather here, in cracks and puddles, the material's influence on it, and its constant;
// or by the level of the water that a patch holds.
// A material that brings a height map says where water goes, and its hollows hold some on slopes of up
// to 30 degrees. Others have a relief of the world's own that holds it where they are level.
StandingWater water_on(SurfaceInput at, LocalWeather here)
{
    const bool mapped = has_relief();
    const vec4 holds = water_accumulation(at);
    const vec2 weather = here.volume ? vec2(0.0, here.flood.y) : here.flood * holds.yw;
    const float levelness =
        mapped ? smooth_edge(0.55, 0.9, at.normal.y) : level_ground(at.normal.y);
    const vec2 flood = (here.volume ? vec2(0.0) : weather * levelness) + holds.xz;
    StandingWater water;
    water.anywhere = 0.0;
    water.deep = 0.0;
    water.runs = saturate(weather.y) * (1.0 - levelness);
    water.depth_m = 0.0;
    water.below = 0.0;
    water.stands_m = 0.0;
    water.deeper_m = 0.0;
    if (is_steep()) return water;
    float height = material.default_height;
    float blurred = 0.0;
    if (mapped) {
        height = SNOW != 0u || FROST != 0u ? relief_height(at) : relief_height_of_level(at);
    } else {
        const vec2 dx = at.position_dx.xz;
        const vec2 dy = at.position_dy.xz;
        const float width_m = material.hollow_tiling * sqrt(max(dot(dx, dx), dot(dy, dy)));
        height += kGroundRelief * ground_relief_seen(at.position.xz * material.hollow_tiling, width_m, material.hollow_tiling);
        blurred = kGroundRelief * ground_relief_blurred(width_m);
    }
    float puddle_mask = at.weather.g;
    if (has(TEXTURE_PUDDLE_MASK)) {
        puddle_mask *= number_at(puddle_mask_texture, TEXTURE_PUDDLE_MASK, at);
    }
    const WaterCover cover =
        water_cover_of_mean(flood, height, puddle_mask, at.normal.y, material.water_slope_damp, blurred);
    // A wide pixel knows no hollows where nothing stands in them.
    const float any = max(flood.x, flood.y) > 0.0 ? 1.0 : 0.0;
    water.anywhere = cover.anywhere * any;
    water.deep = cover.deep * any;
    const float unit_m = mapped && material.height_scale_m > 0.0 ? material.height_scale_m : kGroundReliefUnit_m;
    // Half of it: the mesh is the mean of its ground.
    water.stands_m = 0.5 * unit_m * (mapped ? height : height - material.default_height);
    // What a material holds in any weather is a setting and no depth.
    const float over = weather.y * levelness * saturate(at.normal.y + 1.0 - material.water_slope_damp) - (1.0 - puddle_mask) - height;
    water.deeper_m = any * max(over - puddle_closes(blurred), 0.0) * unit_m;
    if (PLACE != 0u && here.volume) {
        // The places of a pixel stand within `wider_m` of their mean. Its edge is as wide as a drop is high.
        const float over_m = (here.level - height) * unit_m * levelness;
        const float wider_m = 1.5 * blurred * unit_m * levelness;
        const float rises_m = max(over_m + wider_m, 0.0);
        water.depth_m = over_m >= wider_m ? over_m : rises_m * rises_m / max(4.0 * wider_m, 1.0e-9);
        water.below = smooth_edge(-wider_m, 0.002 + wider_m, over_m);
    }
    return water;
}

// Rings of drops. Normals of the water are laid out in world x and z.
struct Rings {
    vec3 normal;
    float lost;  // variance of their slopes that the normal does not show
};

// A CPU reads for all pixels of a group: those without standing water, `asks`, read one place.
Rings rings_on(SurfaceInput at, StandingWater water, float open, float fade, bool asks)
{
    const float tiling = asks ? frame.look.ripple_tiling : 0.0;
    // Of whole levels a CPU reads one: by the shorter side of the pixel, which is all that is left of rings a few metres
    // away. Along the longer one samples fall on different sides of them, as glints do.
    const vec2 dx = at.position_dx.xz * tiling;
    const vec2 dy = at.position_dy.xz * tiling;
    const vec2 shorter = dot(dx, dx) < dot(dy, dy) ? dx : dy;
    const int level = quad_level(frame.ripple_bits, shorter, shorter);
    const vec2 place = at.position.xz * tiling;
    const vec2 ring = textureLod(ripple_map, place, float(level)).xy;
    // Roughness is of the longer side, of which each sample has its part: by the shorter one it would glitter.
    const int parts = ((floatBitsToInt(frame.samples) >> 23) - 127) >> 1;
    const int wide = max(quad_level(frame.ripple_bits, dx, dy) - parts, level);
    const int side = 1 << (frame.ripple_bits - wide);
    const vec2 square = texelFetch(ripple_map, ivec2(fract(place) * float(side)) & (side - 1), wide).zw;
    const float share = water.deep * saturate(at.normal.y) * saturate(open * 2.0);
    Rings rings;
    rings.normal = mix(vec3(0.0, 0.0, 1.0), unpack_normal(ring, frame.look.ripple_strength), share);
    const float scale = frame.look.ripple_strength * share;
    rings.lost = rings_unseen(scale * scale * rings_square_of(square), rings.normal.xy, fade);
    return rings;
}

// What bends a water surface: its normal is lean + up * normal of the geometry.
struct Wave {
    vec3 lean;  // world, along the surface
    float up;
};

// What 2^(-10 x) leaves of the speed where all is frozen: nothing of it runs on.
const float kStill = 1.0 / 1024.0;

// Both phases of the flow map in one plane of the world; v: repeats that a phase runs. Of its levels the nearest
// one is read: waves move on before their next level shows, and half as many texels are read.
vec3 flow_texel(vec2 p, vec2 p_dx, vec2 p_dy, vec2 v, FlowPhases phases)
{
    const float t = material.flow_tiling;
    const int level = quad_level(frame.flow_bits, p_dx * t, p_dy * t);
    const vec2 first = quad_texel(flow_quads, frame.flow_bits, p * t + phases.first * v, level);
    const vec2 second = quad_texel(flow_quads, frame.flow_bits, p * t + phases.second * v, level);
    return unpack_normal(mix(first, second, phases.blend), material.flow_normal_strength);
}

// Where waves are asked, and how much there is of them.
struct WaveAsked {
    vec3 position;
    vec3 position_dx;
    vec3 position_dy;
    vec3 normal;
    float moves;     // 0: frozen
    float strength;  // 0: none
};

WaveAsked waves_asked(SurfaceInput at, StandingWater water, float still)
{
    WaveAsked w;
    w.position = at.position;
    w.position_dx = at.position_dx;
    w.position_dy = at.position_dy;
    w.normal = at.normal;
    w.moves = saturate((1.0 - still - kStill) / (1.0 - kStill) + water_accumulation(at).z);
    const float up = saturate(at.normal.y);
    const float slope = 1.0 - up * up;
    // On flat ground only the wind moves the water, a little.
    const float breeze = 0.05 + 0.03 * min(length(frame.weather.wind_m_s), 6.0);
    // Ice has no waves: those of the map go on.
    w.strength = max(slope, breeze * up) * max(water.anywhere, water.runs) * w.moves;
    return w;
}

// Waves of water that runs down, and of wind on flat ground. The map is laid along the surface: from
// above on flat ground, from the sides on walls, blended between.
Wave flow_wave(WaveAsked at)
{
    const vec3 n = at.normal;
    // Along the surface, the longer the steeper; the map is moved up, so that waves run down.
    const vec3 v = (vec3(0.0, 1.0, 0.0) - n * n.y) * material.flow_speed * at.moves;
    const FlowPhases phases = flow_phases(frame.time_s, material.flow_interval_s);
    const vec3 sides = max(n * n * n * n - 0.01, vec3(0.0));
    const vec3 share = sides / (sides.x + sides.y + sides.z);
    const vec3 p = at.position;
    const vec3 dx = at.position_dx;
    const vec3 dy = at.position_dy;
    Wave wave;
    wave.lean = vec3(0.0);
    wave.up = 0.0;
    // The planes that count, the largest share first. A loop, since a CPU walks all branches of a group of pixels
    // but ends a loop with the last of them: most have one plane.
    vec3 left = share;
    do {
        const bool from_above = left.y >= left.x && left.y >= left.z;
        const bool from_x = !from_above && left.x >= left.z;
        vec2 q = from_x ? p.zy : p.xy;
        vec2 q_dx = from_x ? dx.zy : dx.xy;
        vec2 q_dy = from_x ? dy.zy : dy.xy;
        vec2 q_v = from_x ? v.zy : v.xy;
        if (from_above) {
            q = p.xz;
            q_dx = dx.xz;
            q_dy = dy.xz;
            q_v = v.xz;
        }
        const vec3 m = flow_texel(q, q_dx, q_dy, q_v, phases);
        const float part = max(left.x, max(left.y, left.z));
        vec3 lean = from_x ? vec3(0.0, m.y, m.x) : vec3(m.x, m.y, 0.0);
        if (from_above) lean = vec3(m.x, 0.0, m.y);
        wave.lean += part * lean;
        wave.up += part * m.z;
        if (from_above) {
            left.y = 0.0;
        } else if (from_x) {
            left.x = 0.0;
        } else {
            left.z = 0.0;
        }
    } while (left.x + left.y + left.z > 0.0);
    wave.lean = (wave.lean - n * dot(n, wave.lean)) * at.strength;
    wave.up = mix(1.0, wave.up, at.strength);
    return wave;
}

// Of water that rings and waves bend; still: its normal without them. fade: how far they are drawn.
vec3 bent_normal(vec4 bent, vec3 still, float fade)
{
    return normalize(bent.xyz * fade + still * max(mix(1.0, bent.w, fade), 0.05));
}

#ifdef LOOKS_LATER
// Half of the walls in rain have waves, and a CPU takes for all what one of a group asks. So of what is steep they are left to the
// end, where a loop skips them for groups without any: they change its normal alone.
bool waves_later() { return later() && is_steep() && SNOW == 0u && FROST == 0u && (BESIDES & BESIDES_WIDE_GROUND) == 0u; }
struct WavesLater {
    bool asked;  // by the point that was shaded last
    WaveAsked waves;
    float fade;
    ivec2 pixel;
    vec2 base;  // code of the normal below
};
WavesLater waves_left;
#else
bool waves_later() { return false; }
#endif

#endif
