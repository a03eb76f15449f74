// What stands where the land beyond a scene ends: single trees and hedges, woods behind them, low hills behind all. Level land
// alone ends like the edge of a table. Rows of it at five distances all around, told by the direction alone, as the sky is;
// sizes and densities are ours, chosen by eye, as of a plain in the middle of Europe.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_LIGHT_SKYLINE_H
#define PETRICHOR_FORMULAS_LIGHT_SKYLINE_H

#include "base/interop.h"
#include "formulas/light/brdf.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

SHARED_CONST int kSkylineRows = 5;
SHARED_CONST float kSkylineEnds = 0.03f;  // rise over one metre of way from which on there is only sky, for an eye on the ground or above
SHARED_CONST float kEarthDrop_m = 14.7e6f;  // the square of a way over how far the land falls away on it, with the bending of light by the air

struct SkylineRow {
    float away_m;
    float tall_m;   // the highest of its trees
    float crown_m;  // how wide one is
    float hills_m;  // the highest of what they stand on
    float grown;    // the share of its length where something grows
};

SHARED_FN SkylineRow skyline_row(int k)
{
    SkylineRow row;
    row.away_m = k == 0 ? 360.0f : k == 1 ? 820.0f : k == 2 ? 1900.0f : k == 3 ? 4300.0f : 9500.0f;
    row.tall_m = k == 0 ? 10.0f : k == 1 ? 14.0f : k == 2 ? 18.0f : k == 3 ? 20.0f : 20.0f;
    row.crown_m = k == 0 ? 7.0f : k == 1 ? 8.0f : k == 2 ? 10.0f : k == 3 ? 16.0f : 30.0f;
    row.hills_m = k == 0 ? 0.0f : k == 1 ? 1.0f : k == 2 ? 9.0f : k == 3 ? 60.0f : 210.0f;
    row.grown = k == 0 ? 0.3f : k == 1 ? 0.5f : k == 2 ? 0.75f : 1.0f;
    return row;
}

// Turns of a level direction of length 1, -pi .. pi: by a polynomial of Hastings' kind (1e-5 off), since devices' own differ by more than
// a crown's edge far out.
SHARED_FN float skyline_angle(vec2 ahead)
{
    const float x = abs(ahead.x), y = abs(ahead.y);
    const float z = min(x, y) / max(x, y);
    const float q = z * z;
    const float low = z * (0.99997726f + q * (-0.33262347f + q * (0.19354346f + q * (-0.11643287f + q * (0.05265332f - q * 0.01172120f)))));
    const float first = y > x ? 0.5f * kPi - low : low;
    const float half_turn = ahead.x < 0.0f ? kPi - first : first;
    return ahead.y < 0.0f ? -half_turn : half_turn;
}

// Of a row in a direction: x where its ground ends, y where its trees end, metres above the land there. ahead: of the direction, level
// and of length 1. width_m: of a pixel there; of trees that are narrower it knows their mean.
SHARED_FN vec2 skyline_tops(SkylineRow row, vec2 ahead, float width_m, uint seed)
{
    const vec2 at = ahead * row.away_m;
    float hill = 0.0f;
    if (row.hills_m > 0.0f) {
        const float broad = 0.65f * endless_noise(at / 2300.0f + splat2(7.0f), seed) + 0.35f * endless_noise(at / 760.0f, seed + 1u);
        hill = row.hills_m * smooth_edge(0.2f, 0.9f, broad);
    }
    float grown = 1.0f;
    if (row.grown < 1.0f) {
        const float spread = 0.65f * endless_noise(at / 130.0f, seed + 2u) + 0.35f * endless_noise(at / 37.0f, seed + 3u);
        const float bare = 0.5f + 0.62f * (0.5f - row.grown);
        grown = smooth_edge(bare - 0.05f, bare + 0.05f, spread);
    }
    // A whole number of them goes around.
    const float around = floor(2.0f * kPi * row.away_m / row.crown_m);
    const float u = (skyline_angle(ahead) / (2.0f * kPi) + 0.5f) * around;
    const float cell = floor(u);
    float crowns = 0.0f;
    for (int i = -1; i <= 1; ++i) {
        const float own = cell + float(i);
        const uint tree = hash_u3(uint(int(own < 0.0f ? own + around : own >= around ? own - around : own)), seed, 383u);
        const float radius = 0.5f + 0.42f * hash_f(tree);
        const float away = (u - own - 0.5f - 0.35f * (2.0f * hash_f(tree + 1u) - 1.0f)) / radius;
        const float round_top = 1.0f - away * away * (0.25f + 0.75f * away * away);
        const float tall = hash_f(tree + 2u);
        crowns = max(crowns, round_top * (0.42f + 0.58f * tall * tall));
    }
    const float seen = 1.0f - smooth_edge(0.25f, 1.0f, width_m / row.crown_m);
    return vec2(hill, hill + row.tall_m * grown * mix(0.543f, crowns, seen));
}

// How much of a pixel a row covers, 0..1. over_m: of the middle of the pixel over the land there, metres.
SHARED_FN float skyline_cover(vec2 tops, float over_m, float width_m)
{
    const float half_m = 0.5f * width_m;
    return clamp(min(tops.y, over_m + half_m) - max(0.0f, over_m - half_m), 0.0f, width_m) / width_m;
}

// Height over the land of a row at which a direction passes it. rise: of the direction, metres a metre; eye_m: above the land.
SHARED_FN float skyline_over_m(SkylineRow row, float rise, float eye_m)
{
    return eye_m + rise * row.away_m + row.away_m * row.away_m / kEarthDrop_m;
}

// How bright leaves are beside their mean: masses of them, lighter above.
SHARED_FN float skyline_tone(SkylineRow row, vec2 ahead, vec2 tops, float over_m, float width_m, uint seed)
{
    const float angle = skyline_angle(ahead) * row.away_m;
    const float left = sqrt(1.0f - variance_lost(width_m, 0.5f * row.crown_m));
    const float mass = endless_noise(vec2(angle, 1.4f * over_m) / (0.5f * row.crown_m), seed + 4u) - 0.5f;
    const float high = clamp((over_m - tops.x) / max(tops.y - tops.x, 1.0f), 0.0f, 1.0f);
    return (0.8f + 0.4f * high) * (1.0f + 0.7f * left * mass);
}

// Share of a hillside below its trees that is wooded: the rest is fields.
SHARED_FN float skyline_wooded(SkylineRow row, vec2 ahead, vec2 tops, float over_m, float width_m, uint seed)
{
    const float angle = skyline_angle(ahead) * row.away_m;
    const float field = endless_noise(vec2(angle / 420.0f, over_m / 26.0f), seed + 5u);
    return max(smooth_edge(tops.x - width_m, tops.x + width_m, over_m), smooth_edge(0.4f, 0.5f, field));
}

// What a ball of leaves sends to the eye of the sun's light on a plane that faces the sun: Lambert's sphere (Schoenberg). along_view: the
// cosine between the ways to the sun and away from the eye. For an albedo of 1.
SHARED_FN float skyline_sunlit(float along_view)
{
    const float phase = acos(clamp(-along_view, -1.0f, 1.0f));
    return (2.0f / 3.0f) * ((kPi - phase) * cos(phase) + sin(phase)) / (kPi * kPi);
}

SHARED_END

#endif
