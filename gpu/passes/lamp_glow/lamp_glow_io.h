// Interface of the passes that light the air around lamps.
#ifndef PETRICHOR_GPU_PASSES_LAMP_GLOW_LAMP_GLOW_IO_H
#define PETRICHOR_GPU_PASSES_LAMP_GLOW_LAMP_GLOW_IO_H

#include "base/interop.h"

#define LAMP_GLOW_TILE 8
#define LAMP_GLOW_MOST 16

// lamp_glow: one invocation for GLOW_BLOCK x GLOW_BLOCK pixels
#define LAMP_GLOW_FRAME 0
#define LAMP_GLOW_LAMPS 1
#define LAMP_GLOW_FUNCTION 2
#define LAMP_GLOW_DEPTH 3
#define LAMP_GLOW_TARGET 4

// lamp_glow_over: adds it to the picture
#define LAMP_GLOW_OVER_FRAME 0
#define LAMP_GLOW_OVER_DEPTH 1
#define LAMP_GLOW_OVER_COARSE 2
#define LAMP_GLOW_OVER_ACCUMULATED 3

SHARED_BEGIN

struct GlowLamp {
    vec3 position_m;
    float per_m;       // extinction of the air there
    vec3 color;        // cd
    float kind;        // as in lights_io.h: a spot's outer cosine, or what it is
    vec3 direction;
    float inner_cosine;
};
struct GlowLamps {
    GlowLamp lamps[LAMP_GLOW_MOST];
    int count;
};

SHARED_END

#endif
