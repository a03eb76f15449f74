// What is seen through a round body of clear ice that hangs: rays are bent where they enter and where they leave its circular
// section (Snell), and lose what both sides mirror (Schlick 1994). Near its sides that is what lies far beside it, so an
// icicle shows its surroundings small, the other way round and streaked along it. Its core is cloudy with bubbles (ours, by eye).
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_LIGHT_CLEAR_ICE_H
#define PETRICHOR_FORMULAS_LIGHT_CLEAR_ICE_H

#include "base/interop.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

SHARED_CONST float kIceIndex = 1.31f;
SHARED_CONST float kIceCloud = 0.3f;  // of what goes through the core is lost to bubbles

struct SeenThroughIce {
    vec3 way;       // of the ray behind the ice, unit
    float through;  // share of what comes from there
    float chord;    // way of the ray in the level section, in radii: 0..2
};

// By Snell's law, where eta is the index before the side over that behind; zero where all is mirrored. `n` against the ray.
SHARED_FN vec3 bent_ray(vec3 ray, vec3 n, float eta)
{
    const float c = -dot(ray, n);
    const float k = 1.0f - eta * eta * (1.0f - c * c);
    if (k < 0.0f) return splat3(0.0f);
    return ray * eta + n * (eta * c - sqrt(k));
}

// view: of a ray that meets the ice, unit; n: of the ice there, unit, against the ray. Its axis is the plumb line; what looks
// up or down, as a tip, is part of a ball.
SHARED_FN SeenThroughIce seen_through_ice(vec3 view, vec3 n)
{
    const float across = max(-dot(view, n), 0.0f);
    const float grazing = (1.0f - across) * (1.0f - across);
    const float f0 = (kIceIndex - 1.0f) / (kIceIndex + 1.0f) * ((kIceIndex - 1.0f) / (kIceIndex + 1.0f));
    const float mirrored = f0 + (1.0f - f0) * grazing * grazing * (1.0f - across);
    const vec3 inside = bent_ray(view, n, 1.0f / kIceIndex);
    // The side that it leaves by has the normal of this one, turned about the axis.
    const float level = sqrt(n.x * n.x + n.z * n.z);
    const float along = sqrt(inside.x * inside.x + inside.z * inside.z);
    float chord = 2.0f * max(-dot(inside, n), 0.0f);
    vec3 other = n - inside * (2.0f * dot(inside, n));
    if (level > 0.3f && along > 0.05f) {
        const float turned = (n.x * inside.x + n.z * inside.z) / (level * along);
        const float back = -2.0f * turned * level / along;
        other = vec3(n.x + inside.x * back, n.y, n.z + inside.z * back);
        chord = clamp(-2.0f * turned, 0.0f, 2.0f);
    }
    const vec3 left_by = bent_ray(inside, -other, kIceIndex);
    SeenThroughIce seen;
    // What is mirrored inside leaves elsewhere: about ahead.
    seen.way = normalize(dot(left_by, left_by) > 0.5f ? left_by : inside);
    seen.through = (1.0f - mirrored) * (1.0f - mirrored) * (1.0f - kIceCloud * smooth_edge(1.0f, 2.0f, chord));
    seen.chord = chord;
    return seen;
}

SHARED_END

#endif
