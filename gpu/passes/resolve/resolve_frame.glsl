// What a drawn resolve reads of the frame, and how it comes with its vertices.
#ifndef PETRICHOR_RESOLVE_FRAME_GLSL
#define PETRICHOR_RESOLVE_FRAME_GLSL

struct ResolveFrame {
    ivec2 size;
    uint flags;
    float samples;
    float bloom;
    float wet_lens;
    float time_s;
    vec3 white_gains;
};

#define RESOLVE_FRAME_WORDS(WAY_)         \
    layout(location = 0) flat WAY_ ivec3 size_flags; \
    layout(location = 1) flat WAY_ vec4 lens;        \
    layout(location = 2) flat WAY_ vec4 gains_exposure;

#endif
