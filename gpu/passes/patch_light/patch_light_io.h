// Interface of the pass that means the sky over its bins.
#ifndef PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_LIGHT_IO_H
#define PETRICHOR_GPU_PASSES_PATCH_LIGHT_PATCH_LIGHT_IO_H

#define SKY_BINS_GROUP 64
#define SKY_BINS_SOURCE 0
#define SKY_BINS_TARGET 1
#define SKY_BINS_MIP 2  // of the cube: 96 texels a side, three or four a bin

#endif
