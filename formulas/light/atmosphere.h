// Clear air: scattering by molecules and haze, absorption by ozone, in four narrow bands of light.
//
// One text for C++ and GLSL. Bands at 620, 550, 480 and 430 nm. air_rgb() makes linear sRGB of them, in which the
// sun above the air is white; bands and matrix are the least-squares fit, by relative luminance, to spectra of 5 nm
// of sun, level ground, zenith and both horizons, for suns of 60 to -7 degrees, turbidities 1, 3 and 6 and lands
// of albedo 0.2 and 0.8. What four bands say of other suns is within 0.003 of the spectrum in CIE xy
// (ClearAir.HasTheColoursOfManyBands). Ozone decides the colour of twilight: 10 % more of it in green and 8 %
// less in red make snow violet.
//
//   source   molecules 1.24062e-6 / um^4 (after Bucholtz 1995); ozone as a tent from 10 to 40 km (Bruneton and
//            Neyret 2008), 300 Dobson units, cross-sections of Serdyuchenko et al. 2014 at 233 K; the sun's
//            spectrum above the air ASTM G-173; CIE 1931 after Wyman et al. 2013
#ifndef PETRICHOR_FORMULAS_LIGHT_ATMOSPHERE_H
#define PETRICHOR_FORMULAS_LIGHT_ATMOSPHERE_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kEarthRadius = 6360000.0f;
SHARED_CONST float kAirHeight = 80000.0f;

// Linear sRGB of light in the four bands, each as a share of what the sun sends above the air.
SHARED_FN vec3 air_rgb(vec4 bands)
{
    return vec3(dot(bands, vec4(1.1136f, 0.1150f, -0.3847f, 0.1561f)),
                dot(bands, vec4(-0.0535f, 0.9594f, 0.1617f, -0.0676f)),
                dot(bands, vec4(-0.0159f, -0.1473f, 0.5960f, 0.5672f)));
}

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

SHARED_FN vec4 molecule_scattering()
{
    return vec4(8.3960e-6f, 13.558e-6f, 23.371e-6f, 36.288e-6f);
}

SHARED_FN float haze_scattering(float turbidity)
{
    return 2.6e-6f * max(turbidity - 1.0f, 0.0f);
}

// Per metre where the relative densities are `density`: scattered, and scattered or absorbed.
SHARED_FN vec4 air_scattering(vec3 density, float turbidity)
{
    return molecule_scattering() * density.x + splat4(haze_scattering(turbidity) * density.y);
}
SHARED_FN vec4 air_extinction(vec3 density, float turbidity)
{
    return molecule_scattering() * density.x + splat4(1.1f * haze_scattering(turbidity) * density.y) +
           vec4(2.1617e-6f, 1.7710e-6f, 0.3406e-6f, 0.0375e-6f) * density.z;
}

SHARED_FN vec4 air_kept(vec4 depth)
{
    return vec4(exp(-depth.x), exp(-depth.y), exp(-depth.z), exp(-depth.w));
}

// Share of light that reaches `height` from space along a direction, by band; 0 behind the earth.
SHARED_FN vec4 air_transmittance_bands(float height, float up, float turbidity)
{
    if (distance_to_ground(height, up) > 0.0f) return splat4(0.0f);
    const float reach = distance_to_space(height, up);
    const float r = kEarthRadius + height;
    vec4 depth = splat4(0.0f);
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
    return air_kept(depth);
}

// The same of white light, in linear sRGB.
SHARED_FN vec3 air_transmittance(float height, float up, float turbidity)
{
    return max(air_rgb(air_transmittance_bands(height, up, turbidity)), splat3(0.0f));
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

// A table of light scattered more than once (air_radiance.inc): rows of height, in each the cosine of the sun
// with the vertical, from 19 degrees below the horizon.
SHARED_CONST int kAgainHeights = 12;
SHARED_CONST int kAgainSuns = 48;
SHARED_CONST float kAgainTop = 60000.0f;
SHARED_CONST float kAgainLowest = -0.32f;

// Place in the table of a height and a cosine of the sun, and back.
SHARED_FN vec2 again_place(float height, float sun_up)
{
    return vec2(sqrt(clamp(height / kAgainTop, 0.0f, 1.0f)) * float(kAgainHeights - 1),
                sqrt(clamp((sun_up - kAgainLowest) / (1.0f - kAgainLowest), 0.0f, 1.0f)) * float(kAgainSuns - 1));
}
SHARED_FN float again_height(int row)
{
    const float x = float(row) / float(kAgainHeights - 1);
    return kAgainTop * x * x;
}
SHARED_FN float again_sun_up(int column)
{
    const float x = float(column) / float(kAgainSuns - 1);
    return kAgainLowest + (1.0f - kAgainLowest) * x * x;
}

SHARED_END

#endif
