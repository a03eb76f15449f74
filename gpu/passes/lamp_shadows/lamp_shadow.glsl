// Whether a lamp sees a place. Before the include: uniform sampler2DArrayShadow lamp_shadow_map, frame.
#ifndef PETRICHOR_LAMP_SHADOW_GLSL
#define PETRICHOR_LAMP_SHADOW_GLSL

#include "formulas/noise/noise.h"
#include "gpu/passes/lamp_shadows/lamp_shadows_io.h"

// Face and (s, t), each -1..1 within it, of a direction whose longest part is `longest`.
vec3 lamp_face(vec3 d, float longest)
{
    if (abs(d.x) == longest) return d.x > 0.0 ? vec3(-d.z, -d.y, 0.0) : vec3(d.z, -d.y, 1.0);
    if (abs(d.y) == longest) return d.y > 0.0 ? vec3(d.x, d.z, 2.0) : vec3(d.x, -d.z, 3.0);
    return d.z > 0.0 ? vec3(d.x, -d.y, 4.0) : vec3(-d.x, -d.y, 5.0);
}

float longest_part(vec3 d)
{
    return max(abs(d.x), max(abs(d.y), abs(d.z)));
}

// Share of the lamp `number`, at `lamp_m`, that is seen from a surface: hardware 2 x 2 comparisons on a
// turning disc.
float lamp_visibility(float number, vec3 lamp_m, vec3 position, vec3 normal, ivec2 texel)
{
    const vec3 to_lamp = lamp_m - position;
    const float texel_m = 2.0 * longest_part(to_lamp) / float(LAMP_MAP_SIZE);
    const vec3 l = normalize(to_lamp);
    // A filter of 2.6 texels sees depths that differ by so much times the tangent of the light's angle:
    // its sine off the surface is enough for any slope (and no more: little peter-panning).
    const float nl = clamp(dot(normal, l), 0.0, 1.0);
    const float off = 0.5 + 4.0 * sqrt(1.0 - nl * nl);
    const vec3 d = -to_lamp + normal * (texel_m * off) + l * (texel_m * 0.5);
    const float along = longest_part(d);
    const float depth = LAMP_MAP_NEAR_M / max(along, LAMP_MAP_NEAR_M);
    const vec3 face = lamp_face(d, along);
    const vec2 uv = face.xy * (0.5 * LAMP_MAP_COVER / along) + 0.5;
    const float layer = number * 6.0 + face.z;
    const float turn = 6.2831853 * dither(texel, frame.sample_index + 19u);
    const vec2 axis = vec2(cos(turn), sin(turn)) * (1.6 / float(LAMP_MAP_SIZE));
    float lit = 0.0;
    lit += texture(lamp_shadow_map, vec4(uv + axis, layer, depth));
    lit += texture(lamp_shadow_map, vec4(uv - axis, layer, depth));
    lit += texture(lamp_shadow_map, vec4(uv + 0.5 * vec2(-axis.y, axis.x), layer, depth));
    lit += texture(lamp_shadow_map, vec4(uv - 0.5 * vec2(-axis.y, axis.x), layer, depth));
    return lit * 0.25;
}

#endif
