// Interface of the passes that make the sky's maps. Each shader reads at most one map and writes one.
#ifndef PETRICHOR_GPU_PASSES_SKY_SKY_IO_H
#define PETRICHOR_GPU_PASSES_SKY_SKY_IO_H

#include "base/interop.h"

#define SKY_TILE 8

// sky_air, env_brdf: no map is read
#define SKY_ALONE_TARGET 0
#define SKY_AGAIN 1  // of sky_air: light scattered more than once
// sky_cube, environment_cube, sky_specular, sky_light, sky_quads
#define SKY_SOURCE 0
#define SKY_TARGET 1
// sky_cube: the tiles of the first level that are drawn, SKY_TILE texels a side; face, row and place in it
#define SKY_TILES 2
#define SKY_SPEC_LISTED 0  // 0: all of a level

SHARED_BEGIN

// sky_specular
struct PrefilterParams {
    float roughness;
    float source_size;
    float source_first;  // level: finer ones need not be there
    float source_mips;
};

// sky_quads
struct SkyQuadsParams {
    int begin;  // of the level
};

// environment_cube
struct EnvironmentParams {
    float rotation_rad;
    float scale;
};

// sky_light
struct SkyLightParams {
    vec3 sun_illuminance;
    float sun_up;
    float mip;
    float face_size;
    float exposure;  // > 0: given
    float bias;
    float ambient_scale;
    float floor_lux;
};

SHARED_END

#endif
