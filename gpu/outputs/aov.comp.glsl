#version 460
// Labelled outputs from the G-buffer of the pixel-centre sample: every row of the table that is asked
// for, one image behind the other.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "gpu/outputs/aov_io.h"
#include "gpu/outputs/aov_table_io.h"
#define GBUFFER_FIRST_BINDING AOV_GBUFFER
#include "gpu/frame/gbuffer_read.glsl"

layout(local_size_x = AOV_TILE, local_size_y = AOV_TILE) in;
layout(constant_id = AOV_SPEC_ROWS_LOW) const uint ROWS_LOW = 0xffffffffu;
layout(constant_id = AOV_SPEC_ROWS_HIGH) const uint ROWS_HIGH = 0xffffffffu;
layout(constant_id = AOV_SPEC_HAS_WEATHER) const uint HAS_WEATHER = 1u;
layout(constant_id = AOV_SPEC_HAS_EMISSION) const uint HAS_EMISSION = 1u;
layout(constant_id = AOV_SPEC_HAS_BAKED) const uint HAS_BAKED = 1u;
layout(binding = AOV_FRAME, scalar) uniform Frame { FrameConstants frame; };
layout(binding = AOV_OUTPUT, scalar) writeonly buffer Output { float values[]; };

// What a row's value is made from.
struct AovPoint {
    float depth;    // as in the depth buffer
    vec3 position;  // world, metres
    GBufferTexel g;
};

#define kInfinity uintBitsToFloat(0x7f800000u)  // no constant expression in GLSL

bool asked(uint row)
{
    return (((row < 32u ? ROWS_LOW : ROWS_HIGH) >> (row & 31u)) & 1u) != 0u;
}

vec4 wide(float v) { return vec4(v, 0.0, 0.0, 0.0); }
vec4 wide(vec2 v) { return vec4(v, 0.0, 0.0); }
vec4 wide(vec3 v) { return vec4(v, 0.0); }
vec4 wide(vec4 v) { return v; }

void main()
{
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, frame.size))) return;
    AovPoint p;
    p.depth = texelFetch(depth_map, texel, 0).r;
    const bool surface = p.depth > 0.0;
    p.position = pixel_position(frame, vec2(texel) + 0.5, max(p.depth, 1.0e-9));
    p.g = decode_gbuffer(
        fetch_gbuffer(texel, HAS_WEATHER != 0u, HAS_EMISSION != 0u, HAS_BAKED != 0u));

    const uint pixels = uint(frame.size.x * frame.size.y);
    const uint pixel = uint(texel.y * frame.size.x + texel.x);
    uint row = 0u;
    uint before = 0u;  // numbers a pixel of the rows before
#define ROW(name_, count_, channels_, unit_, precision_, meaning_, value_, background_)  \
    if (asked(row)) {                                                                    \
        vec4 value = vec4(background_);                                                  \
        if (surface) value = wide(value_);                                               \
        for (uint i = 0u; i < count_; ++i) {                                             \
            values[before * pixels + pixel * count_ + i] = value[i];                     \
        }                                                                                \
        before += count_;                                                                \
    }                                                                                    \
    ++row;
    AOV_TABLE(ROW)
#undef ROW
}
