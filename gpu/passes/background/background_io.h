// Interface of the background pass.
#ifndef PETRICHOR_GPU_PASSES_BACKGROUND_BACKGROUND_IO_H
#define PETRICHOR_GPU_PASSES_BACKGROUND_BACKGROUND_IO_H

#include "base/interop.h"

#define BACKGROUND_TILE 8

#define BACKGROUND_FRAME 0
#define BACKGROUND_DEPTH_ROWS 1
#define BACKGROUND_SKY 2
#define BACKGROUND_PIXELS 3       // gpu/frame/pixel_list_io.h
#define BACKGROUND_ACCUMULATED 4
#define BACKGROUND_RADIANCE 5
#define BACKGROUND_PARTS 6
#define BACKGROUND_SKY_LIGHT 7

// Specialization constants: 0 leaves the part out of the compiled shader.
#define BACKGROUND_SPEC_SKY 0      // 0: black
#define BACKGROUND_SPEC_NIGHT 1    // stars and moon
#define BACKGROUND_SPEC_FOG 2
#define BACKGROUND_SPEC_PARTS 3    // the light is written taken apart, too
#define BACKGROUND_SPEC_MIRRORED 4 // surfaces may mirror it
#define BACKGROUND_SPEC_SKYLINE 5  // trees and hills where the land ends

SHARED_BEGIN

struct BackgroundParams {
    float skyline_from_m;  // nothing of the skyline stands nearer to the camera
};

SHARED_END

#endif
