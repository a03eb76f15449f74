// Interface of the pass that keeps a small picture.
#ifndef PETRICHOR_GPU_PASSES_REFLECTIONS_KEEP_AROUND_IO_H
#define PETRICHOR_GPU_PASSES_REFLECTIONS_KEEP_AROUND_IO_H

#define KEEP_AROUND_TILE 8

#define KEEP_AROUND_FRAME 0
#define KEEP_AROUND_DEPTH 1
#define KEEP_AROUND_RADIANCE 2
#define KEEP_AROUND_EMISSION 3
#define KEEP_AROUND_TO_DEPTH 4  // a word a pixel, row by row
#define KEEP_AROUND_TO_LIGHT 5  // two: halves
#define KEEP_AROUND_TO_GLOW 6

#define KEEP_AROUND_SPEC_GLOWS 0  // 1: something glows

#endif
