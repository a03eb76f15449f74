// Interface of the draws that fill depth maps.
#ifndef PETRICHOR_GPU_PASSES_DEPTH_MAPS_DEPTH_MAPS_IO_H
#define PETRICHOR_GPU_PASSES_DEPTH_MAPS_DEPTH_MAPS_IO_H

// 1: casters before the near plane are kept, flattened onto it; 0: they cast nothing
#define DEPTH_SPEC_FLATTEN 0

#endif
