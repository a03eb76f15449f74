// Where and when drops hit standing water: the births of rings, and of the crowns over them.
//
// One text for C++ and GLSL. The map of rings repeats, and so do its births; which of them throw up a crown is told
// for each place of the world and each time anew.
#ifndef PETRICHOR_FORMULAS_WEATHER_DROP_BIRTHS_H
#define PETRICHOR_FORMULAS_WEATHER_DROP_BIRTHS_H

#include "base/interop.h"
#include "formulas/weather/ripple.h"
#include "formulas/weather/weather_maps.h"

SHARED_BEGIN

struct RingBirth {
    vec2 place;   // of its middle, in repeats of the map over the world (ripple_tiling of them a metre, along x and z)
    float age;    // 0..1 of kRippleBirths_per_s' period: how long ago the drop has hit
    float turn;   // how many have hit there before: a whole number
};

// cell: any whole numbers, kDropCells of them a repeat; layer: as ripple_layer.
SHARED_FN RingBirth ring_birth(ivec2 cell, int layer, float time_s, float speed)
{
    const DropCell drop = drop_cell(cell, 0u);
    const RippleLayer rings = ripple_layer(layer, 1.0f, time_s, speed);
    const float since = drop.when + rings.clock;
    RingBirth birth;
    birth.place = drop.centre / float(kDropCells) - rings.offset;
    birth.age = fract(since);
    birth.turn = rings.begun + floor(since);
    return birth;
}

// A number of 0..1 that this drop alone has; seed: of the film, and another for another number.
SHARED_FN float ring_chance(ivec2 cell, int layer, float turn, uint seed)
{
    const uint here = hash_u3(uint(cell.x), uint(cell.y), seed + uint(layer));
    return hash_f(hash_u(here + uint(int(turn)) * 0x9e3779b9u));
}

// How many rings begin, a square metre and second.
SHARED_FN float ring_births_per_m2_s(int layer, float tiling, float speed)
{
    const float cells = float(kDropCells) * tiling;
    return cells * cells * kRippleBirths_per_s * abs(speed) * ripple_rate(layer);
}

SHARED_END

#endif
