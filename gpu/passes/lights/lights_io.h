// Interface of the passes that find the lights of each tile.
#ifndef PETRICHOR_GPU_PASSES_LIGHTS_LIGHTS_IO_H
#define PETRICHOR_GPU_PASSES_LIGHTS_LIGHTS_IO_H

// light_coarse: one invocation a word of 32 lights
#define LIGHT_COARSE_GROUP 64
#define LIGHT_COARSE_FRAME 0
#define LIGHT_COARSE_LIGHTS 1
#define LIGHT_COARSE_WORDS 2

// light_lists: one invocation a tile
#define LIGHT_LISTS_TILE 8
#define LIGHT_LISTS_FRAME 0
#define LIGHT_LISTS_LIGHTS 1
#define LIGHT_LISTS_WORDS 2
#define LIGHT_LISTS_DEPTH 3
#define LIGHT_LISTS_LISTS 4

#endif
