// The light from all around that arrives at a surface: from patches, or from the sky.

// What near things leave of the light, by the picture.
float screen_open(ivec2 texel)
{
    const uint word = texelFetch(occlusion_words, occlusion_block(texel / OCCLUSION_BLOCK, frame.size)).r;
    return occlusion_of_word(word, uint(texel.x & 1) + 2u * uint(texel.y & 1));
}

// From the normal of the mesh to the middle of what they leave.
vec3 screen_lean(LitPoint p, float screen, ivec2 texel)
{
    if (!BENT_NORMALS) return vec3(0.0);
    const uint word = texelFetch(occlusion_words, bent_word(texel, frame.size)).r;
    const vec3 bent = bent_of_code(word >> 16 * (texel.x & 1) & 0xffffu);
    return screen < 0.996 ? bent - p.mesh_normal : vec3(0.0);  // a code is no finer than that
}

// From the patches around; nothing (open < 0) where there are none.
Ambient patch_ambient(LitPoint p, vec3 geometry, float crevices, float screen, float view_m,
                      ivec2 texel)
{
    const SpreadLight light = patch_light_at(p.position, geometry, p.normal, p.view, view_m, texel);
    Ambient a = Ambient(vec3(0.0), crevices, 1.0, vec3(1.0), light.irradiance, -1.0, vec3(0.0));
    if (light.open < 0.0) return a;
    a.irradiance = light.irradiance;
    // A mirror sees about as much more or less than sky as a matt surface does.
    const vec3 sky = sky_irradiance(p.normal);
    a.mirrored = clamp(light.irradiance / max(sky, vec3(1.0e-6)), vec3(0.0), vec3(2.0));
    if (AMBIENT_OCCLUSION != 0u) {
        // Relief smaller than a patch: what the pixel sees over what its patch does, both with the
        // light that crevices send back, both beyond what the point knows as close. The picture does not show
        // all that is near: it takes away only.
        const float own_open = open_beyond(screen, light.close);
        const float mean_open = open_beyond(light.open, light.close);
        const vec3 own = bounced_occlusion(p.albedo, own_open);
        const vec3 mean = bounced_occlusion(p.albedo, mean_open);
        const vec3 ratio = min(own / max(mean, vec3(0.05)), vec3(1.0));
        a.irradiance *= vec3(with_close_light(ratio.r, light.close_light),
                             with_close_light(ratio.g, light.close_light),
                             with_close_light(ratio.b, light.close_light));
        // What patches saw of near things is in the light that is mirrored, too.
        a.screen = with_close_light(min(own_open / max(mean_open, 0.05), 1.0), light.close_light);
        // Patches turn to the light that they get: what they saw leans no further.
        if (BENT_NORMALS) {
            a.lean = screen_lean(p, screen, texel) * clamp((1.0 - a.screen) / max(1.0 - screen, 0.004), 0.0, 1.0);
            a.irradiance *= clamp(1.0 + dot(light.turn, normalize(p.normal + a.lean) - p.normal), 0.5, 2.0);
        }
    }
    a.open = clamp(dot(a.irradiance, vec3(0.2126, 0.7152, 0.0722)) /
                       max(dot(sky, vec3(0.2126, 0.7152, 0.0722)), 1.0e-6),
                   0.0, 1.0);
    return a;
}

Ambient ambient_light(LitPoint p, vec3 geometry, float crevices, float screen, float view_m,
                      ivec2 texel)
{
    if (PATCHES != 0u) {
        const Ambient a = patch_ambient(p, geometry, crevices, screen, view_m, texel);
        if (a.open >= 0.0) return a;
        // Far from all patches: the open sky.
        const vec3 sky = sky_irradiance(p.normal);
        return Ambient(sky, crevices * screen, screen, vec3(1.0), sky, 1.0, vec3(0.0));
    }
    const float open =
        AMBIENT_OCCLUSION != 0u ? sky_visibility(p.position, geometry, texel) : 1.0;
    // Where the sky is hidden, walls and ground send some of its light on, warmer.
    const vec3 hidden = vec3(1.0, 0.93, 0.85) * frame.bounce;
    const vec3 seen = open + (1.0 - open) * hidden;
    const vec3 lean = AMBIENT_OCCLUSION != 0u ? screen_lean(p, screen, texel) : vec3(0.0);
    const vec3 sky = sky_irradiance(BENT_NORMALS ? normalize(p.normal + lean) : p.normal) * seen;
    return Ambient(sky, crevices * screen, screen, seen, sky, open, lean);
}
