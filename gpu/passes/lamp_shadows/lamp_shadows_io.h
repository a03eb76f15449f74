// The maps of lamps' shadows: six layers a lamp, the faces of a cube around it (order and axes as
// in formulas/light/cube_map.h).
#ifndef PETRICHOR_GPU_PASSES_LAMP_SHADOWS_LAMP_SHADOWS_IO_H
#define PETRICHOR_GPU_PASSES_LAMP_SHADOWS_LAMP_SHADOWS_IO_H

#define LAMP_MAP_SIZE 512
#define LAMP_MAP_NEAR_M 0.05f  // what is nearer casts no shadow: it is part of the lamp
#define LANTERN_HALF_M 0.35f   // .. or, of a lamp in a lantern, in its profile (scene/patches/lanterns.h)
// A face covers a little more than its quarter turn, so that filters find texels beyond the edge.
#define LAMP_MAP_COVER (1.0f - 6.0f / 512.0f)

#endif
