// What falls: how many drops and flakes the air holds, how large and how fast they are, how much
// light they take, and how a camera sees one of them.
//
// One text for C++ and GLSL. Rates are mm/h of water, diameters mm, counts per m3 of air.
//
// Rain: Marshall and Palmer 1948 (exponential, 8000 /m3/mm, slope 4.1 R^-0.21 /mm) with the fall
// speeds of Atlas et al. 1973, scaled so that what it carries down is R: pictures and stores agree.
// Snow: Sekhon and Srivastava 1970 by melted diameter; a flake's density is C over its diameter
// (Holroyd 1971; C 0.17 kg/m2 dry, 0.72 wet: Rasmussen et al. 1999).
// Extinction is twice the cross section, as of anything much larger than a wavelength.
#ifndef PETRICHOR_FORMULAS_WEATHER_FALLING_H
#define PETRICHOR_FORMULAS_WEATHER_FALLING_H

#include "base/interop.h"

SHARED_BEGIN

SHARED_CONST float kDrySnow_kg_m2 = 0.17f;
SHARED_CONST float kWetSnow_kg_m2 = 0.72f;

// x^n e^-ax integrated from x up, n = 0 .. 3.
SHARED_FN float exponential_tail(int n, float a, float x)
{
    float sum = 1.0f / a;
    float power = 1.0f;
    for (int i = 1; i <= n; ++i) {
        power *= x;
        sum = power / a + float(i) / a * sum;
    }
    return sum * exp(-a * x);
}

SHARED_FN float between_sizes(int n, float a, float low, float high)
{
    return exponential_tail(n, a, low) - exponential_tail(n, a, high);
}

// Terminal speed of a drop: Atlas 1973; below half a millimetre that of drizzle.
SHARED_FN float drop_speed_m_s(float diameter_mm)
{
    const float large = 9.65f - 10.3f * exp(-0.6f * diameter_mm);
    const float small = max(4.5f * diameter_mm - 0.18f, 0.05f);
    return diameter_mm < 0.5f ? small : large;
}

SHARED_FN float rain_slope_per_mm(float rate_mm_h)
{
    return 4.1f * pow(clamp(rate_mm_h, 1.0e-3f, 1000.0f), -0.21f);
}

// Drops per m3 and mm at diameter 0.
SHARED_FN float rain_intercept(float rate_mm_h)
{
    if (rate_mm_h <= 0.0f) return 0.0f;
    const float a = rain_slope_per_mm(rate_mm_h);
    const float b = a + 0.6f;
    const float carried = 15.079645f * (57.9f / (a * a * a * a) - 61.8f / (b * b * b * b));
    return 8000.0f * rate_mm_h / carried;
}

SHARED_FN float rain_drops_per_m3(float rate_mm_h, float low_mm, float high_mm)
{
    const float a = rain_slope_per_mm(rate_mm_h);
    return rain_intercept(rate_mm_h) * between_sizes(0, a, low_mm, high_mm);
}

SHARED_FN float rain_extinction_per_m(float rate_mm_h, float low_mm, float high_mm)
{
    const float a = rain_slope_per_mm(rate_mm_h);
    return 1.5707963e-6f * rain_intercept(rate_mm_h) * between_sizes(2, a, low_mm, high_mm);
}

// Drops of at least that size that meet level ground, per m2 and second; low_mm >= 0.5.
SHARED_FN float rain_hits_per_m2_s(float rate_mm_h, float low_mm)
{
    const float a = rain_slope_per_mm(rate_mm_h);
    return rain_intercept(rate_mm_h) * (9.65f * exponential_tail(0, a, low_mm) -
                                        10.3f * exponential_tail(0, a + 0.6f, low_mm));
}

// Sekhon and Srivastava measured up to a few mm/h: beyond 10 mm/h there are more flakes, no larger
// ones.
SHARED_FN float snow_slope_per_mm(float rate_mm_h)
{
    return 2.29f * pow(clamp(rate_mm_h, 1.0e-2f, 10.0f), -0.45f);
}

SHARED_FN float snow_intercept(float rate_mm_h)
{
    if (rate_mm_h <= 0.0f) return 0.0f;
    const float measured = clamp(rate_mm_h, 1.0e-2f, 10.0f);
    return 2500.0f * pow(measured, -0.94f) * (rate_mm_h / measured);
}

// The drop that a flake melts to.
SHARED_FN float melted_diameter_mm(float flake_mm, float c_kg_m2)
{
    return pow(c_kg_m2 * flake_mm * flake_mm, 0.33333333f);
}

// Sekhon and Srivastava measured aggregates in light winds. Gales break them to crystals: how many
// times smaller the drops are that flakes melt to, by the wind where they are seen (ours: flakes that
// take most light shrink from 18 to 4 mm in a blizzard of 5 mm/h, those of a calm day stay).
SHARED_FN float snow_breakup(float wind_m_s)
{
    const float t = clamp((wind_m_s - 2.0f) / 7.0f, 0.0f, 1.0f);
    return 1.0f + 1.8f * t * t * (3.0f - 2.0f * t);
}

// broken: as snow_breakup says. The water is that of whole flakes, and so is the extinction.
SHARED_FN float snow_flakes_per_m3(float rate_mm_h, float c_kg_m2, float broken, float low_mm,
                                   float high_mm)
{
    return snow_intercept(rate_mm_h) * broken * broken * broken * broken *
           between_sizes(0, snow_slope_per_mm(rate_mm_h) * broken,
                         melted_diameter_mm(low_mm, c_kg_m2), melted_diameter_mm(high_mm, c_kg_m2));
}

