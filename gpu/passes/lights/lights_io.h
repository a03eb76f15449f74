// Interface of the passes that find the lights of each tile.
#ifndef PETRICHOR_GPU_PASSES_LIGHTS_LIGHTS_IO_H
#define PETRICHOR_GPU_PASSES_LIGHTS_LIGHTS_IO_H

// A light in the table:
//   0   centre; how far it reaches
//   1   colour, cd (lux of a directional light, cd/m2 of a rectangle); the cosine of a spot's outer
//       cone, or one of the kinds below
//   2   axis (rectangle: half of an edge); cosine of the inner cone
//   3   of a rectangle: half of the other edge, so that cross(2, 3) is its front; the number of its
//       shadow, or -1
#define LIGHT_TEXELS 4
#define LIGHT_POINT -2.0f
#define LIGHT_ONE_SIDE -3.0f
#define LIGHT_BOTH_SIDES -4.0f

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
