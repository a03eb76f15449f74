// How what is steep (steep_triangles.h) is marked in the table of draws and in the ids of a visibility buffer.
#ifndef PETRICHOR_GPU_UPLOAD_STEEP_IO_H
#define PETRICHOR_GPU_UPLOAD_STEEP_IO_H

// Beside a draw's material, where all its triangles are: dry, and upright as well.
#define DRAW_DRY 0x80000000u
#define DRAW_UPRIGHT 0x40000000u
#define DRAW_MATERIAL 0x3fffffffu
// Beside the number of a draw, where one triangle is what the frame asks for.
#define ID_STEEP 0x80000000u
#define ID_DRAW 0x7fffffffu

#endif
