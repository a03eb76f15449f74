// Where what falls comes from, in texels behind the states of patches (place_io.h): FallConstants by number, without how far
// off the surface, which is the same for all. GpuPlace::set_falls writes them, passes/surface/shelter.glsl reads them.
//
//   0  column    1  row    2  depth    3  level, rain    4  snow, layer, -, -
#ifndef PETRICHOR_GPU_FRAME_PLACE_FALLS_IO_H
#define PETRICHOR_GPU_FRAME_PLACE_FALLS_IO_H

#define PLACE_FALL_TEXELS 5

#endif
