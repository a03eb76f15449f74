// What crystals on snow mirror of the sun beyond the mean of its lobe, which is taken from the darker ones.
vec3 sparkle(LitPoint p, float snow, float view_m)
{
    Lobe mirrors = p.lobe;
    mirrors.diffuse = vec3(0.0);
    const vec3 h = half_vector(p.view, frame.sun_direction);
    const float seen_m = pixel_width_m(frame, view_m) * inversesqrt(max(p.lobe.nv, 0.05));
    const vec2 lean = h.xz / max(abs(h.y), 0.2);
    const float lobe = ggx_distribution(clamp(dot(p.normal, h), 0.0, 1.0), p.roughness * p.roughness);
    const float over = snow_glints(p.position.xz, seen_m, lean, lobe) - 1.0;
    return shade_lobe(mirrors, frame.sun_direction) * (over * snow * frame.look.snow_sparkle);
}
