// Blocks of pixels that share a search for occlusion (formulas/light/occlusion_points.h).
#ifndef PETRICHOR_GPU_FRAME_OCCLUSION_BLOCKS_IO_H
#define PETRICHOR_GPU_FRAME_OCCLUSION_BLOCKS_IO_H

#define OCCLUSION_BLOCK 2  // pixels along a side
#define OCCLUSION_TILE 4   // blocks along the side of a tile of PIXEL_LIST_TILE
// A CPU's lanes lie along x: eight of them, though a tile is four blocks wide.
#define OCCLUSION_LANES 8
#define OCCLUSION_ROWS 2

#endif
