// Interface of the aov pass.
#ifndef PETRICHOR_GPU_OUTPUTS_AOV_IO_H
#define PETRICHOR_GPU_OUTPUTS_AOV_IO_H

#include "base/interop.h"

#define AOV_TILE 8

#define AOV_FRAME 0
#define AOV_DEPTH 1
#define AOV_COLOR 2
#define AOV_NORMALS 3
#define AOV_MATERIAL 4
#define AOV_WEATHER 5
#define AOV_EMISSION 6
#define AOV_OUTPUT 7

SHARED_BEGIN

struct AovParams {
    uint kind;
    uint has_weather;  // 0: the target was not written in this frame
    uint has_emission;
};

SHARED_END

#endif
