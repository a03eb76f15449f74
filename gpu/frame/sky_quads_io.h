// The quads of the sky's maps: those of sky_specular, then those of one level of sky_cube.
#ifndef PETRICHOR_GPU_FRAME_SKY_QUADS_IO_H
#define PETRICHOR_GPU_FRAME_SKY_QUADS_IO_H

#define SKY_SPECULAR_LOG2 6  // texels a side of its first level; the last has 2
#define SKY_AIR_MIP 5        // of sky_cube: what the air of a view takes its light from
#define SKY_AIR_SIDE 12      // texels a side of that level
#define SKY_AIR_QUADS 34308  // where its quads begin
#define SKY_QUADS (SKY_AIR_QUADS + 6 * (SKY_AIR_SIDE + 1) * (SKY_AIR_SIDE + 1))

#endif
