// Where water and snow lie on a surface point. What they do to its material: apply_weather.h.
//
// One text for C++ and GLSL. Symbols: Lux 2.02 (docs/lux.md, 8 and 9), whose quirks are kept where
// results would differ; divisions by zero are not. All values are dimensionless unless the name
// says otherwise.
#ifndef PETRICHOR_FORMULAS_WEATHER_SURFACE_WEATHER_H
#define PETRICHOR_FORMULAS_WEATHER_SURFACE_WEATHER_H

#include "base/interop.h"
#include "formulas/noise/noise.h"

SHARED_BEGIN

#ifndef SHARED_HAS_SATURATE
SHARED_FN float saturate(float x)
{
    return clamp(x, 0.0f, 1.0f);
}
#endif

// smoothstep that is defined for equal edges: a step at `high`.
SHARED_FN float smooth_edge(float low, float high, float x)
{
    const float u = saturate((x - low) / max(high - low, 1.0e-6f));
    return u * u * (3.0f - 2.0f * u);
}

// ---- water -------------------------------------------------------------------------------------

struct WaterCover {
    float anywhere;  // ax: standing water, 0..1
    float deep;      // ay: stronger where it stands deep; drives ripples and refraction
};

// How far its level stands over the relief, in heights of it, where a puddle is whole.
SHARED_FN float puddle_closes(float blurred) { return 0.4f + 1.5f * blurred; }

// flood          (cracks, puddles) level: published level * influence + constant; may exceed 1
// height         0 low .. 1 high, of the surface relief
// puddle_mask    1 puddles may stand, 0 never
// normal_up      y of the geometric normal
// slope_damp     0 water stays on any slope .. 1 the less the steeper, none on walls
// blurred        standard deviation that the height has lost to minification: a wide pixel has as much water as
//                its places, whose hollows stand full while their mean is dry
SHARED_FN WaterCover water_cover_of_mean(vec2 flood, float height, float puddle_mask, float normal_up,
                                         float slope_damp, float blurred)
{
    const float slope = saturate(normal_up + 1.0f - slope_damp);
    const float cracks = flood.x - height;
    const float wider = 1.5f * blurred;
    const float filled = saturate((flood.y * slope - (1.0f - puddle_mask) - height + wider) / (0.4f + 2.0f * wider));
    const float puddles = mix(filled, filled * filled * (3.0f - 2.0f * filled), min(5.0f * wider, 1.0f));
    const float x = slope * max(cracks, puddles);
    const float y = slope * max(cracks, 2.0f * puddles) * 0.5f;
    WaterCover cover;
    cover.anywhere = saturate(x);
    cover.deep = saturate(y * y);
    return cover;
}

SHARED_FN WaterCover water_cover(vec2 flood, float height, float puddle_mask, float normal_up,
                                 float slope_damp)
{
    return water_cover_of_mean(flood, height, puddle_mask, normal_up, slope_damp, 0.0f);
}

// Water of a hollow of the ground, depth_m at a point of the mesh: the relief that the mesh does not have stands up
// from it by stands_m. So the shore is as ragged as the ground, and damp where water is thin.
SHARED_FN WaterCover pond_cover(float depth_m, float stands_m)
{
    const float over_m = depth_m > 0.0f ? depth_m - stands_m : 0.0f;
    WaterCover cover;
    cover.anywhere = smooth_edge(0.0f, 0.005f, over_m);
    cover.deep = smooth_edge(0.001f, 0.009f, over_m);
    return cover;
}

// The same on wide ground, where blades and clods stand through the first hand's breadth of it: no edge, but a marsh.
SHARED_FN WaterCover marsh_cover(float depth_m, float stands_m)
{
    const float over_m = depth_m > 0.0f ? depth_m - stands_m : 0.0f;
    WaterCover cover;
    cover.anywhere = smooth_edge(0.0f, 0.09f, over_m);
    cover.deep = smooth_edge(0.02f, 0.12f, over_m);
    return cover;
}

// Ground so level that water stays on it: up to 1.5 degrees, none from 6 degrees on.
SHARED_FN float level_ground(float normal_up)
{
    return smooth_edge(0.994522f, 0.999657f, normal_up);
}

// How far the surface of standing water is level rather than that of the ground: a film follows it, as
// does what clings to steep ground.
SHARED_FN float level_share(float normal_up, float water)
{
    return smooth_edge(0.04f, 0.3f, water) * smooth_edge(0.6f, 0.85f, normal_up);
}

// ---- snow --------------------------------------------------------------------------------------

struct SnowCover {
    float snow;  // sx: cover, 0..1
    float melt;  // sy: a wider mask, where melting snow wets the ground
};

