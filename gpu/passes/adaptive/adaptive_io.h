// Interface of the passes that leave out samples which would say what is known.
//
//   adaptive_first   keeps what the first sample saw: draw, depth, light
//   adaptive_settle  calm pixels: the second sample saw the same surface in nearly the same light
//   adaptive_ask     a later sample: calm pixels take the mean of the two, the others are listed
#ifndef PETRICHOR_GPU_PASSES_ADAPTIVE_ADAPTIVE_IO_H
#define PETRICHOR_GPU_PASSES_ADAPTIVE_ADAPTIVE_IO_H

#include "base/interop.h"

#define ADAPTIVE_TILE 8
#define ADAPTIVE_RESTLESS 0xffffffffu  // in place of the draw: every sample is shaded

#define ADAPTIVE_FIRST_FRAME 0
#define ADAPTIVE_FIRST_IDS 1
#define ADAPTIVE_FIRST_DEPTH 2
#define ADAPTIVE_FIRST_LIT 3    // the sum of samples
#define ADAPTIVE_FIRST_SEEN 4   // out: draw, depth in m
#define ADAPTIVE_FIRST_LIGHT 5  // out

#define ADAPTIVE_SETTLE_FRAME 0
#define ADAPTIVE_SETTLE_SKY_LIGHT 1
#define ADAPTIVE_SETTLE_IDS 2
#define ADAPTIVE_SETTLE_DEPTH 3
#define ADAPTIVE_SETTLE_LIT 4
#define ADAPTIVE_SETTLE_LIGHT 5  // of the first sample
#define ADAPTIVE_SETTLE_SEEN 6   // in: as above; out: draw or ADAPTIVE_RESTLESS, two depths as halves
#define ADAPTIVE_SETTLE_MEAN 7   // out: light of both
#define ADAPTIVE_SETTLE_SPEC_SUM 0  // 1: the first sample's light is part of what is lit

#define ADAPTIVE_ASK_FRAME 0
#define ADAPTIVE_ASK_IDS 1
#define ADAPTIVE_ASK_DEPTH 2
#define ADAPTIVE_ASK_SEEN 3
#define ADAPTIVE_ASK_MEAN 4
#define ADAPTIVE_ASK_LIT 5    // calm pixels are added
#define ADAPTIVE_ASK_ASKED 6  // two words a tile: pixels that are shaded
#define ADAPTIVE_ASK_LIST 7   // gpu/frame/pixel_list_io.h

SHARED_BEGIN

struct AdaptiveSettleParams {
    float threshold;  // of the display, 0..1
};

SHARED_END

#endif
