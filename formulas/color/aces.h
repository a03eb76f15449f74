// The reference rendering and sRGB output of ACES 1, fitted: a rational curve between two matrices
// that stand for its move into the working primaries and back (Hill 2016, BakingLab). Darker and of
// more contrast than the other curves: 0.18 becomes 0.106; 0.18 / 0.6 0.2, as the seven stops of
// its own viewing condition have it.
#ifndef PETRICHOR_FORMULAS_COLOR_ACES_H
#define PETRICHOR_FORMULAS_COLOR_ACES_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_FN float aces_channel(float x)
{
    const float y = max(x, 0.0f);
    return max(
        (y * (y + 0.0245786f) - 0.000090537f) / (y * (0.983729f * y + 0.4329510f) + 0.238081f),
        0.0f);
}

// Linear display light, 0..1, for exposed linear Rec.709.
SHARED_FN vec3 aces(vec3 exposed)
{
    const vec3 c = vec3(dot(exposed, vec3(0.59719f, 0.35458f, 0.04823f)),
                        dot(exposed, vec3(0.07600f, 0.90834f, 0.01566f)),
                        dot(exposed, vec3(0.02840f, 0.13383f, 0.83777f)));
    const vec3 t = vec3(aces_channel(c.x), aces_channel(c.y), aces_channel(c.z));
    const vec3 shown = vec3(dot(t, vec3(1.60475f, -0.53108f, -0.07367f)),
                            dot(t, vec3(-0.10208f, 1.10813f, -0.00605f)),
                            dot(t, vec3(-0.00327f, -0.07276f, 1.07602f)));
    return vec3(clamp(shown.x, 0.0f, 1.0f), clamp(shown.y, 0.0f, 1.0f), clamp(shown.z, 0.0f, 1.0f));
}

SHARED_END

#endif
