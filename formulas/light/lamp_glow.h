// The glow of a lamp in fog or rain: light that the air between eye and surface scatters once.
//
// Sun, Ramamoorthi, Narasimhan and Nayar 2005 (SIGGRAPH), closed form for a point light in even air
// that scatters to all sides alike and absorbs nothing. Theirs is a difference of two values of
//   F(u, v) = integral of exp(-u tan q) over q from 0 to v
// before a factor that grows without bound for lamps behind the eye. The same with
//   T(u, v) = integral of exp(-u (tan q - tan v)) over q from v to pi / 2
// has no such factor; F(u, v) = T(u, 0) - exp(-u tan v) T(u, v). Pictures read T from a table
// (u = kGlowMost t^2, v = pi / 2 s).
#ifndef PETRICHOR_FORMULAS_LIGHT_LAMP_GLOW_H
#define PETRICHOR_FORMULAS_LIGHT_LAMP_GLOW_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kGlowMost = 10.0f;

// T by Simpson's rule, good to 1e-5 of itself.
SHARED_FN float glow_tail(float u, float v)
{
    const float whole = 1.5707963f - v;
    if (whole <= 0.0f) return 0.0f;
    const float c = max(cos(v), 1.0e-6f);
    // Cut where it is steep: it falls to 1/e within c^2 / u, and to nothing within about u of its end.
    const float steep = min(0.5f * whole, c * c / max(u, 1.0e-4f));
    float sum = 0.0f;
    float from = 0.0f;
    for (int part = 0; part < 4; ++part) {
        const float to = part == 0   ? steep
                         : part == 1 ? min(6.0f * steep, 0.8f * whole)
                         : part == 2 ? max(0.8f * whole, whole - 6.0f * u)
                                     : whole;
        const float width = (to - from) / 32.0f;
        for (int i = 0; i <= 32; ++i) {
            const float weight = i == 0 || i == 32 ? 1.0f : (i & 1) != 0 ? 4.0f : 2.0f;
            const float q = from + width * float(i);
            const float rise = sin(q) / (c * max(sin(whole - q), 1.0e-7f));  // tan (v + q) - tan v
            sum += weight * width / 3.0f * exp(-min(u * rise, 80.0f));
        }
        from = to;
    }
    return sum;
}

// Where a ray begins and ends as a lamp sees it.
struct GlowRay {
    float u;           // extinction times the ray's least distance to the lamp: T is read at u and ..
    float begin_v;     // .. these
    float end_v;
    float begin;       // radiance of a lamp of 1 cd: begin T(u, begin_v) - end T(u, end_v)
    float end;
};

// per_m: extinction of the air, all of it scattering. along_m: how far the ray goes before it passes
// the lamp (below 0: it is behind), aside_m: how near, end_m: how far it goes at all.
SHARED_FN GlowRay glow_ray(float per_m, float along_m, float aside_m, float end_m)
{
    const float aside = max(aside_m, 1.0e-3f);
    const float from_lamp = sqrt(aside * aside + along_m * along_m);
    const float beyond = end_m - along_m;
    const float to_lamp = sqrt(aside * aside + beyond * beyond);
    const float scale = per_m / (6.2831853f * aside);
    GlowRay ray;
    ray.u = per_m * aside;
    ray.begin_v = 0.78539816f - 0.5f * atan(along_m / aside);
    ray.end_v = 0.78539816f + 0.5f * atan(beyond / aside);
    ray.begin = scale * exp(-per_m * from_lamp);
    ray.end = scale * exp(-per_m * (end_m + to_lamp));
    return ray;
}

SHARED_END

#endif
