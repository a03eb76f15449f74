// AgX (Sobotka 2022): a picture formed in the logarithm of light, from 10 stops below middle grey
// to 6.5 above it, with the primaries drawn in first, so that bright colours bleach on the way to
// white. Matrices for linear Rec.709 as common ports have them.
//
// The curve is the pair of hyperbolas of its generator: slope 2.4 at middle grey, toe and shoulder
// of power 1.5, through (0, 0), (pivot, 0.18^(1/2.4)) and (1, 1). Its code is for a display of
// gamma 2.4: 0.18 stays 0.18.
#ifndef PETRICHOR_FORMULAS_COLOR_AGX_H
#define PETRICHOR_FORMULAS_COLOR_AGX_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kAgxSlope = 2.4f;
SHARED_CONST float kAgxPower = 1.5f;
SHARED_CONST float kAgxPivot = 0.60606061f;      // 10 of 16.5 stops
SHARED_CONST float kAgxPivotCode = 0.48943709f;  // 0.18^(1/2.4)

// How far a hyperbola reaches, so that it ends in a corner `x` to the side of the pivot and `y`
// above.
SHARED_FN float agx_reach(float x, float y)
{
    const float rise = pow(kAgxSlope * x / y, kAgxPower) - 1.0f;
    return kAgxSlope * x * pow(rise, -1.0f / kAgxPower);
}

// Code of 0..1 for a place of 0..1 on the logarithmic axis.
SHARED_FN float agx_curve(float x)
{
    const bool toe = x < kAgxPivot;
    const float reach = toe ? agx_reach(kAgxPivot, kAgxPivotCode)
                            : agx_reach(1.0f - kAgxPivot, 1.0f - kAgxPivotCode);
    const float t = kAgxSlope * abs(x - kAgxPivot) / reach;
    const float rise = reach * t / pow(1.0f + pow(t, kAgxPower), 1.0f / kAgxPower);
    return clamp(toe ? kAgxPivotCode - rise : kAgxPivotCode + rise, 0.0f, 1.0f);
}

SHARED_FN float agx_channel(float light)
{
    const float stops = log2(max(light, 1.0e-10f) / 0.18f);
    return agx_curve(clamp((stops + 10.0f) / 16.5f, 0.0f, 1.0f));
}

// Linear display light, 0..1, for exposed linear Rec.709.
SHARED_FN vec3 agx(vec3 exposed)
{
    const vec3 c = vec3(max(exposed.x, 0.0f), max(exposed.y, 0.0f), max(exposed.z, 0.0f));
    const vec3 drawn = vec3(dot(c, vec3(0.8424791f, 0.0784336f, 0.0792237f)),
                            dot(c, vec3(0.0423282f, 0.8784686f, 0.0791661f)),
                            dot(c, vec3(0.0423757f, 0.0784336f, 0.8791430f)));
    const vec3 code = vec3(agx_channel(drawn.x), agx_channel(drawn.y), agx_channel(drawn.z));
    const vec3 shown = vec3(dot(code, vec3(1.1968790f, -0.0980209f, -0.0990297f)),
                            dot(code, vec3(-0.0528969f, 1.1519031f, -0.0989612f)),
                            dot(code, vec3(-0.0529716f, -0.0980435f, 1.1510737f)));
    return vec3(pow(clamp(shown.x, 0.0f, 1.0f), 2.4f), pow(clamp(shown.y, 0.0f, 1.0f), 2.4f),
                pow(clamp(shown.z, 0.0f, 1.0f), 2.4f));
}

SHARED_END

#endif