// amount          S0 = saturate(published amount * influence + constant)
// slope           S1: what of it lies on this slope
// height_factor   Z: 0 below the snow line .. 1 above the blend range, square-rooted
// normal_up       y of the smoothed pixel normal
// unique_mask     1 snow may lie, 0 never (footprints, wind-swept places)
// mask, detail    the two-frequency mask, each 0..1
// melt_influence  published melt * snow influence
// blurred         standard deviation that mask * detail has lost to minification: the cover of a wide pixel is
//                 the mean of that of its places, which have steep edges where their mean may have none
SHARED_FN SnowCover snow_cover_of_slope(float slope, float height_factor, float unique_mask, float mask,
                                        float detail, float melt_influence, float blurred)
{
    const float base = slope * height_factor;
    const float sharpened = saturate(4.0f * slope * unique_mask * (2.0f - base));
    const float noise = mask * detail;
    const float wider = 1.5f * blurred;
    const float inside = smooth_edge(1.0f - base - base * (1.0f - base) - wider, 1.0f - base + 0.01f + wider, noise);
    const float wider_around = wider * (1.0f + melt_influence);
    const float around = smooth_edge(1.0f - base - base * (4.0f - base) - wider_around,
                                     1.0f - base + 0.1f + wider_around, noise * (1.0f + melt_influence));
    const float depth = sharpened * mix(detail, 1.0f, base);
    SnowCover cover;
    cover.snow = inside * depth;
    cover.melt = around * depth;
    return cover;
}

SHARED_FN SnowCover snow_cover(float amount, float height_factor, float normal_up, float slope_damp,
                               float unique_mask, float mask, float detail, float melt_influence, float blurred)
{
    return snow_cover_of_slope(
        saturate(amount - slope_damp * saturate(1.0f - normal_up - amount * 0.25f)), height_factor,
        unique_mask, mask, detail, melt_influence, blurred);
}

// What snow_cover adds to normal_up: what lies on a slope of up to 40 degrees lies as on level ground, for that is
// less than the angle of repose. normal_up: of the geometry, since the bumps on it tell where thin snow lies.
SHARED_FN float snow_rests(float normal_up)
{
    const float up = max(normal_up, 0.0f);
    return min(up / 0.76604444f, 1.0f) - up;
}

// A map of a few metres repeats, and over wide ground the eye finds the lattice at once. So wide ground reads it at two
// places, of which this is the second: turned, and 1.8 times as wide, so that no dozen of steps of the one is near steps of the other.
SHARED_FN vec2 place_across(vec2 p)
{
    return vec2(0.428985f * p.x - 0.359961f * p.y, 0.359961f * p.x + 0.428985f * p.y);
}

// What the two say together, with the mean and the deviation of one.
SHARED_FN float mask_of_two(float first, float second, float mean)
{
    return saturate(mean + 0.70710678f * (first - mean + second - mean));
}

// How far the slopes of wide ground lie off those of its mesh: tufts, clods, steps and terraces that no mesh has.
struct SlopeRelief {
    float flatter;  // in deviations of the whole relief; its mean is 0
    float lost;     // share of the variance that the pixel has lost
};

// In space, so that nothing is drawn out down a slope, and flat, as steps along the contour lines are. Four octaves, from
// terraces of 7 m to tufts of a foot: a border of snow has parts at each of these. width_m: of the pixel on the ground.
SHARED_FN SlopeRelief slope_relief(vec3 position_m, float width_m)
{
    const vec3 p = vec3(0.8f * position_m.x + 0.6f * position_m.z, 1.7f * position_m.y, 0.8f * position_m.z - 0.6f * position_m.x);
    const float terraces = variance_lost(width_m, 2.6f), steps = variance_lost(width_m, 1.5f);
    const float clods = variance_lost(width_m, 0.5f), tufts = variance_lost(width_m, 0.17f);
    // Factors, no quotients: those differ between devices by more than far places can bear.
    const float sum = 0.46f * sqrt(1.0f - terraces) * (endless_noise_3(p * (1.0f / 7.0f), 241u) - 0.5f) +
                      0.54f * sqrt(1.0f - steps) * (endless_noise_3(p * (1.0f / 2.4f) + 5.2f, 251u) - 0.5f) +
                      0.54f * sqrt(1.0f - clods) * (endless_noise_3(p * (1.0f / 0.83f) + 9.7f, 261u) - 0.5f) +
                      0.46f * sqrt(1.0f - tufts) * (endless_noise_3(p * (1.0f / 0.29f) + 2.6f, 271u) - 0.5f);
    SlopeRelief relief;
    relief.flatter = sum / 0.2f;
    relief.lost = 0.21f * (terraces + tufts) + 0.29f * (steps + clods);
    return relief;
}

