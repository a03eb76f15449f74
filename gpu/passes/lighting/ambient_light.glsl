// The light from all around that arrives at a surface: from patches, or from the sky.

// What near things leave of the light, by the picture.
float screen_open(ivec2 texel)
{
    const uint word = texelFetch(occlusion_words, occlusion_block(texel / OCCLUSION_BLOCK, frame.size)).r;
    return occlusion_of_word(word, uint(texel.x & 1) + 2u * uint(texel.y & 1));
}

// From the patches around; nothing (open < 0) where there are none.
Ambient patch_ambient(LitPoint p, vec3 geometry, float crevices, float screen, float view_m,
                      ivec2 texel)
{
    const SpreadLight light = patch_light_at(p.position, geometry, p.normal, p.view, view_m, texel);
    Ambient a = Ambient(vec3(0.0), crevices, 1.0, vec3(1.0), light.irradiance, -1.0);
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
        return Ambient(sky, crevices * screen, screen, vec3(1.0), sky, 1.0);
    }
    const float open =
        AMBIENT_OCCLUSION != 0u ? sky_visibility(p.position, geometry, texel) : 1.0;
    // Where the sky is hidden, walls and ground send some of its light on, warmer.
    const vec3 hidden = vec3(1.0, 0.93, 0.85) * frame.bounce;
    const vec3 seen = open + (1.0 - open) * hidden;
    const vec3 sky = sky_irradiance(p.normal) * seen;
    return Ambient(sky, crevices * screen, screen, seen, sky, open);
}
