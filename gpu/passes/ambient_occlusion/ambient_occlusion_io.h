// Interface of the ambient_occlusion pass.
#ifndef PETRICHOR_GPU_PASSES_AMBIENT_OCCLUSION_AMBIENT_OCCLUSION_IO_H
#define PETRICHOR_GPU_PASSES_AMBIENT_OCCLUSION_AMBIENT_OCCLUSION_IO_H

#define AMBIENT_OCCLUSION_TILE 8

// Specialization constant: 1: bent normals are kept behind the occlusion (gpu/frame/occlusion_blocks.glsl).
#define AMBIENT_OCCLUSION_SPEC_BENT 0

#define AMBIENT_OCCLUSION_FRAME 0
#define AMBIENT_OCCLUSION_DEPTH 1  // row by row
#define AMBIENT_OCCLUSION_NORMALS 2
#define AMBIENT_OCCLUSION_TARGET 3
#define AMBIENT_OCCLUSION_PIXELS 4  // gpu/frame/pixel_list_io.h

// occlusion_points: what it shares with ambient_occlusion as there
#define OCCLUSION_POINTS_TARGET 3
#define OCCLUSION_POINTS_ALONE 5  // gpu/frame/pixel_list_io.h

// spread_occlusion
#define SPREAD_OCCLUSION_FRAME 0
#define SPREAD_OCCLUSION_POINTS 1
#define SPREAD_OCCLUSION_TARGET 2
#define SPREAD_OCCLUSION_TILES 3  // gpu/frame/pixel_list_io.h

#endif
