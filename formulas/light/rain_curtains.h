// What a sky that rains is low over its horizon, from where one stands in it: curtains of rain that hang from the layer in cells,
// and between them the light of where it ends.
#ifndef PETRICHOR_FORMULAS_LIGHT_RAIN_CURTAINS_H
#define PETRICHOR_FORMULAS_LIGHT_RAIN_CURTAINS_H

#include "formulas/light/rain_clouds.h"

SHARED_BEGIN

SHARED_CONST int kCurtains = 3;
SHARED_CONST float kCurtainEnds = 0.56f;  // the cosine with the vertical from which on the nearest is above all

SHARED_CONST float kCurtainLean_per_m_s = 0.03f;  // of the wind at 10 m: large drops fall 7 m/s, and cells drift along

// Heights of the layer to one of them: 2.4, 5 and 10 km.
SHARED_FN float curtain_away(int k) { return k == 0 ? 1.5f : k == 1 ? 3.1f : 6.4f; }

// How deep in rain a place is that the wind has moved, 0..1, about 0.25 in the mean. at: in heights of the layer; streak: across
// the view there, of what falls thicker and thinner. Showers are wider than the layer is high, the more of them the farther one
// sees: of narrow ones a curtain is a pillar. Their two lattices are turned against each other.
SHARED_FN float curtain_cell(vec2 at, float streak, float away, uint seed)
{
    const float wide = 0.62f * inversesqrt(away);
    const vec2 turned = vec2(0.8f * at.x - 0.6f * at.y, 0.6f * at.x + 0.8f * at.y);
    const float cell = 0.62f * endless_noise(at * wide, seed) + 0.38f * endless_noise(turned * (2.3f * wide) + splat2(5.0f), seed + 1u);
    const float t = clamp((cell - 0.28f) / 0.62f, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t) * (0.75f + 0.5f * streak);
}

// Radiance over that without curtains, and how much of it is of their own grey, 0..1, in a direction with y >= 0. lean: of what
// falls, metres aside for a metre down.
SHARED_FN vec2 rain_curtains(vec3 direction, vec2 drift_m, vec2 lean, float rain)
{
    const float level = sqrt(max(1.0f - direction.y * direction.y, 1.0e-4f));
    const vec2 ahead = vec2(direction.x, direction.z) * (1.0f / level);
    const float rise = direction.y / level;
    float passes = 1.0f;
    float beside = 0.0f;
    for (int k = 0; k < kCurtains; ++k) {
        const float away = curtain_away(k);
        const float height = rise * away;
        // Showers start and end, and gusts carry their rain aside on its way: a curtain is no wall over a line of the land. Its
        // sides wander as it comes down, and it thins out all the way up to the clouds, here sooner and there later: what ended at
        // one height stood in the sky as a box.
        const vec2 sideways = vec2(ahead.y, -ahead.x);
        const vec2 woven = ahead * (2.6f + 0.9f * away) + sideways * (1.7f * height) + splat2(0.37f * height) + drift_m * (0.3f * kCloudDrift_per_m);
        const float wander = endless_noise(woven, 370u + uint(k)) - 0.5f;
        const float top = (k == 0 ? 0.8f : 1.25f) + (k == 0 ? 0.4f : 0.9f) * (endless_noise(ahead * (1.3f + 0.5f * away) + splat2(3.0f), 373u + uint(k)) - 0.5f);
        const float t = clamp(height / top, 0.0f, 1.0f);
        const float hangs = 1.0f - t * t * (3.0f - 2.0f * t);
        beside = max(beside, hangs);
        const vec2 at = ahead * away + drift_m * kCloudDrift_per_m * 0.45f + lean * height +
                        sideways * (1.5f * wander) + splat2(50.0f + 9.0f * float(k));
        const float across = lean.x * ahead.y - lean.y * ahead.x;
        const float aside = across * height + 0.8f * wander;
        const vec2 fine = (ahead + sideways * (aside / away)) * (7.0f + 1.2f * away);
        const float streak = 0.7f * endless_noise(fine, 360u + uint(k)) + 0.3f * endless_noise(fine * 2.3f, 363u + uint(k));
        passes *= exp(-1.15f * rain * hangs * curtain_cell(at, streak, away, 350u + 3u * uint(k)));
    }
    // Where the layer ends, some ten of its heights away, daylight comes in below it; what curtains take there is between them.
    const float bright = 1.0f + rain * (0.55f * exp(-14.0f * rise) + 0.31f * beside);
    return vec2(mix(0.55f, bright, passes), 1.0f - passes);
}

SHARED_END

#endif
