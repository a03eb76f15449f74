// Blocks of two by two pixels, and those of a tile.
#ifndef PETRICHOR_OCCLUSION_BLOCKS_GLSL
#define PETRICHOR_OCCLUSION_BLOCKS_GLSL
#include "gpu/frame/occlusion_blocks_io.h"

// Where a block is in rows of blocks.
int occlusion_block(ivec2 block, ivec2 size)
{
    return block.y * ((size.x + OCCLUSION_BLOCK - 1) / OCCLUSION_BLOCK) + block.x;
}

ivec2 block_of_tile(ivec2 tile, int index)
{
    return tile * OCCLUSION_TILE + ivec2(index % OCCLUSION_TILE, index / OCCLUSION_TILE);
}

#endif
