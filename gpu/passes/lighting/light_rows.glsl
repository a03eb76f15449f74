// Rows of the table of lights (gpu/passes/lights/lights_io.h).
//
// What is read by an address that a CPU computes for each invocation costs it a load for each. Those of a
// group look at the same list: there each reads one of the next lights, and all take them from it in turn.
#ifndef PETRICHOR_LIGHT_ROWS_GLSL
#define PETRICHOR_LIGHT_ROWS_GLSL

#include "gpu/passes/lighting/light_row.glsl"

const bool TOGETHER = (WAYS & LIGHTS_TOGETHER) != 0u && LISTED != 1u;

// What that invocation of the subgroup read; all of them are there.
LightRow row_of_lane(LightRow mine, uint lane)
{
    LightRow row;
    row.sphere = subgroupShuffle(mine.sphere, lane);
    row.inverse_reach2 = subgroupShuffle(mine.inverse_reach2, lane);
    row.color = subgroupShuffle(mine.color, lane);
    row.axis = subgroupShuffle(mine.axis, lane);
    row.across = subgroupShuffle(mine.across, lane);
    row.size = subgroupShuffle(mine.size, lane);
    return row;
}

// Bits but for so many of the lowest that are set; LIGHTS_AT_ONCE at most.
uint without_lowest(uint bits, uint count)
{
    for (uint i = 0u; i < LIGHTS_AT_ONCE; ++i) bits = i < count ? bits & (bits - 1u) : bits;
    return bits;
}

#endif
