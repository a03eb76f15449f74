// The air between the camera and a surface. The includer has `frame`, and includes formulas/light/fog.h,
// formulas/weather/falling.h and formulas/weather/gusts.h before. GUSTS: 0 where the air has none.
#ifndef PETRICHOR_AIR_GLSL
#define PETRICHOR_AIR_GLSL

#include "gpu/frame/sky_quads_io.h"

// Share of the light of a point that reaches the camera through the fog, 0..1. Drops and flakes that
// are drawn one by one are no haze.
float air_kept(vec3 position)
{
    const float distance_m = length(position - frame.camera_m);
    const float path = fog_path(distance_m, frame.camera_m.y - frame.fog_base_m,
                                position.y - frame.fog_base_m, frame.fog_height_m);
    const float drawn = drawn_depth(distance_m, frame.drawn_per_m, frame.drawn_reach_m);
    // What the gusts carry is thick in places: fog in metres alone has them.
    if (GUSTS != 0u) {
        const float depth = max(frame.fog_per_m * path - drawn, 0.0);
        return exp(-depth * gust_veil(frame.camera_m, position, frame.gusts.xy, frame.gusts.z));
    }
    const float kept = fog_kept(frame.fog_mode, path, frame.fog_per_m, frame.fog_start_m,
                                frame.fog_end_m);
    return min(kept * exp(drawn), 1.0);
}

// Where the air of a view takes its light from in the sky, which is blurred; `view` leads away from
// the camera.
vec3 air_level(vec3 view)
{
    return normalize(vec3(view.x, max(view.y, 0.05), view.z));
}
const float kAirMip = float(SKY_AIR_MIP);

#endif