SHARED_FN float snow_extinction_per_m(float rate_mm_h, float c_kg_m2, float broken, float low_mm,
                                      float high_mm)
{
    return 1.5707963e-6f / c_kg_m2 * snow_intercept(rate_mm_h) * broken * broken * broken * broken *
           between_sizes(3, snow_slope_per_mm(rate_mm_h) * broken,
                         melted_diameter_mm(low_mm, c_kg_m2), melted_diameter_mm(high_mm, c_kg_m2));
}

// The same of all sizes from what falls: 3 S / (C v), Rasmussen et al. 1999.
SHARED_FN float snow_bulk_extinction_per_m(float rate_mm_h, float c_kg_m2, float speed_m_s)
{
    return 3.0f * rate_mm_h / 3600.0f / (c_kg_m2 * speed_m_s);
}

// Aggregates of dendrites: Locatelli and Hobbs 1974. Wet ones are half as fast again.
SHARED_FN float flake_speed_m_s(float flake_mm)
{
    return 0.8f * pow(flake_mm, 0.16f);
}

// Wind over the ground by the logarithmic law, from that at 10 m. roughness_m: 0.5 for suburbs
// (Wieringa 1992).
SHARED_FN float wind_share_at(float height_m, float roughness_m)
{
    return log(max(height_m / roughness_m, 1.0f)) / log(10.0f / roughness_m);
}

// How much a drop hides of what is behind it while the shutter is open (Garg and Nayar 2007).
// focal_px: focal length in pixels.
SHARED_FN float streak_opacity(float focal_px, float diameter_m, float distance_m, float speed_m_s,
                               float shutter_s)
{
    return min(1.0f, focal_px * diameter_m / max(distance_m, 1.0e-3f)) *
           min(1.0f, diameter_m / max(speed_m_s * shutter_s, 1.0e-9f));
}

// From here on it hides less than `least`.
SHARED_FN float streak_reach_m(float focal_px, float diameter_m, float speed_m_s, float shutter_s,
                               float least)
{
    return focal_px * diameter_m * min(1.0f, diameter_m / max(speed_m_s * shutter_s, 1.0e-9f)) /
           least;
}

// A spot that hides 1 - r2/R2 of what is r from its middle moves along its way while the shutter is
// open: the mean of what it hides at a point. Softer at the ends than in the middle, and fainter the
// longer the way; summed over the picture it is half of the spot's disc, however far it goes.
//   along, across  of the point from the middle of the way, px
SHARED_FN float streak_cover(float along, float across, float half_way, float radius)
{
    const float inside = radius * radius - across * across;
    if (inside <= 0.0f) return 0.0f;
    const float half_chord = sqrt(inside);
    const float begin = clamp(along - half_way, -half_chord, half_chord);
    const float end = clamp(along + half_way, -half_chord, half_chord);
    const float way = max(2.0f * half_way, 1.0e-3f * radius);
    if (half_way < 0.02f * radius) return max(inside - along * along, 0.0f) / (radius * radius);
    return max((end - begin) * (inside - (end * end + end * begin + begin * begin) / 3.0f), 0.0f) /
           (way * radius * radius);
}

// Half the width of the spot as which a camera sees what is seen_px wide, whose lens blurs it to a
// disc of blur_px: a spot of 1.4 times its width, so that it hides half where it ends, ..
SHARED_FN float spot_radius_px(float seen_px, float blur_px)
{
    return sqrt(0.5f * seen_px * seen_px + blur_px * blur_px + 0.45f);
}

// .. and how much its middle hides, so that all of it hides as much as its section.
SHARED_FN float spot_opacity(float seen_px, float radius_px)
{
    return 0.5f * seen_px * seen_px / (radius_px * radius_px);
}

// Half of what a drop or flake takes from a ray it stops or sends elsewhere: that is what is drawn. The other
// half it bends by less than a pixel (Babinet); it stays with the haze.
SHARED_CONST float kStopped = 0.5f;

// Optical depth of what is drawn one by one before a distance: extinction per_m of what is drawn at
// all, seen to reach_m in the mean (sum of extinction times reach over the sizes, divided by the sum
// of extinction). Exact for x -> 0 and x -> infinity.
SHARED_FN float drawn_depth(float distance_m, float per_m, float reach_m)
{
    return reach_m > 0.0f ? per_m * reach_m * (1.0f - exp(-distance_m / reach_m)) : 0.0f;
}

// Light of a lamp or the sun that a drop sends on, 1/sr: nearly all of it forward (Henyey and
// Greenstein 1941, g = 0.9). Times irradiance: the mean radiance of its disc.
SHARED_FN float drop_phase(float cosine)
{
    const float d = max(1.81f - 1.8f * cosine, 1.0e-4f);
    return 0.0795775f * 0.19f / (d * sqrt(d));
}

// The same of a flake: forward and to all sides.
SHARED_FN float flake_phase(float cosine)
{
    const float d = max(1.49f - 1.4f * cosine, 1.0e-4f);
    return 0.0795775f * (0.5f * 0.51f / (d * sqrt(d)) + 0.5f);
}

// Crown that a drop throws up, radius (Yarin and Weiss 1995); gone after 15 ms.
SHARED_FN float crown_radius_m(float diameter_m, float speed_m_s, float age_s)
{
    return diameter_m * sqrt(max(age_s, 0.0f) * speed_m_s / diameter_m);
}

SHARED_END

#endif
