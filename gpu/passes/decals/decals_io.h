// Interface of the passes that lay decals over the G-buffer.
//
//   decal, decal_box   what lies over each pixel, blended in order: linear, times how much it covers
//   decals_over        puts it into the G-buffer
#ifndef PETRICHOR_GPU_PASSES_DECALS_DECALS_IO_H
#define PETRICHOR_GPU_PASSES_DECALS_DECALS_IO_H

#include "base/interop.h"
#include "gpu/frame/gbuffer_table_io.h"
#include "gpu/passes/surface/surface_io.h"

// Targets, all R16G16B16A16_SFLOAT; alpha is how much of what lies below they cover.
//   ROW(name, location, meaning)
#define DECAL_TARGETS(ROW)                                  \
    ROW(color, 0, "base colour")                            \
    ROW(normal, 1, "base normal, world")                    \
    ROW(matter, 2, "roughness, metallic, occlusion")        \
    ROW(weather, 3, "film, standing water, snow")           \
    ROW(cover, 4, "normal of water or snow, world")         \
    ROW(emission, 5, "radiance; the G-buffer's own target")

// Behind the bindings of set 0 that every evaluation of a surface reads:
#define DECAL_DEPTH SURFACE_BINDINGS
#define DECAL_NORMALS (SURFACE_BINDINGS + 1)
#define DECAL_SPEC_WEATHER 23
#define DECAL_SPEC_EMISSION 24

// decals_over
#define DECALS_OVER_FRAME 0
#define DECALS_OVER_LAID 1  // the targets above but the emission
#define DECALS_OVER_LOOKS 6
#define DECALS_OVER_COLOR 7
#define DECALS_OVER_NORMALS 8
#define DECALS_OVER_MATERIAL 9
#define DECALS_OVER_WEATHER 10
#define DECALS_OVER_SPEC_WEATHER 0
#define DECALS_OVER_SPEC_REFUSED 1  // 1: some material takes no decals
#define DECALS_OVER_TILE 8

SHARED_BEGIN

// Push constants of a box.
struct DecalBoxDraw {
    vec4 to_world[3];  // rows of the affine transform from the cube of -0.5 to 0.5
    vec4 to_box[3];    // of its inverse
    float full_cos;    // faces that look so much along the box's z are covered ..
    float none_cos;    // .. and none below this
    float edge_fade;
    uint material_id;
};

SHARED_END

#endif
