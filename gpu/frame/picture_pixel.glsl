// Behind `frame`: the pixel of the picture that a pixel of this window of it is.
#ifndef PETRICHOR_PICTURE_PIXEL_GLSL
#define PETRICHOR_PICTURE_PIXEL_GLSL

#include "gpu/frame/window_io.h"

ivec2 picture_pixel(ivec2 texel)
{
    return texel + window_corner_px(frame.cascade_end_m.w);
}

#endif
