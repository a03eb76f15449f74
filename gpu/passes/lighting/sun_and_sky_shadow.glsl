// How much of the sun and of the sky a point sees, by their depth maps. Included by the lighting pass.
#ifndef PETRICHOR_SUN_AND_SKY_SHADOW_GLSL
#define PETRICHOR_SUN_AND_SKY_SHADOW_GLSL

// Share of the sun's disc that is not hidden: hardware 2 x 2 comparisons on a turning disc.
float sun_visibility(vec3 position, vec3 normal, float view_m, ivec2 texel)
{
    int cascade = 0;
    while (cascade < SHADOW_CASCADES - 1 && view_m > frame.cascade_end_m[cascade]) ++cascade;
    const float texel_m = frame.shadow_texel_m * frame.cascade_scale[cascade];
    // Off the surface by a texel, more at grazing light: no acne, little peter-panning.
    const float grazing = 1.0 - saturate(dot(normal, frame.sun_direction));
    const vec3 lifted = position + normal * (texel_m * (1.0 + 2.0 * grazing)) +
                        frame.sun_direction * (texel_m * 0.5);
    const vec4 map = frame.shadow_from_world[cascade] * vec4(lifted, 1.0);
    if (any(greaterThan(abs(map.xyz - 0.5), vec3(0.5)))) return 1.0;
    const vec2 step_uv = 1.0 / vec2(textureSize(shadow_map, 0).xy);
    const float turn = 6.2831853 * dither(texel, frame.sample_index);
    const vec2 axis = vec2(cos(turn), sin(turn)) * 1.6;
    float lit = 0.0;
    lit += texture(shadow_map, vec4(map.xy + step_uv * axis, cascade, map.z));
    lit += texture(shadow_map, vec4(map.xy - step_uv * axis, cascade, map.z));
    lit += texture(shadow_map, vec4(map.xy + step_uv * 0.5 * vec2(-axis.y, axis.x), cascade, map.z));
    lit += texture(shadow_map, vec4(map.xy - step_uv * 0.5 * vec2(-axis.y, axis.x), cascade, map.z));
    return lit * 0.25;
}

// Share of skylight that reaches a surface past buildings and roofs: each sample of the frame asks a
// quarter of the sky's directions, so that four samples ask all of them.
float sky_visibility(vec3 position, vec3 normal, ivec2 texel)
{
    const int start = int((hash_u3(uint(texel.x), uint(texel.y), 9u) + frame.sample_index) & 3u);
    const float turn = 6.2831853 * dither(texel.yx, frame.sample_index + 5u);
    const vec2 blur = vec2(cos(turn), sin(turn)) * (0.8 / float(textureSize(sky_visibility_map, 0).x));
    float open = 0.0;
    float total = 0.0;
    for (int k = 0; k < 4; ++k) {
        const int i = (start + k * (SKY_DIRECTIONS / 4)) % SKY_DIRECTIONS;
        const vec4 direction = frame.sky_direction[i];
        const float facing = dot(normal, direction.xyz);
        if (facing <= 0.0) continue;
        // Directions are spread by their cosine with the vertical: undone for other normals.
        const float weight = facing / max(direction.y, 0.2);
        const vec3 lifted = position + normal * (direction.w * 1.2) + direction.xyz * (direction.w * 0.8);
        const vec4 map = frame.sky_from_world[i] * vec4(lifted, 1.0);
        const bool inside = all(lessThanEqual(abs(map.xyz - 0.5), vec3(0.5)));
        const float seen =
            inside ? texture(sky_visibility_map, vec4(map.xy + blur, float(i), map.z)) : 1.0;
        open += weight * seen;
        total += weight;
    }
    return total > 0.0 ? open / total : 1.0;
}

#endif
