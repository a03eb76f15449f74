// How one draw call of many instances finds the constants of each.
#ifndef PETRICHOR_GPU_PASSES_SURFACE_SURFACE_DRAWS_IO_H
#define PETRICHOR_GPU_PASSES_SURFACE_SURFACE_DRAWS_IO_H

#include "gpu/passes/surface/surface_io.h"

#define SURFACE_SPEC_INSTANCED 38  // 1: the instance is the number of a draw
// Behind those of layers, for which others have stand-ins: DrawConstants of all draws, in texels of four words.
#define SURFACE_DRAWS (SURFACE_BINDINGS + 2)
#define SURFACE_DRAW_TEXELS 7
// Of vertices that lamps light; the instance is the number of a draw then, too.
#define SURFACE_LIT_VERTICES (SURFACE_BINDINGS + 3)
#define SURFACE_LIT_FIRSTS (SURFACE_BINDINGS + 4)

#endif
