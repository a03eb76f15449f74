// Water that runs down walls in heavy rain: rivulets some fingers apart that wander, join into sheets, and carry waves down with them.
// Spacing, slopes and speed are ours, by eye: a smooth film of half a millimetre would run down by 0.8 m/s (Nusselt 1916), walls are rough.
//
// One text for C++ and GLSL.
#ifndef PETRICHOR_FORMULAS_WEATHER_RUN_OFF_H
#define PETRICHOR_FORMULAS_WEATHER_RUN_OFF_H

#include "base/interop.h"
#include "formulas/noise/noise.h"
#include "formulas/weather/surface_weather.h"

SHARED_BEGIN

SHARED_CONST float kRunOff_m_s = 0.45f;
SHARED_CONST float kRunOffMean = 0.54f;  // of thick over a wall

struct RunOff {
    float thick;  // 0 between rivulets .. 1
    vec2 lean;    // of the water's normal: along the wall, up it
};

// along_m: along the wall; y_m: height; wider_m: of a pixel there, from which on there is but the mean.
SHARED_FN RunOff run_off(float along_m, float y_m, float time_s, float wider_m)
{
    const float bend_m = 0.07f * endless_noise(vec2(2.1f * along_m, 1.2f * y_m), 351u);
    const vec3 lane = endless_noise_sloped(vec2(24.0f * (along_m + bend_m), 0.4f * y_m), 353u);
    const float sheet = endless_noise(vec2(1.6f * along_m, 0.5f * y_m), 355u);
    const vec3 wave = endless_noise_sloped(vec2(31.0f * (along_m + bend_m), 2.6f * (y_m + kRunOff_m_s * time_s)), 357u);
    const float edge = 0.72f - 0.5f * sheet;
    const float thick = smooth_edge(edge - 0.12f, edge + 0.12f, lane.x);
    const float seen = 1.0f - smooth_edge(0.008f, 0.03f, wider_m);
    RunOff off;
    off.thick = mix(kRunOffMean, thick * (0.7f + 0.6f * wave.x), seen);
    // A rivulet is round across, its waves are steep below.
    off.lean = vec2(-0.3f * lane.y - 0.12f * wave.y, 0.22f * wave.z) * (thick * seen);
    return off;
}

SHARED_END

#endif
