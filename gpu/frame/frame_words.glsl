// `frame`, read by all lanes of a CPU at once (lane_words.glsl): read_frame() before its first use, where all lanes are.
// Before the include: extensions GL_KHR_shader_subgroup_basic and _shuffle, FRAME_BY_WORDS before all other includes, and FRAME_PLACE, the set and binding of the block.
#ifndef PETRICHOR_FRAME_WORDS_GLSL
#define PETRICHOR_FRAME_WORDS_GLSL

#include "gpu/frame/frame_words_io.h"

layout(constant_id = FRAME_SPEC_LANES) const uint LANES = 0u;
#include "gpu/frame/lane_words.glsl"

const int kFrameWords = FRAME_WORD_COUNT + SKY_DIRECTIONS * FRAME_FALL_WORDS;

layout(FRAME_PLACE, scalar) uniform Frame {
    FrameConstants frame_block;
    FrameArrays frame_arrays;
};
layout(FRAME_PLACE, scalar) uniform FrameWords { uint frame_words[kFrameWords]; };
FrameConstants frame;

LANE_WORDS(frame, kFrameWords)

void read_frame()
{
    if (LANES == 0u) {
        frame = frame_block;
        return;
    }
    int at = 0;
#define TAKE(type, member) frame_take(at, frame.member);
    FRAME_MEMBERS(TAKE)
#undef TAKE
}

FallConstants fall_of(int k)
{
    if (LANES == 0u) return frame_arrays.falls[k];
    int at = FRAME_WORD_COUNT + FRAME_FALL_WORDS * k;
    FallConstants fall;
    frame_take(at, fall.column);
    frame_take(at, fall.row);
    frame_take(at, fall.depth);
    frame_take(at, fall.lift_m);
    frame_take(at, fall.level);
    frame_take(at, fall.rain);
    frame_take(at, fall.snow);
    frame_take(at, fall.layer);
    return fall;
}

#endif
