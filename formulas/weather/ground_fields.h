// Farmed land: far from what stands in a scene level green ground is cut into parcels, each of one crop, as a plain is
// that is seen from a hill or from the air. Noise alone, however wide, is a stained lawn from there. In world space and stateless; sizes,
// colours and strengths are ours, chosen by eye.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_GROUND_FIELDS_H
#define PETRICHOR_FORMULAS_WEATHER_GROUND_FIELDS_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

// Parcels lie in rows so wide; along those they are this wide, from row to row another width.
SHARED_CONST float kFieldRow_m = 210.0f, kNarrowField_m = 120.0f, kWideField_m = 430.0f;
SHARED_CONST float kFieldBorder_m = 3.0f;
SHARED_CONST float kHedge_m = 3.0f;    // half the width of a dark strip on borders ..
SHARED_CONST float kHedged = 0.028f;  // .. and what of the land they are
SHARED_CONST float kHedgeBare = 0.75f;  // of a hedge no snow lies on as much: it stands out of it

// How far a place is farmed, 0..1: not around the origin, where the scene stands and its own ground is seen from near, nor on slopes,
// and only what is green. up: y of the normal of the mesh. base: colour of the ground.
SHARED_FN float farmed_share(vec2 xz, float up, vec3 base)
{
    const float away = smooth_edge(130.0f, 330.0f, length(xz)) * smooth_edge(0.955f, 0.985f, up);
    const float green = (base.y - max(base.x, base.z)) / max(base.x + base.y + base.z, 1.0e-3f);
    return away * smooth_edge(0.015f, 0.07f, green);
}

struct FieldRow {
    vec2 crop;      // moist, and of which kind: -1..1 each, 0 in the mean
    float hedge_m;  // from the next border between two of its parcels
};

// Of a row at a place along it. soft_m: half the width over which one crop goes over into the next.
SHARED_FN FieldRow field_row(float along_m, int row, float soft_m)
{
    const uint seed = hash_u3(uint(row), 7u, 331u);
    const float width_m = mix(kNarrowField_m, kWideField_m, hash_f(seed));
    const float at = along_m / width_m + 31.0f * hash_f(seed + 1u);
    const float cell = floor(at);
    const float f = at - cell;
    const float border_m = min(f, 1.0f - f) * width_m;
    const uint own = hash_u3(uint(int(cell)), uint(row), 337u), next = hash_u3(uint(int(cell) + (f < 0.5f ? -1 : 1)), uint(row), 337u);
    const float share = 0.5f * (1.0f - min(border_m / soft_m, 1.0f));
    FieldRow found;
    found.crop = vec2(2.0f * mix(hash_f(own), hash_f(next), share) - 1.0f, 2.0f * mix(hash_f(own + 1u), hash_f(next + 1u), share) - 1.0f);
    found.hedge_m = border_m;
    return found;
}

struct Field {
    vec3 tone;    // factor of the albedo
    float hedge;  // share of hedges here, 0..1
};

// The tone is 1 in the mean. At strength 1 its deviation is 0.35 of red and 0.2 of green and blue: a moist crop is dark
// and green, a ripe one pale and yellow, and of other kinds there are brown ones. width_m: of the pixel on the ground; of a pixel that holds
// many parcels it is 1.
SHARED_FN Field field_at(vec2 xz, float width_m, float strength)
{
    // Rows follow the land.
    const float land = endless_noise(vec2(xz.y - 0.3f * xz.x, xz.x + 0.3f * xz.y) / 1370.0f, 347u) - 0.5f;
    const float near = endless_noise(xz / 390.0f + 5.3f, 349u) - 0.5f;
    const vec2 at = vec2(0.87f * xz.x - 0.49f * xz.y + 90.0f * near, 0.49f * xz.x + 0.87f * xz.y + 380.0f * land + 30.0f * near);
    const float across = at.y / kFieldRow_m;
    const float row = floor(across);
    const float f = across - row;
    const float soft_m = min(max(kFieldBorder_m, width_m), 0.5f * kNarrowField_m);
    const FieldRow own = field_row(at.x, int(row), soft_m), beside = field_row(at.x, int(row) + (f < 0.5f ? -1 : 1), soft_m);
    const float border_m = min(f, 1.0f - f) * kFieldRow_m;
    const float share = 0.5f * (1.0f - min(border_m / soft_m, 1.0f));
    const float left = sqrt(1.0f - variance_lost(width_m, 90.0f));
    const float moist = left * mix(own.crop.x, beside.crop.x, share), kind = left * mix(own.crop.y, beside.crop.y, share);
    // Hedges along some borders: what is left of a strip in a wide pixel.
    const float next_m = min(border_m, mix(own.hedge_m, beside.hedge_m, share));
    const float reach_m = max(kHedge_m, 0.5f * width_m);
    const float some = smooth_edge(0.42f, 0.58f, endless_noise(at / 260.0f + 3.1f, 353u));
    const float strip = some * (kHedge_m / reach_m) * (1.0f - smooth_edge(0.6f * reach_m, 1.4f * reach_m, next_m));
    // Less their mean, or ground with hedges would be darker than its texture says.
    const float hedge = left * (strip - kHedged);
    const vec3 tone = splat3(1.0f) - (strength * moist) * vec3(0.56f, 0.29f, 0.30f) + (strength * kind) * vec3(0.22f, 0.05f, 0.18f);
    Field field;
    field.tone = max(tone, splat3(0.25f)) * (1.0f - 0.55f * min(strength, 1.0f) * hedge);
    field.hedge = mix(kHedged, strip, left) * min(strength, 1.0f);
    return field;
}

SHARED_FN vec3 field_tone(vec2 xz, float width_m, float strength) { return field_at(xz, width_m, strength).tone; }

// What of a snow cover is seen where so much is hedges.
SHARED_FN float snow_beside_hedges(float snow, float hedge) { return snow * (1.0f - kHedgeBare * hedge); }

SHARED_END

#endif
