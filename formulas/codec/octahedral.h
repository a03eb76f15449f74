// Unit vectors in two numbers of -1..1 (octahedral map: Cigolle et al. 2014).
#ifndef PETRICHOR_FORMULAS_CODEC_OCTAHEDRAL_H
#define PETRICHOR_FORMULAS_CODEC_OCTAHEDRAL_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_FN vec2 octahedral_encode(vec3 n)
{
    const float scale = 1.0f / (abs(n.x) + abs(n.y) + abs(n.z));
    const vec2 p = vec2(n.x * scale, n.z * scale);
    if (n.y >= 0.0f) return p;
    return vec2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
                (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
}

SHARED_FN vec3 octahedral_decode(vec2 p)
{
    vec3 n = vec3(p.x, 1.0f - abs(p.x) - abs(p.y), p.y);
    const float fold = max(-n.y, 0.0f);
    n.x += n.x >= 0.0f ? -fold : fold;
    n.z += n.z >= 0.0f ? -fold : fold;
    return normalize(n);
}

SHARED_END

#endif
