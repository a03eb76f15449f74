// Blocks of two by two pixels, and those of a tile.
#ifndef PETRICHOR_OCCLUSION_BLOCKS_GLSL
#define PETRICHOR_OCCLUSION_BLOCKS_GLSL
#include "gpu/frame/occlusion_blocks_io.h"

// Where a block is in rows of blocks.
int occlusion_block(ivec2 block, ivec2 size)
{
    return block.y * ((size.x + OCCLUSION_BLOCK - 1) / OCCLUSION_BLOCK) + block.x;
}

// Behind the words of all blocks lie bent normals: of pixels in 16 bits each, two words a block.
int bent_word(ivec2 texel, ivec2 size)
{
    const ivec2 blocks = (size + OCCLUSION_BLOCK - 1) / OCCLUSION_BLOCK;
    return blocks.x * blocks.y + 2 * occlusion_block(texel / OCCLUSION_BLOCK, size) + (texel.y & 1);
}

// .. and of points in a word each behind their two.
int bent_point_word(ivec2 block, ivec2 size)
{
    const ivec2 blocks = (size + OCCLUSION_BLOCK - 1) / OCCLUSION_BLOCK;
    return 2 * blocks.x * blocks.y + occlusion_block(block, size);
}

ivec2 block_of_tile(ivec2 tile, int index)
{
    return tile * OCCLUSION_TILE + ivec2(index % OCCLUSION_TILE, index / OCCLUSION_TILE);
}

#endif
