// Where a window of a picture begins, in a float of the frame's constants (cascade_end_m.w): what is drawn by chance goes by
// the pixel of the picture, so that its grain goes on from tile to tile.
#ifndef PETRICHOR_GPU_FRAME_WINDOW_IO_H
#define PETRICHOR_GPU_FRAME_WINDOW_IO_H

#include "base/interop.h"

#define WINDOW_STEP 32  // windows begin at multiples of it
#define WINDOW_BITS 9   // of such steps, for each side of 16384 pixels

SHARED_BEGIN

// corner_px: multiples of WINDOW_STEP; exact, as a float holds 24 bits.
SHARED_FN float window_code(ivec2 corner_px)
{
    const int mask = (1 << WINDOW_BITS) - 1;
    return float((corner_px.x / WINDOW_STEP & mask) | (corner_px.y / WINDOW_STEP & mask) << WINDOW_BITS);
}

SHARED_FN ivec2 window_corner_px(float code)
{
    const int at = int(code);
    const int mask = (1 << WINDOW_BITS) - 1;
    return ivec2(at & mask, at >> WINDOW_BITS) * WINDOW_STEP;
}

SHARED_END

#endif
