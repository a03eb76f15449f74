// Interface of the falling pass.
#ifndef PETRICHOR_GPU_PASSES_FALLING_FALLING_IO_H
#define PETRICHOR_GPU_PASSES_FALLING_FALLING_IO_H

#include "base/interop.h"

// splash
#define FALLING_FRAME 0
#define FALLING_SKY_LIGHT 1
#define FALLING_DROPS 2
#define FALLING_DEPTH 3
#define FALLING_SHELTER 4

// falling; with the frame, drops and depth at the same places
#define FALLING_LIGHT 1

// falling_lit: a texel a drop: radiance, and 0 where a roof keeps it off
#define FALLING_LIT_FRAME 0
#define FALLING_LIT_SKY_LIGHT 1
#define FALLING_LIT_DROPS 2
#define FALLING_LIT_SHELTER 3
#define FALLING_LIT_SHADOW 4
#define FALLING_LIT_LIGHT 5
#define FALLING_LIT_GROUP 64

#define FALLING_SPEC_SHELTER 0
#define FALLING_SPEC_SUN 1

#define FALLING_TEXELS 4  // a drop in its table
#define SPLASH_TEXELS 2

SHARED_BEGIN

SHARED_CONST float kSplashLife_s = 0.015f;
SHARED_CONST float kSplashReach_m = 14.0f;

// One drop or flake in the picture.
struct FallingDrop {
    vec2 from_px;     // its way while the shutter is open
    vec2 to_px;
    float view_m;     // distance along the view axis
    float half_px;    // of the spot that moves along its way
    float opacity;    // of that spot's middle at rest
    float flake;      // 0 a drop; a flake: 1 + where its outline begins, 0..1; -1 a drop off an edge, which no roof keeps off
    vec3 position_m;  // world
    float speed_m_s;
    vec3 lamps;       // radiance that lamps give it
    float diameter_m;
};

struct FallingLitParams {
    int count;
};

// A drop that has hit something.
struct FallingSplash {
    vec3 above_m;  // a point on the way that it fell; with a diameter below 0 one straight over the place where it hit
    float age_s;
    vec3 lamps;    // radiance that lamps give it
    float diameter_m;
};

// Aggregates are ragged; the larger in the picture, the more of that is seen, unless it is blurred by
// their way.
SHARED_FN float flake_raggedness(float half_way_px, float half_px)
{
    return clamp(0.05f * half_px - 0.03f, 0.0f, 0.2f) * half_px / (half_px + half_way_px);
}

SHARED_END

#endif
