// What is white in the ice of puddles: haze of fine bubbles, bubbles one sees, and cracks. Drawn by place, with no texture, at any
// width of a pixel; the mean over a wide place is kIceWhite (apply_weather.h).
//
// Cracks run along the borders of Voronoi cells of two sizes, a part of them, bent a little. A crack is a sheet that goes down into the
// ice: beside the line that it is from above the eye sees it as a band, as wide as the way of the sight through the ice. Sizes and
// shares are ours, by photographs of frozen puddles.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_ICE_PATTERN_H
#define PETRICHOR_FORMULAS_WEATHER_ICE_PATTERN_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

SHARED_CONST float kIceThick_m = 0.012f;     // how deep cracks are seen
SHARED_CONST float kIceBubbles_m = 0.006f;   // how deep bubbles lie
SHARED_CONST float kBubbleCell_m = 0.022f;

// Of a line of a width at a distance, the share of a pixel's width that it takes.
SHARED_FN float line_share(float from_m, float to_m, float pixel_m)
{
    const float half_m = 0.5f * pixel_m;
    return saturate((min(to_m, half_m) - max(from_m, -half_m)) / (2.0f * half_m));
}

// Cracks of one size. at: place over the size of a cell; size_m: of it; share: of the borders; sheet_m: the way of the sight along the surface while it goes
// through the ice. x: the crack from above, y: the band below it.
SHARED_FN vec2 ice_cracks(vec2 at, float size_m, float width_m, float share, vec2 sheet_m, float pixel_m, uint seed)
{
    const vec2 base = floor(at);
    const vec2 inside = at - base;
    vec2 first = vec2(8.0f, 0.0f), second = vec2(8.0f, 0.0f);
    float first_2 = 64.0f, second_2 = 64.0f;
    uint first_id = 0u, second_id = 0u;
    for (int k = 0; k < 9; ++k) {
        const ivec2 step = ivec2(k % 3 - 1, k / 3 - 1);
        const uint id = hash_u3(uint(int(base.x) + step.x), uint(int(base.y) + step.y), seed);
        const vec2 way = vec2(float(step.x), float(step.y)) + splat2(0.1f) +
                         0.8f * vec2(float(id >> 16u), float(id & 0xffffu)) * (1.0f / 65536.0f) - inside;
        const float way_2 = dot(way, way);
        const bool nearest = way_2 < first_2;
        const bool next = !nearest && way_2 < second_2;
        second = nearest ? first : next ? way : second;
        second_2 = nearest ? first_2 : next ? way_2 : second_2;
        second_id = nearest ? first_id : next ? id : second_id;
        first = nearest ? way : first;
        first_2 = nearest ? way_2 : first_2;
        first_id = nearest ? id : first_id;
    }
    const vec2 across = second - first;
    const float apart = max(sqrt(dot(across, across)), 1.0e-3f);
    const float distance_m = 0.5f * (second_2 - first_2) / apart * size_m;
    // The same from both sides.
    const uint border = first_id ^ second_id;
    const float there = hash_f(border) < share ? 1.0f : 0.0f;
    const float half_m = width_m * (0.2f + 0.6f * hash_f(border + 1u));
    const float along_m = dot(sheet_m, across) / apart;
    const float crack = line_share(distance_m - half_m, distance_m + half_m, pixel_m);
    const float band = line_share(distance_m - max(-along_m, 0.0f), distance_m + max(along_m, 0.0f), pixel_m);
    return there * vec2(crack, band);
}

// A disc in most cells where bubbles are many, none where they are few.
SHARED_FN float ice_bubbles(vec2 at_m, float many, float pixel_m)
{
    const vec2 at = at_m / kBubbleCell_m;
    const vec2 base = floor(at);
    const uint id = hash_u3(uint(int(base.x)), uint(int(base.y)), 977u);
    const float radius = 0.06f + 0.3f * hash_f(id) * hash_f(id + 1u);
    const vec2 middle = splat2(0.5f) + (0.5f - radius) * (2.0f * vec2(hash_f(id + 2u), hash_f(id + 3u)) - splat2(1.0f));
    const vec2 way = at - base - middle;
    const float pixel = pixel_m / kBubbleCell_m;
    const float from = sqrt(dot(way, way));
    const float disc = saturate((radius - from) / pixel + 0.5f);
    // Its rim is brighter than its middle, through which one sees.
    const float rim = mix(1.0f, 0.45f, saturate((0.7f * radius - from) / max(0.3f * radius, pixel) + 0.5f));
    // A pixel wider than a cell has the mean of it.
    const float mean = 0.055f;
    const float near = saturate(2.0f - 2.0f * pixel);
    const float shown = hash_f(id + 4u) < many ? 1.0f : 0.0f;
    return mix(mean * many, shown * disc * rim, near);
}

// How white ice is, 0..1.
//   at_m     x and z of the world
//   toward   from the surface to the eye
//   width_m  that a pixel shows there
SHARED_FN float ice_white(vec2 at_m, vec3 toward, float width_m)
{
    const float pixel_m = max(width_m, 1.0e-3f);  // nothing in it is sharper
    // The sight below the surface, by its slope in ice.
    const vec2 sheet = -vec2(toward.x, toward.z) * (0.76f / sqrt(max(1.0f - 0.58f * (1.0f - toward.y * toward.y), 0.2f)));
    const vec2 bend = vec2(endless_noise(at_m * 3.1f, 31u), endless_noise(at_m * 3.1f, 32u)) - splat2(0.5f);
    const float wide = endless_noise(at_m * 1.3f + 1.5f * bend, 33u);
    const vec2 turned_m = vec2(0.8f * at_m.x + 0.6f * at_m.y, 0.8f * at_m.y - 0.6f * at_m.x);
    const float fine = endless_noise(turned_m * 9.0f + 3.0f * bend, 34u);
    const float cloud = 0.52f * wide + 0.34f * fine + 0.14f * endless_noise(vec2(turned_m.y, at_m.x) * 25.0f + 6.0f * bend, 36u);
    const float haze = 0.56f * smooth_edge(0.22f, 0.88f, cloud);
    const float many = smooth_edge(0.3f, 0.7f, 0.5f * wide + 0.5f * endless_noise(at_m * 4.3f, 35u));
    const vec2 large = ice_cracks((at_m + 0.25f * bend) / 0.62f, 0.62f, 0.004f, 0.6f, kIceThick_m * sheet, pixel_m, 41u);
    const vec2 small = ice_cracks((at_m + 0.16f * bend) / 0.17f, 0.17f, 0.0022f, 0.38f, 0.6f * kIceThick_m * sheet, pixel_m, 42u);
    const float few = smooth_edge(0.35f, 0.6f, 1.0f - wide);  // fine cracks where ice is clear
    const float lines = max(large.x, few * small.x);
    const float bands = max(large.y, few * small.y);
    const float bubbles = ice_bubbles(at_m + kIceBubbles_m * sheet, many, pixel_m);
    const float below = max(max(haze, 0.75f * bubbles), haze + (0.55f - haze) * bands);
    return saturate(below + (0.95f - below) * lines);
}

SHARED_END

#endif
