// Whether a lamp sees a place. Before the include: uniform sampler2DArray lamp_shadow_map, frame.
#ifndef PETRICHOR_LAMP_SHADOW_GLSL
#define PETRICHOR_LAMP_SHADOW_GLSL

#include "formulas/noise/noise.h"
#include "gpu/passes/lamp_shadows/lamp_shadows_io.h"
#include "gpu/passes/depth_maps/shadow_disc.glsl"

// Of a way d, whose longest part is `longest`: the face of the cube that it meets.
float lamp_face(vec3 d, float longest)
{
    if (abs(d.x) == longest) return d.x > 0.0 ? 0.0 : 1.0;
    if (abs(d.y) == longest) return d.y > 0.0 ? 2.0 : 3.0;
    return d.z > 0.0 ? 4.0 : 5.0;
}

// A way's parts along s and t of a face, and away from the lamp.
vec3 on_lamp_face(vec3 d, float face)
{
    if (face < 1.5) return face < 0.5 ? vec3(-d.z, -d.y, d.x) : vec3(d.z, -d.y, -d.x);
    if (face < 3.5) return face < 2.5 ? vec3(d.x, d.z, d.y) : vec3(d.x, -d.z, -d.y);
    return face < 4.5 ? vec3(d.x, -d.y, d.z) : vec3(-d.x, -d.y, -d.z);
}

float longest_part(vec3 d)
{
    return max(abs(d.x), max(abs(d.y), abs(d.z)));
}

// Share of the lamp `number`, at `lamp_m`, that is seen from a surface; its map begins at near_m; `normal`: of its mesh.
float lamp_visibility(float number, vec3 lamp_m, float near_m, vec3 position, vec3 normal, ivec2 texel)
{
    const vec3 to_lamp = lamp_m - position;
    const float texel_m = 2.0 * longest_part(to_lamp) / float(LAMP_MAP_SIZE);
    const vec3 l = normalize(to_lamp);
    const vec3 d = l * shadow_lift_m(normal, l, texel_m) - to_lamp;
    const float face = lamp_face(d, longest_part(d));
    const vec3 on_face = on_lamp_face(d, face);
    const float along = max(on_face.z, near_m);
    const vec2 uv = on_face.xy * (0.5 * LAMP_MAP_COVER / on_face.z) + 0.5;
    const vec2 slope = lamp_plane_slope(normal, d, on_lamp_face(normal, face).xy) * (near_m * 2.0 / LAMP_MAP_COVER);
    const float turn = 6.2831853 * dither(picture_pixel(texel), frame.sample_index + 19u);
    const vec2 axis = vec2(cos(turn), sin(turn)) * SHADOW_DISC_TEXELS;
    return disc_lit(lamp_shadow_map, uv, number * 6.0 + face, near_m / along, slope, axis);
}

#endif