// What snow_cover adds to the slope of wide ground: its relief holds snow here and sheds it there, so that it ends over
// some degrees and not at one. 0 in the mean, less the wider the pixel is.
SHARED_FN float snow_holds(SlopeRelief relief)
{
    return clamp(0.11f * relief.flatter, -0.35f, 0.35f);
}

// What steep wide ground catches in its relief, 0..1, of what lies on level ground: its slopes lie around that of the mesh
// by 13 degrees, and what of them is flatter than 55 degrees holds snow, the less the steeper (ours). So a third of the
// ground holds it at 60 degrees, a tenth at 70. up: y of the normal of the mesh.
SHARED_FN float snow_caught(float up, SlopeRelief relief)
{
    const float soft = 0.08f + 0.27f * sqrt(relief.lost);
    return smooth_edge(0.565f - soft, 0.565f + soft, up + 0.19f * relief.flatter);
}

// `blurred` of snow_cover for the masks of weather_maps.h: their mean 0.7067 and deviation 0.135 are those of
// snow_texel, of which half the variance is lost at 0.106 of a tile. width_m: of the pixel on the ground; tiling:
// repeats per metre of the mask and its detail.
SHARED_FN float snow_mask_blurred(float width_m, vec2 tiling)
{
    return 0.7067f * 0.135f * sqrt(variance_lost(width_m * tiling.x, 0.106f) + variance_lost(width_m * tiling.y, 0.106f));
}

// Lux's other mask, of vertices: the slope counts the less the more snow lies, and nothing else does.
// normal_up: of the geometry.
SHARED_FN SnowCover snow_cover_of_vertices(float amount, float normal_up, float slope_damp, float mask,
                                           float detail, float melt_influence, float blurred)
{
    return snow_cover_of_slope(saturate(amount - slope_damp * (1.0f - normal_up - 0.75f * amount)), 1.0f,
                               1.0f, mask, detail, melt_influence, blurred);
}

// Snow on a blade of grass. tint: red of the vertex colour, dark at the root; mask: at the blade.
SHARED_FN float snow_on_grass(float amount, float height_factor, float mask, float tint)
{
    const float x = amount * height_factor;
    const float e = smooth_edge(mask - x, mask, x * tint * (x * tint));
    return amount > 0.001f ? e * e * height_factor : 0.0f;
}

// Z of snow_cover: start and blend range in metres; a range of 0 is a sharp snow line.
SHARED_FN float snow_height_factor(float world_y_m, float start_m, float blend_m)
{
    return sqrt(saturate((world_y_m - start_m) / max(blend_m, 1.0e-3f)));
}

// Seven, three and one times the blend range wide, -1..1 around 0: where a snow line runs up a gully or down a spur.
SHARED_FN float snow_line_noise(vec2 at_m, float blend_m)
{
    const vec2 p = at_m / max(blend_m, 1.0e-3f);
    return tileable_noise(p / 7.3f, 4096, 71u) + 0.65f * tileable_noise(p / 2.9f, 4096, 72u) +
           0.35f * tileable_noise(p / 1.1f, 4096, 73u) - 1.0f;
}

// The same on a snow line that runs up and down by `ragged` times twice its blend range; 0: by height alone.
SHARED_FN float snow_line_factor(vec3 position_m, float start_m, float blend_m, float ragged)
{
    const float reach_m = 2.0f * ragged * blend_m;
    if (ragged <= 0.0f || position_m.y < start_m - reach_m) return snow_height_factor(position_m.y, start_m, blend_m);
    if (position_m.y > start_m + blend_m + reach_m) return 1.0f;
    const float shift_m = reach_m * snow_line_noise(vec2(position_m.x, position_m.z), blend_m);
    return snow_height_factor(position_m.y + shift_m, start_m, blend_m);
}

// ---- frost -------------------------------------------------------------------------------------

// Hoar grows first and thickest on edges and rough places, which stand out into the cold air.
// amount 0..1; crystals: noise, 0..1 around 0.5; edge: 0 smooth and flat .. 1 an edge.
SHARED_FN float frost_cover(float amount, float crystals, float edge)
{
    const float grown = amount * (0.62f + 0.9f * edge);
    return smooth_edge(0.75f - grown, 1.2f - grown, crystals) * saturate(4.0f * amount);
}

// Melting snow wets the ground around it: raises the standing-water cover.
SHARED_FN float melt_wetness(float water_anywhere, float snow_melt_mask, float melt_exp)
{
    return saturate(water_anywhere + 0.75f * saturate(1.75f * snow_melt_mask * melt_exp));
}

// Porosity of a dry dielectric from its smoothness: the thresholds are those of Lagarde 2013 (Water
// drop 3b), in smoothness.
SHARED_FN float porosity_from_smoothness(float smoothness)
{
    return saturate((0.5f - smoothness) / 0.4f);
}

SHARED_END

#endif
