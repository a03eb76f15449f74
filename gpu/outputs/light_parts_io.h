// The picture taken apart by the way of its light: one row a part, read by C++ and GLSL. The parts of a
// pixel sum up to the linear picture. `--aov`, the EXR's channels and the documentation follow.
//
//   ROW(layer, name, meaning)   layer: of the image `light_parts`; they count from 0
//
// Behind the layers of the parts lies that of the reflection label.
#ifndef PETRICHOR_GPU_OUTPUTS_LIGHT_PARTS_IO_H
#define PETRICHOR_GPU_OUTPUTS_LIGHT_PARTS_IO_H

#include "base/interop.h"

#define PART_DIFFUSE_DIRECT 0
#define PART_DIFFUSE_INDIRECT 1
#define PART_SPECULAR_DIRECT 2
#define PART_SPECULAR_INDIRECT 3
#define PART_TRANSMISSION 4
#define PART_EMITTED 5
#define PART_VOLUME 6
#define PART_BACKGROUND 7
#define LIGHT_PARTS 8

#define LIGHT_PARTS_TABLE(ROW)                                                                      \
    ROW(PART_DIFFUSE_DIRECT, diffuse_direct, "of the picture: light of sun and lamps, scattered")   \
    ROW(PART_DIFFUSE_INDIRECT, diffuse_indirect,                                                    \
        "of the picture: light of the sky, of other surfaces and of light maps, scattered")         \
    ROW(PART_SPECULAR_DIRECT, specular_direct, "of the picture: highlights of sun and lamps")       \
    ROW(PART_SPECULAR_INDIRECT, specular_indirect,                                                  \
        "of the picture: what surfaces mirror of their surroundings")                               \
    ROW(PART_TRANSMISSION, transmission,                                                            \
        "of the picture: what is seen through glass and other blended surfaces")                    \
    ROW(PART_EMITTED, emitted, "of the picture: what surfaces send out by themselves")              \
    ROW(PART_VOLUME, volume,                                                                        \
        "of the picture: fog, the glow of lamps in it, rain and snow that fall")                    \
    ROW(PART_BACKGROUND, background, "of the picture: the sky where no surface is")

// The label; its numbers that are no material's.
#define REFLECTION_LABEL_LAYER LIGHT_PARTS
#define REFLECTS_NOTHING -1.0
#define REFLECTS_SKY -2.0
#define REFLECTS_PROBE -3.0

#define LIGHT_PARTS_LAYERS 9

// light_parts.comp
#define LIGHT_PARTS_TILE 8
#define LIGHT_PARTS_FRAME 0
#define LIGHT_PARTS_SUM 1
#define LIGHT_PARTS_AIR 2
#define LIGHT_PARTS_VALUES 3

// light_parts_mean.comp
#define PARTS_MEAN_KEEP 0    // mean = lit
#define PARTS_MEAN_OF_TWO 1  // mean = (mean + lit) / 2
#define PARTS_MEAN_OF_SUM 2  // mean = lit / 2
#define PARTS_MEAN_TAKE 3    // lit += mean where nothing is shaded
#define PARTS_MEAN_SPEC_WHAT 0
#define PARTS_MEAN_FRAME 0
#define PARTS_MEAN_LIT 1
#define PARTS_MEAN_MEAN 2
#define PARTS_MEAN_ASKED 3  // as gpu/passes/adaptive/adaptive_io.h

SHARED_BEGIN

struct LightPartsPush {
    int layer;
    int mirrors;  // 0: nothing mirrors in this frame
};

SHARED_END

#endif
