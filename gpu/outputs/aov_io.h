// Interface of the aov pass: all outputs that a frame asks for in one dispatch.
#ifndef PETRICHOR_GPU_OUTPUTS_AOV_IO_H
#define PETRICHOR_GPU_OUTPUTS_AOV_IO_H

#include "base/interop.h"
#include "gpu/frame/gbuffer_table_io.h"

#define AOV_TILE 8

// Rows of the table that are written, a bit each; the shader is compiled for them.
#define AOV_SPEC_ROWS_LOW 0   // rows 0 to 31
#define AOV_SPEC_ROWS_HIGH 1  // rows 32 to 63
#define AOV_SPEC_WEATHER 2
#define AOV_SPEC_HAS_EMISSION 3
#define AOV_SPEC_HAS_BAKED 4
#define AOV_SPEC_PLACE 5
#define AOV_SPEC_MATERIALS 6  // 1: of the weather's targets only the material counts

SHARED_BEGIN
// How surfaces are lit, by the number of their lighting model.
struct AovPush {
    uint built_in;   // models below it are ours
    uint gather[8];  // a bit a model: its light is gathered before its material is asked
};
SHARED_END

#define AOV_FRAME 0
#define AOV_OUTPUT 1
#define AOV_PLACE_TABLE 2  // gpu/frame/place.glsl
#define AOV_PLACE_STATES 3
#define AOV_PLACE_LABELS 4
#define AOV_PLACE_LEVELS 5
#define AOV_GBUFFER 6  // depth, then the targets

#endif
