// Interface of the pass that looks up the light of patches at a few points of the picture, and of what
// spreads it over the pixels around (patch_spread.glsl).
#ifndef PETRICHOR_GPU_FRAME_PATCH_POINTS_IO_H
#define PETRICHOR_GPU_FRAME_PATCH_POINTS_IO_H

#define PATCH_BLOCK 4   // pixels a side; a point stands at pixel (2, 2) of its block
#define PATCH_POINTS 2  // a block: the second where another surface shows
// Texels (RGBA32UI) of a point:
//   0  irradiance over pi and share of open directions (4 halves), plane: normal (3 of 10 bits), distance
//      from the camera's plane parallel to it
//   1  ratio for a bent normal, vec3 . normal + constant (4 halves), view depth, points of the block (bits 0..7), PatchLight::close
//      (8..19) and close_light (20..31), of 4095
#define PATCH_POINT_TEXELS 2

#define PATCH_POINTS_TILE 8
#define PATCH_POINTS_FRAME 0
#define PATCH_POINTS_DEPTH 1
#define PATCH_POINTS_NORMALS 2
#define PATCH_POINTS_TABLE 3
#define PATCH_POINTS_WAYS 4
#define PATCH_POINTS_PLANES 5
#define PATCH_POINTS_IRRADIANCE 6
#define PATCH_POINTS_GRADIENT 7
#define PATCH_POINTS_TARGET 8
#define PATCH_POINTS_NEAR 9
#define PATCH_POINTS_LIST 10  // gpu/frame/pixel_list_io.h: of second points

#endif
