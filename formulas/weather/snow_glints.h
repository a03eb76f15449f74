// Snow sparkles: of the crystals on its surface a few mirror a light to the eye, and near the eye each is seen alone.
//
// What the surface mirrors in the mean is its lobe; here it is gathered on those crystals that stand right. Of all
// that a pixel shows, N crystals, each stands right with the probability p = D(h) times the solid angle of half
// vectors that it serves: it is flat to a degree and the sun is half a degree wide. N p is far below 1 near by and
// above it from afar, where all is even again (Jakob et al. 2014; the grid of cells and of half vectors is after
// Deliot and Belcour 2023, the law of one number in place of a count is ours).
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_SNOW_GLINTS_H
#define PETRICHOR_FORMULAS_WEATHER_SNOW_GLINTS_H

#include "base/interop.h"
#include "formulas/noise/noise.h"

SHARED_BEGIN

SHARED_CONST float kCrystals_m2 = 2.5e5f;   // facets of 1 to 2 mm that lie open
SHARED_CONST float kFacet_rad = 0.024f;     // of half vectors that one serves: side of a square
SHARED_CONST float kFinestGlint_m = 0.002f;

// A hill over a cell, 0 at its border, 1 in the mean.
SHARED_FN float glint_hill(vec2 in_cell)
{
    const vec2 u = in_cell * (splat2(1.0f) - in_cell);
    return 36.0f * u.x * u.y;
}

// One level of cells. at: place on the surface over the side of a cell; lean: slope of the half vector over that a
// facet serves; expected: crystals of a cell that stand right. 1 in the mean, mostly 0 where little is expected.
SHARED_FN float glints_of_level(vec2 at, vec2 lean, float expected, uint level)
{
    // A shift of its own for each level: no two see the same borders.
    const vec2 place = at + 0.37f * float(level % 7u);
    const vec2 cell = floor(place);
    const uint id = hash_u3(uint(int(cell.x)), uint(int(cell.y)), 611u + level);
    // Each cell cuts the half vectors elsewhere.
    const vec2 leans = lean + vec2(hash_f(id), hash_f(id + 1u));
    const vec2 way = floor(leans);
    const uint way_id = hash_u3(uint(int(way.x)), uint(int(way.y)), id);
    // As often and as bright as a count with that mean: variance 1 / expected.
    const float shows = expected / (1.0f + expected);
    const float bright = hash_f(way_id) < shows ? 1.0f / shows : 0.0f;
    // Few are points, many are an even sheet.
    const float hill = glint_hill(place - cell) * glint_hill(leans - way);
    return bright * mix(hill, 1.0f, shows);
}

// What snow mirrors of a light over the mean of its lobe, 0 to many, 1 in the mean.
//   at_m      on the surface: x and z of the world
//   seen_m    width that a pixel shows there
//   lean      slope of the half vector against the surface: its part along the surface over that along the normal
//   lobe      D(h) of the lobe, 1/sr
SHARED_FN float snow_glints(vec2 at_m, float seen_m, vec2 lean, float lobe)
{
    const float octave = log2(max(1.5f * seen_m / kFinestGlint_m, 1.0f));
    const float level = floor(octave);
    const float side_m = kFinestGlint_m * exp2(level);
    const float per_cell = kCrystals_m2 * side_m * side_m * lobe * (kFacet_rad * kFacet_rad);
    const vec2 leans = lean / kFacet_rad;
    const float fine = glints_of_level(at_m / side_m, leans, per_cell, uint(level));
    const float coarse = glints_of_level(at_m / (2.0f * side_m), leans, 4.0f * per_cell, uint(level) + 1u);
    return mix(fine, coarse, octave - level);
}

SHARED_END

#endif
