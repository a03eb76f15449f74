// The glow of a lamp in fog or rain: light that the air between eye and surface scatters once.
//
// Sun, Ramamoorthi, Narasimhan and Nayar 2005 (SIGGRAPH), closed form for a point light in even air
// that scatters to all sides alike and absorbs nothing. It needs one function of two numbers,
//   F(u, v) = integral of exp(-u tan q) over q from 0 to v,
// which pictures read from a table (u = kGlowMost t^2, v = pi / 2 s).
#ifndef PETRICHOR_FORMULAS_LIGHT_LAMP_GLOW_H
#define PETRICHOR_FORMULAS_LIGHT_LAMP_GLOW_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kGlowMost = 10.0f;  // F is nothing beyond, but for small v

// F by Simpson's rule, good to 1e-6; v below pi / 2.
SHARED_FN float glow_function(float u, float v)
{
    // The integrand falls within 1 / u of 0: halves of the way are cut where it is steep.
    const float split = min(v, 3.0f / (1.0f + u));
    float sum = 0.0f;
    for (int part = 0; part < 2; ++part) {
        const float from = part == 0 ? 0.0f : split;
        const float width = (part == 0 ? split : v - split) / 32.0f;
        for (int i = 0; i <= 32; ++i) {
            const float weight = i == 0 || i == 32 ? 1.0f : (i & 1) != 0 ? 4.0f : 2.0f;
            const float q = min(from + width * float(i), 1.5707f);
            sum += weight * width / 3.0f * exp(-min(u * sin(q) / max(cos(q), 1.0e-4f), 80.0f));
        }
    }
    return sum;
}

// Where a ray passes a lamp: the angles at which F is read, and what stands before it.
struct GlowRay {
    float u;       // extinction times the ray's least distance to the lamp
    float from_v;  // F is read at from_v and to_v
    float to_v;
    float scale;   // times intensity and the difference of F: radiance
};

// per_m: extinction of the air, all of it scattering. along_m: how far the ray goes before it passes
// the lamp (below 0: it is behind), aside_m: how near, end_m: how far it goes at all.
SHARED_FN GlowRay glow_ray(float per_m, float along_m, float aside_m, float end_m)
{
    const float aside = max(aside_m, 1.0e-3f);
    GlowRay ray;
    ray.u = per_m * aside;
    ray.from_v = 0.78539816f - 0.5f * atan(along_m / aside);
    ray.to_v = 0.78539816f + 0.5f * atan((end_m - along_m) / aside);
    ray.scale = per_m * exp(min(-per_m * along_m, 60.0f)) / (6.2831853f * aside);
    return ray;
}

SHARED_END

#endif
