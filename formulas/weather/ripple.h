// Rings that rain drops draw on standing water, and the phases of flowing water.
//
// One text for C++ and GLSL. Source: Lux 2.02 (docs/lux.md, 6).
#ifndef PETRICHOR_FORMULAS_WEATHER_RIPPLE_H
#define PETRICHOR_FORMULAS_WEATHER_RIPPLE_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST int kRippleLayers = 4;
SHARED_CONST float kRippleBirths_per_s = 1.6f;  // of each drop's place in the map, times ripple_rate

struct RippleLayer {
    float weight;  // 0..1, how much of this layer the rain intensity calls for
    float clock;   // 0..1, phase common to the drops of the layer
    float begun;   // how often that phase has come around
    vec2 offset;   // of the texture coordinate
};

SHARED_FN float ripple_rate(int layer)
{
    return layer == 0 ? 1.00f : layer == 1 ? 0.85f : layer == 2 ? 0.93f : 1.13f;
}

// layer 0..3, rain 0..1, time in seconds, speed 1 = as photographed.
SHARED_FN RippleLayer ripple_layer(int layer, float rain, float time_s, float speed)
{
    const float threshold = 0.25f * float(layer);
    const float phase = layer == 0 ? 0.00f : layer == 1 ? 0.20f : layer == 2 ? 0.45f : 0.70f;
    RippleLayer result;
    result.weight = clamp(4.0f * (rain - threshold), 0.0f, 1.0f);
    const float turns = kRippleBirths_per_s * (time_s * speed * ripple_rate(layer) + phase);
    result.clock = fract(turns);
    result.begun = floor(turns);
    result.offset = layer == 0   ? vec2(0.25f, 0.00f)
                    : layer == 1 ? vec2(-0.55f, 0.30f)
                    : layer == 2 ? vec2(0.60f, 0.85f)
                                 : vec2(0.50f, -0.75f);
    return result;
}

// Slope that one drop adds: the rain source texel is (envelope, direction encoded 0.5 + 0.5 d in y
// and z, time offset).
SHARED_FN vec2 ripple_slope(vec4 source, float clock, float weight)
{
    const float age = fract(source.w + clock);
    const float front = age - 1.0f + source.x;
    const float fade = clamp(0.2f + 0.8f * weight - age, 0.0f, 1.0f);
    const float height = fade * source.x * sin(3.14159265f * clamp(9.0f * front, 0.0f, 3.0f));
    return vec2(2.0f * source.y - 1.0f, 2.0f * source.z - 1.0f) * height;
}

// Rings of a texel of the map that is drawn: its normal's x and y, and the mean of x^2 + y^2 within it.
struct RingSlopes {
    vec2 lean;
    float square;
};

// What four texels are together, as in LEAN mapping (Olano and Baker 2010). The first level has no square but that of
// its normals: close up all of them are seen.
SHARED_FN RingSlopes rings_of_four(RingSlopes a, RingSlopes b, RingSlopes c, RingSlopes d)
{
    RingSlopes all;
    all.lean = 0.25f * (a.lean + b.lean + c.lean + d.lean);
    all.square = 0.25f * (max(a.square, dot(a.lean, a.lean)) + max(b.square, dot(b.lean, b.lean)) + max(c.square, dot(c.lean, c.lean)) +
                          max(d.square, dot(d.lean, d.lean)));
    return all;
}

// In twice eight bits. They are read from one texel: a CPU mixes eight bits as eight bits.
SHARED_FN vec2 rings_square_code(float square)
{
    const float codes = 255.0f * clamp(square, 0.0f, 1.0f);
    return vec2(floor(codes) / 255.0f, codes - floor(codes));
}
SHARED_FN float rings_square_of(vec2 code) { return code.x + code.y / 255.0f; }

// Variance of the slopes of water that its normal does not show, of both axes together.
//   square, lean  of the map, both with strength and share of the rings in them
//   fade          how far rings are drawn at all
SHARED_FN float rings_unseen(float square, vec2 lean, float fade)
{
    return max(square - fade * fade * dot(lean, lean), 0.0f);
}

struct FlowPhases {
    float first;   // 0..1
    float second;  // half a period apart
    float blend;   // 0: only the first shows .. 1: only the second: each hides where it jumps
};

// interval_s: period of a phase; 0 is taken as a still surface.
SHARED_FN FlowPhases flow_phases(float time_s, float interval_s)
{
    const float t = interval_s > 0.0f ? time_s / interval_s : 0.0f;
    FlowPhases phases;
    phases.first = fract(t);
    phases.second = fract(t + 0.5f);
    phases.blend = abs(2.0f * phases.first - 1.0f);
    return phases;
}

SHARED_END

#endif
