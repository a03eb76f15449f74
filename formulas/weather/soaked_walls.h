// What rain leaves on upright walls that drink: plaster and brick hold it in their pores, where it darkens, and not as a
// film, which mirrors; what is too much runs down in streaks. Strengths and widths are ours, chosen by eye.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_SOAKED_WALLS_H
#define PETRICHOR_FORMULAS_WEATHER_SOAKED_WALLS_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

// How far a surface is a wall, 0..1. up: y of the normal of the material.
SHARED_FN float upright(float up) { return 1.0f - smooth_edge(0.25f, 0.6f, abs(up)); }

// How far it is one that drinks. porosity 0..1, of what is matt.
SHARED_FN float drinking_wall(float up, float porosity) { return upright(up) * saturate(2.0f * porosity); }

// Which way a wall goes, of the two axes of the world: bumps turn the normal, and a place along it must not jump with them.
SHARED_FN vec3 along_wall(vec3 normal) { return abs(normal.x) > abs(normal.z) ? vec3(0.0f, 0.0f, 1.0f) : vec3(1.0f, 0.0f, 0.0f); }

// Share of the film that stays a film there: while it pours water runs over what is soaked.
SHARED_FN float film_not_drunk(float wall, float pouring) { return 1.0f - wall * (0.8f - 0.4f * pouring); }

// Film of the weather -> how far the pores are full, which is what darkens. They fill before a film closes, and where the
// border between wet and dry is, in streaks: 0 stays 0 and 1 stays 1. along_m: along the wall; y_m: height.
SHARED_FN float soaked_share(float film, float along_m, float y_m)
{
    const float streak = 0.6f * endless_noise(vec2(3.1f * along_m, 0.35f * y_m), 331u) +
                         0.4f * endless_noise(vec2(11.0f * along_m, 0.9f * y_m), 337u) - 0.5f;
    const float full = saturate(film + 2.2f * streak * film * (1.0f - film));
    return 1.0f - (1.0f - full) * (1.0f - full);
}

SHARED_END

#endif
