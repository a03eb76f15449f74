// How much of the sun and of the sky a point sees, by their depth maps. Included by the lighting pass.
#ifndef PETRICHOR_SUN_AND_SKY_SHADOW_GLSL
#define PETRICHOR_SUN_AND_SKY_SHADOW_GLSL

#include "gpu/passes/depth_maps/shadow_disc.glsl"

// Share of the sun's disc that is not hidden: four places on a turning disc, each between four texels. `normal` is that of
// the mesh, on the sun's side.
float sun_visibility(vec3 position, vec3 normal, float view_m, ivec2 texel)
{
    // Told out and chosen: a loop and reads by an address of each pixel cost a CPU more.
    const bool beyond_first = view_m > frame.cascade_end_m.x;
    const bool beyond_second = beyond_first && view_m > frame.cascade_end_m.y;
    const int cascade = beyond_second ? 2 : beyond_first ? 1 : 0;
    const float scale = beyond_second ? frame.cascade_scale.z : beyond_first ? frame.cascade_scale.y : frame.cascade_scale.x;
    const float texel_m = frame.shadow_texel_m * scale;
    const vec4 place = vec4(position + frame.sun_direction * shadow_lift_m(normal, frame.sun_direction, texel_m), 1.0);
    const vec4 first_map = frame_arrays.shadow_from_world[0] * place;
    const vec4 second_map = frame_arrays.shadow_from_world[1] * place;
    const vec4 third_map = frame_arrays.shadow_from_world[2] * place;
    const vec4 map = beyond_second ? third_map : beyond_first ? second_map : first_map;
    if (any(greaterThan(abs(map.xyz - 0.5), vec3(0.5)))) return 1.0;
    // The maps differ in their width alone.
    const mat3 gradients = transpose(mat3(frame_arrays.shadow_from_world[2]));
    const vec2 slope = shadow_plane_slope(normal, gradients[0], gradients[1], gradients[2]) * (scale / frame.cascade_scale.z);
    const float turn = 6.2831853 * dither(picture_pixel(texel), frame.sample_index);
    const vec2 axis = vec2(cos(turn), sin(turn)) * SHADOW_DISC_TEXELS;
    return disc_lit(shadow_map, map.xy, float(cascade), map.z, slope, axis);
}

// Of one of the pictures of the sun's cookie, from its corner, which is also that of the next one.
vec3 cookie_picture(vec2 at, int level)
{
    int first = frame.cookie_texel;
    int side = LIGHT_PROFILE_SIDE;
    for (int k = 0; k < level; ++k) {
        first += side * side;
        side /= 2;
    }
    const vec2 place = fract(at) * float(side) - 0.5;
    const vec2 low = floor(place);
    const vec2 part = place - low;
    const ivec2 a = (ivec2(low) + side) % side;
    const ivec2 b = (a + 1) % side;
    const vec3 above = mix(texelFetch(light_profiles, first + a.y * side + a.x).rgb,
                           texelFetch(light_profiles, first + a.y * side + b.x).rgb, part.x);
    const vec3 below = mix(texelFetch(light_profiles, first + b.y * side + a.x).rgb,
                           texelFetch(light_profiles, first + b.y * side + b.x).rgb, part.x);
    return mix(above, below, part.y);
}

// What the picture before the sun lets through there.
vec3 sun_cookie(vec3 position, float view_m)
{
    if ((WAYS & LIGHTS_SUN_COOKIE) == 0u) return vec3(1.0);
    const vec2 at = vec2(dot(position, frame.cookie_right), dot(position, frame.cookie_down)) + 0.5;
    const float last = float(findMSB(uint(LIGHT_PROFILE_SIDE)));
    const float level = sun_cookie_level(pixel_width_m(frame, view_m), frame.cookie_texel_m, last);
    const int low = int(level);
    const vec3 finer = cookie_picture(at, low);
    return mix(finer, cookie_picture(at, min(low + 1, int(last))), level - float(low));
}

// Share of skylight that reaches a surface past buildings and roofs: each sample of the frame asks a
// quarter of the sky's directions, so that four samples ask all of them.
float sky_visibility(vec3 position, vec3 normal, ivec2 texel)
{
    texel = picture_pixel(texel);
    const int start = int((hash_u3(uint(texel.x), uint(texel.y), 9u) + frame.sample_index) & 3u);
    const float turn = 6.2831853 * dither(texel.yx, frame.sample_index + 5u);
    const vec2 blur = vec2(cos(turn), sin(turn)) * (0.8 / float(textureSize(sky_visibility_map, 0).x));
    float open = 0.0;
    float total = 0.0;
    for (int k = 0; k < 4; ++k) {
        const int i = (start + k * (SKY_DIRECTIONS / 4)) % SKY_DIRECTIONS;
        const vec4 direction = frame_arrays.sky_direction[i];
        const float facing = dot(normal, direction.xyz);
        if (facing <= 0.0) continue;
        // Directions are spread by their cosine with the vertical: undone for other normals.
        const float weight = facing / max(direction.y, 0.2);
        const vec3 lifted = position + normal * (direction.w * 1.2) + direction.xyz * (direction.w * 0.8);
        const vec4 map = frame_arrays.sky_from_world[i] * vec4(lifted, 1.0);
        const bool inside = all(lessThanEqual(abs(map.xyz - 0.5), vec3(0.5)));
        const float seen =
            inside ? texture(sky_visibility_map, vec4(map.xy + blur, float(i), map.z)) : 1.0;
        open += weight * seen;
        total += weight;
    }
    return total > 0.0 ? open / total : 1.0;
}

#endif
