// Interface of the passes that make the tileable maps of the weather.
#ifndef PETRICHOR_GPU_PASSES_SURFACE_MAPS_SURFACE_MAPS_IO_H
#define PETRICHOR_GPU_PASSES_SURFACE_MAPS_SURFACE_MAPS_IO_H

#include "base/interop.h"

#define SURFACE_MAPS_TILE 8

// ripple_source, snow_mask, flow: nothing is read
#define SURFACE_MAPS_ALONE_TARGET 0
// ripple
#define RIPPLE_SOURCE 0
#define RIPPLE_TARGET 1
// map_mip
#define MAP_MIP_FROM 0
#define MAP_MIP_TO 1
// map_quads
#define MAP_QUADS_MAP 0
#define MAP_QUADS_QUADS 1

SHARED_BEGIN

struct RippleParams {
    float rain;
    float time_s;
    float speed;
    float spread;  // ring_drop_spread
};

struct MapQuadsParams {
    int size;
    int levels;
};

struct FlowParams {
    float time_s;
    float tile_m;
};

SHARED_END

#endif
