// How the colour of wide ground varies from place to place: soil, moisture and growth are nowhere the same over a
// field, and a texture of a few metres knows nothing of it. Without it a plain seen from above is one flat colour.
// In world space and stateless; sizes and strengths are ours, chosen by eye.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_GROUND_TONE_H
#define PETRICHOR_FORMULAS_WEATHER_GROUND_TONE_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

// A material has ground so wide that it varies from this area on that faces up, m2; 140 m by 140 m.
SHARED_CONST float kWideGround_m2 = 20000.0f;

// Noise around 0 of cells of a width, less of it the wider the pixel: the mean of a pixel that holds many cells is 0.
SHARED_FN float ground_octave(vec2 at_m, float cell_m, uint seed, float width_m)
{
    return (endless_noise(at_m / cell_m, seed) - 0.5f) * sqrt(1.0f - variance_lost(width_m, 0.6f * cell_m));
}

// What grows on wide ground, from place to place. Each is 0 in the mean; their deviation is 0.24, and the one
// tells nothing of the other.
struct GroundGrowth {
    float moist;  // -1 dry and thin .. 1 moist and thick
    float other;  // -1 of one kind of plants .. 1 of another: the grass of a field is mown here and in seed there
};

// Lattices of the octaves are turned against each other, and the wide ones bent by the finer, so that no direction shows. Both are
// sums of the same octaves. width_m: of the pixel on the ground.
SHARED_FN GroundGrowth ground_growth(vec2 xz, float width_m)
{
    const vec2 turned = vec2(0.83f * xz.x - 0.56f * xz.y, 0.56f * xz.x + 0.83f * xz.y);
    const vec2 other = vec2(0.36f * xz.x + 0.93f * xz.y, 0.36f * xz.y - 0.93f * xz.x);
    const float fine = ground_octave(turned + 3.7f, 7.3f, 211u, width_m);
    const float near = ground_octave(other + 9.1f, 31.0f, 223u, width_m);
    const vec2 bent = turned + vec2(40.0f * near, 9.0f * fine);
    const float wide = ground_octave(bent + 17.0f, 88.0f, 227u, width_m);
    const float land = ground_octave(xz + vec2(9.0f * near, 120.0f * wide), 330.0f, 229u, width_m);
    const float country = ground_octave(turned + vec2(350.0f * land, 160.0f * wide), 1100.0f, 239u, width_m);
    GroundGrowth growth;
    growth.moist = 0.5f * country + 0.6f * land + 0.5f * wide + 0.42f * near + 0.36f * fine;
    growth.other = 0.1f * country + 0.55f * wide - 0.6f * land + 0.42f * near - 0.40f * fine;
    return growth;
}
SHARED_FN float ground_moisture(vec2 xz, float width_m) { return ground_growth(xz, width_m).moist; }

// Factor of the albedo, 1 in the mean; at strength 1 its deviation is 13 % of red, 9 % of green and of blue: moist
// ground is dark and green, dry ground pale and yellow, and in seed it is browner than mown.
SHARED_FN vec3 ground_tone(vec2 xz, float width_m, float strength)
{
    const GroundGrowth growth = ground_growth(xz, width_m);
    return max(splat3(1.0f) - (strength * growth.moist) * vec3(0.46f, 0.37f, 0.34f) + (strength * growth.other) * vec3(0.28f, 0.05f, 0.12f), splat3(0.25f));
}

// Grass as it stands on wide ground. Textures and colours made for it are often greener and brighter than any meadow, which is blades beside
// stalks, thatch and soil, each in the shade of others: swards reflect about a tenth of the visible light. Blades whose green is at most
// 1.3 times their red keep their tone, and what is not green at all is left alone, as stone is. Strengths are ours, by eye on the shared town in rain. strength: of all variation of ground, 0 none.
SHARED_FN vec3 meadow_tone(vec3 base, float strength)
{
    const float grey = dot(base, vec3(0.30f, 0.59f, 0.11f));
    const float green = base.y / max(max(base.x, base.z), 1.0e-4f);
    const float shade = saturate(strength) * smooth_edge(1.0f, 1.2f, green) * 2.5f * max(grey - 0.12f, 0.0f);
    const vec3 straw = grey * vec3(1.10f, 1.0f, 0.73f);
    return mix(base, straw, 0.5f * saturate(strength) * smooth_edge(1.3f, 1.6f, green)) / (1.0f + shade);
}

// What the mesh of wide ground does not have of its relief, m: its triangles are metres wide, and no meadow is so even. 0
// in the mean, deviation 0.02. So the shore of a pond winds, and no line of the mesh is drawn in water.
SHARED_FN float wide_relief_m(vec2 xz, float width_m)
{
    const float steps = ground_octave(xz + 2.3f, 4.1f, 263u, width_m);
    const float tufts = ground_octave(vec2(0.8f * xz.x - 0.6f * xz.y, 0.6f * xz.x + 0.8f * xz.y), 1.3f, 269u, width_m);
    return 0.09f * steps + 0.06f * tufts;
}

SHARED_END

#endif
