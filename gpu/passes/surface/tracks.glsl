// What feet and tyres have pressed into the snow at a surface point.
#ifndef PETRICHOR_SURFACE_TRACKS_GLSL
#define PETRICHOR_SURFACE_TRACKS_GLSL

#include "gpu/passes/surface/textures.glsl"

struct Trodden {
    float pressed;  // share of the depth that is gone
    vec2 slope;     // of the snow, along world x and z
};

Trodden trodden_at(SurfaceInput at)
{
    const vec2 scale = frame.tracks.zw;
    const vec4 t = textureGrad(track_map, (at.position.xz - frame.tracks.xy) * scale,
                               at.position_dx.xz * scale, at.position_dy.xz * scale);
    const bool here = at.position.y >= frame.tracks_y_m.x && at.position.y <= frame.tracks_y_m.y &&
                      at.normal.y > 0.5;
    Trodden trodden;
    trodden.pressed = here ? t.r : 0.0;
    trodden.slope = here ? (t.gb - 128.0 / 255.0) * 4.0 : vec2(0.0);
    return trodden;
}

#endif
