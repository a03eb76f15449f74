// Constants of a uniform block, read by all lanes of a CPU at once. Such a driver gathers every constant for each of its
// lanes, with a check against the end of the block, some thirty instructions a word, though all lanes read the same one.
// So each lane reads another word here, and the others take it from there: two instructions, for the same bits.
//
// Before the include: a constant LANES, the size of the subgroup, all lanes of which begin the shader; 0: the block is
// read as it is. LANE_WORDS(name, count) defines name_take for a block of `count` words name_words.
#ifndef PETRICHOR_LANE_WORDS_GLSL
#define PETRICHOR_LANE_WORDS_GLSL

#define LANE_WORDS(name, count)                                                                                    \
    uint name##_word(int i)                                                                                        \
    {                                                                                                              \
        const int lanes = int(LANES);                                                                              \
        const int mine = min(i - i % lanes + int(gl_SubgroupInvocationID), count - 1);                             \
        return subgroupShuffle(name##_words[mine], uint(i % lanes));                                               \
    }                                                                                                              \
    void name##_take(inout int at, out uint v) { v = name##_word(at++); }                                          \
    void name##_take(inout int at, out int v) { v = int(name##_word(at++)); }                                      \
    void name##_take(inout int at, out float v) { v = uintBitsToFloat(name##_word(at++)); }                        \
    void name##_take(inout int at, out ivec2 v)                                                                    \
    {                                                                                                              \
        name##_take(at, v.x);                                                                                      \
        name##_take(at, v.y);                                                                                      \
    }                                                                                                              \
    void name##_take(inout int at, out vec2 v)                                                                     \
    {                                                                                                              \
        name##_take(at, v.x);                                                                                      \
        name##_take(at, v.y);                                                                                      \
    }                                                                                                              \
    void name##_take(inout int at, out vec3 v)                                                                     \
    {                                                                                                              \
        name##_take(at, v.x);                                                                                      \
        name##_take(at, v.y);                                                                                      \
        name##_take(at, v.z);                                                                                      \
    }                                                                                                              \
    void name##_take(inout int at, out vec4 v)                                                                     \
    {                                                                                                              \
        name##_take(at, v.x);                                                                                      \
        name##_take(at, v.y);                                                                                      \
        name##_take(at, v.z);                                                                                      \
        name##_take(at, v.w);                                                                                      \
    }                                                                                                              \
    void name##_take(inout int at, out mat4 v)                                                                     \
    {                                                                                                              \
        name##_take(at, v[0]);                                                                                     \
        name##_take(at, v[1]);                                                                                     \
        name##_take(at, v[2]);                                                                                     \
        name##_take(at, v[3]);                                                                                     \
    }

#endif
