// Interface of the resolve pass.
#ifndef PETRICHOR_GPU_PASSES_RESOLVE_RESOLVE_IO_H
#define PETRICHOR_GPU_PASSES_RESOLVE_RESOLVE_IO_H

#define RESOLVE_TILE 8

#define RESOLVE_FRAME 0
#define RESOLVE_SKY_LIGHT 1
#define RESOLVE_ACCUMULATED 2
#define RESOLVE_GLARE 3
// of the compute shader alone
#define RESOLVE_BEAUTY 4
#define RESOLVE_DISPLAY 5

#define RESOLVE_SPEC_TONE_MAP 0  // a number of formulas/color/tone_map.h
#define RESOLVE_SPEC_BLOOM 1
#define RESOLVE_SPEC_WET_LENS 2
#define RESOLVE_SPEC_FILTERS 3  // as GLARE_SPEC_FILTERS
#define RESOLVE_SPEC_EXPOSED_LIGHT 4  // the display takes halves of light, two words a pixel

#endif
