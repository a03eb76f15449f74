// Blocks of pixels that share a search for occlusion (formulas/light/occlusion_points.h).
#ifndef PETRICHOR_GPU_FRAME_OCCLUSION_BLOCKS_IO_H
#define PETRICHOR_GPU_FRAME_OCCLUSION_BLOCKS_IO_H

#define OCCLUSION_BLOCK 2  // pixels along a side
#define OCCLUSION_WIDE 8   // blocks along the sides of a tile (gpu/frame/pixel_list_io.h)
#define OCCLUSION_HIGH 2
// A CPU's lanes lie along x: eight of them, though a tile is four blocks wide.
#define OCCLUSION_LANES 8
#define OCCLUSION_ROWS 2

#endif
