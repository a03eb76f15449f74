// Clear air: single scattering by molecules and haze, absorption by ozone.
//
// One text for C++ and GLSL. Coefficients per metre at sea level, scale heights and the tent of
// ozone between 10 and 40 km are those of Hillaire 2020 (molecules after Bucholtz 1995, heights
// after Bruneton and Neyret 2008); ozone at two fifths of its strength: light scattered more than
// once, which would fill the green it takes, is only sketched here.
#ifndef PETRICHOR_FORMULAS_LIGHT_ATMOSPHERE_H
#define PETRICHOR_FORMULAS_LIGHT_ATMOSPHERE_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kEarthRadius = 6360000.0f;
SHARED_CONST float kAirHeight = 80000.0f;

// Distance along a ray from `height` above the ground to the top of the air; `up` is the cosine
// with the vertical.
SHARED_FN float distance_to_space(float height, float up)
{
    const float r = kEarthRadius + height;
    const float top = kEarthRadius + kAirHeight;
    const float b = r * up;
    return -b + sqrt(max(b * b + top * top - r * r, 0.0f));
}

// Distance to the ground, negative when the ray misses it.
SHARED_FN float distance_to_ground(float height, float up)
{
    const float r = kEarthRadius + height;
    const float b = r * up;
    const float inside = b * b + kEarthRadius * kEarthRadius - r * r;
    if (up >= 0.0f || inside < 0.0f) return -1.0f;
    return -b - sqrt(inside);
}

// Densities relative to sea level: molecules, haze, ozone.
SHARED_FN vec3 air_density(float height)
{
    const float h = max(height, 0.0f);
    return vec3(exp(-h / 8000.0f), exp(-h / 1200.0f),
                max(0.0f, 1.0f - abs(h - 25000.0f) / 15000.0f));
}

SHARED_FN vec3 molecule_scattering()
{
    return vec3(5.802e-6f, 13.558e-6f, 33.1e-6f);
}

SHARED_FN float haze_scattering(float turbidity)
{
    return 2.6e-6f * max(turbidity - 1.0f, 0.0f);
}

// Extinction per metre where the relative densities are `density`.
SHARED_FN vec3 air_extinction(vec3 density, float turbidity)
{
    return molecule_scattering() * density.x + vec3(1.1f * haze_scattering(turbidity) * density.y) +
           vec3(0.260e-6f, 0.752e-6f, 0.034e-6f) * density.z;
}

// Share of light that reaches `height` from space along a direction; 0 behind the earth.
SHARED_FN vec3 air_transmittance(float height, float up, float turbidity)
{
    if (distance_to_ground(height, up) > 0.0f) return vec3(0.0f);
    const float reach = distance_to_space(height, up);
    const float r = kEarthRadius + height;
    vec3 depth = vec3(0.0f);
    const int steps = 12;
    float before = 0.0f;
    for (int i = 1; i <= steps; ++i) {
        // Steps grow with distance: the air is thin far out.
        const float u = float(i) / float(steps);
        const float after = reach * u * u;
        const float middle = 0.5f * (before + after);
        const float h = sqrt(r * r + middle * middle + 2.0f * r * middle * up) - kEarthRadius;
        depth += air_extinction(air_density(h), turbidity) * (after - before);
        before = after;
    }
    return vec3(exp(-depth.x), exp(-depth.y), exp(-depth.z));
}

// Share of scattered light per steradian for molecules (x) and haze (y); c is the cosine of the
// angle.
SHARED_FN vec2 air_phase(float c)
{
    const float g = 0.76f;
    const float g2 = g * g;
    const float base = max(1.0f + g2 - 2.0f * g * c, 1.0e-4f);
    return vec2(0.0596831f * (1.0f + c * c),
                0.1193662f * (1.0f - g2) * (1.0f + c * c) / ((2.0f + g2) * base * sqrt(base)));
}

// Radiance of clear air seen from the ground, W or lm per m2 and sr for sun light given above the
// air.
//   up           cosine of the view direction with the vertical
//   sun_up       the same for the sun
//   sun_angle    cosine between view and sun
SHARED_FN vec3 air_radiance(float up, float sun_up, float sun_angle, vec3 sun_illuminance,
                            float turbidity)
{
    const float eye = 2.0f;
    const float view_up = max(up, 0.005f);
    const float reach = distance_to_space(eye, view_up);
    const float r = kEarthRadius + eye;
    const vec2 phase = air_phase(sun_angle);
    vec3 sum = vec3(0.0f);
    vec3 depth = vec3(0.0f);
    const int steps = 20;
    float before = 0.0f;
    for (int i = 1; i <= steps; ++i) {
        const float u = float(i) / float(steps);
        const float after = reach * u * u;
        const float middle = 0.5f * (before + after);
        const float length_m = after - before;
        const float radius = sqrt(r * r + middle * middle + 2.0f * r * middle * view_up);
        const float h = radius - kEarthRadius;
        const vec3 density = air_density(h);
        const vec3 extinction = air_extinction(density, turbidity);
        // Cosine of the sun at that place: the vertical turns along the ray.
        const float local_sun = clamp((r * sun_up + middle * sun_angle) / radius, -1.0f, 1.0f);
        const vec3 sun = air_transmittance(h, local_sun, turbidity);
        const vec3 t = depth + extinction * (0.5f * length_m);
        const vec3 to_eye = vec3(exp(-t.x), exp(-t.y), exp(-t.z));
        const vec3 single = molecule_scattering() * (density.x * phase.x) +
                            vec3(haze_scattering(turbidity) * density.y * phase.y);
        // Light scattered more than once, nearly the same from all sides.
        const vec3 again =
            (molecule_scattering() * density.x + vec3(haze_scattering(turbidity) * density.y)) *
            (0.0795775f * 0.45f);
        const float dusk = clamp(0.5f + 4.0f * local_sun, 0.0f, 1.0f);
        // Its colour is that of the air above: blue, and blue still when the sun has gone.
        const vec3 glow = vec3(0.08f, 0.13f, 0.20f) * (dusk * dusk);
        sum += to_eye * (sun * single + again * (sun * 0.4f + glow)) * length_m;
        depth += extinction * length_m;
        before = after;
    }
    return sum * sun_illuminance;
}

SHARED_END

#endif
