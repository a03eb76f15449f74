// The PBR Neutral tone mapper of Khronos (2024): base colours under grey light come out as they
// went in, up to 0.8 less the 4 % that a dielectric reflects; only highlights are compressed, and
// bleached.
#ifndef PETRICHOR_FORMULAS_COLOR_KHRONOS_NEUTRAL_H
#define PETRICHOR_FORMULAS_COLOR_KHRONOS_NEUTRAL_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kNeutralF90 = 0.04f;         // what is taken off: reflection at normal incidence
SHARED_CONST float kNeutralCompressed = 0.76f;  // 0.8 - 0.04: brighter peaks are compressed
SHARED_CONST float kNeutralBleach = 0.15f;

// Linear display light, 0..1, for exposed linear Rec.709.
SHARED_FN vec3 khronos_neutral(vec3 exposed)
{
    const vec3 c = vec3(max(exposed.x, 0.0f), max(exposed.y, 0.0f), max(exposed.z, 0.0f));
    const float low = min(c.x, min(c.y, c.z));
    const float f = 2.0f * kNeutralF90;
    const float offset = low < f ? low - low * low / (4.0f * kNeutralF90) : kNeutralF90;
    const vec3 base = c - splat3(offset);
    const float peak = max(base.x, max(base.y, base.z));
    if (peak < kNeutralCompressed) return base;
    const float room = 1.0f - kNeutralCompressed;
    const float new_peak = 1.0f - room * room / (peak + room - kNeutralCompressed);
    const float bleach = 1.0f - 1.0f / (kNeutralBleach * (peak - new_peak) + 1.0f);
    return mix(base * (new_peak / peak), splat3(new_peak), bleach);
}

SHARED_END

#endif
