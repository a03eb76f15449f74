// Fog: how much light gets through it, over the ground and up to the sky.
//
// Its density falls with height as exp(-height / scale height) above a base and is the same below
// it; what counts is the path, the length of air as dense as at the base that would weaken as much.
// exp is Beer's law, "metres" the same with Koschmieder's extinction; exp2 and linear are the fog
// modes of older hardware.
#ifndef PETRICHOR_FORMULAS_LIGHT_FOG_H
#define PETRICHOR_FORMULAS_LIGHT_FOG_H

#include "base/interop.h"

#define FOG_OFF 0
#define FOG_METRES 1
#define FOG_EXP 2
#define FOG_EXP2 3
#define FOG_LINEAR 4

SHARED_BEGIN

// Path between two heights above the base, metres. height_m: the scale height; 0: no end to the
// fog.
SHARED_FN float fog_path(float distance_m, float from_above_m, float to_above_m, float height_m)
{
    if (height_m <= 0.0f) return distance_m;
    const float a = max(from_above_m, 0.0f) / height_m;
    const float b = max(to_above_m, 0.0f) / height_m;
    const float rise = abs(b - a);
    const float mean = rise < 1.0e-3f ? 1.0f - 0.5f * rise : (1.0f - exp(-rise)) / rise;
    return distance_m * exp(-min(a, b)) * mean;
}

// Path out of the fog in a direction with the cosine `up` >= 0 to the vertical. Level with the
// ground a layer on a sphere of the earth's radius R is sqrt(pi R H / 2) deep; straight up it is H.
SHARED_FN float fog_path_to_sky(float up, float above_m, float height_m)
{
    if (height_m <= 0.0f) return 1.0e9f;
    const float curvature = 2.0f * height_m / (3.14159265f * 6360000.0f);
    return exp(-max(above_m, 0.0f) / height_m) * height_m / sqrt(up * up + curvature);
}

// Path over level land at the base, seen below the horizon (up < 0) from so far above it: as long as the air is
// deep level with the ground, at most.
SHARED_FN float fog_path_to_land(float up, float above_m, float height_m)
{
    const float distance_m = max(above_m, 0.0f) / max(-up, 1.0e-6f);
    return min(fog_path(distance_m, above_m, 0.0f, height_m), fog_path_to_sky(0.0f, 0.0f, height_m));
}

// The height from which a computed sky shows its land, metres.
SHARED_FN float fog_eye_of_sky_m() { return 2.0f; }

// Share of light that passes a path. per_m: extinction (metres, exp) or density (exp2); start_m and
// end_m: where linear fog begins and hides all.
SHARED_FN float fog_kept(int mode, float path_m, float per_m, float start_m, float end_m)
{
    if (mode == FOG_OFF) return 1.0f;
    if (mode == FOG_LINEAR) {
        return 1.0f - clamp((path_m - start_m) / max(end_m - start_m, 1.0e-3f), 0.0f, 1.0f);
    }
    const float depth = per_m * path_m;
    return exp(mode == FOG_EXP2 ? -depth * depth : -depth);
}

// Extinction of the layer towards the sky, where the weather's visibility makes it: what a clear
// day of 20 km has is haze, which the sky holds already.
SHARED_FN float fog_beyond_haze(float per_m)
{
    return max(per_m - 3.912f / 20000.0f, 0.0f);
}

// What of the air's extinction hides things as wide as clouds. rain_per_m: the part that is rain's, by its drops: half of what
// a drop takes from a ray it only bends by less than half a degree.
SHARED_FN float fog_before_clouds(float per_m, float rain_per_m)
{
    return per_m - 0.5f * clamp(rain_per_m, 0.0f, per_m);
}

// What fog that is lit from above sends in a direction with the cosine `up` to the vertical, over an even sky's light on the
// ground / pi: along the ground half of what it scatters comes from the sky (0.86 in the mean of all directions of an
// overcast one) and half from the land; upwards it is as much brighter as leaves three quarters of that light on the ground.
SHARED_FN float fog_from_above(float up, float land_albedo)
{
    const float level = 0.43f + 0.5f * land_albedo;
    return level + 1.5f * (0.75f - level) * max(up, 0.0f);
}

// Forward scattering by droplets: Henyey and Greenstein 1941 with g = 0.8, 1/sr.
SHARED_FN float fog_phase(float cosine)
{
    const float g = 0.8f;
    const float d = max(1.0f + g * g - 2.0f * g * cosine, 1.0e-4f);
    return 0.0795775f * (1.0f - g * g) / (d * sqrt(d));
}

SHARED_END

#endif
