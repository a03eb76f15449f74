// What shadows leave of the light of sun and lamps, for unlit_shadowed, which has no light of its own to lose. Included by the
// lighting pass; left out where nothing in the picture is of that model.
#ifndef PETRICHOR_LEFT_BY_SHADOWS_GLSL
#define PETRICHOR_LEFT_BY_SHADOWS_GLSL

// Luminance of what falls on the surface.
float falling(LitPoint p, vec3 sunlight, float lamps, bool there, ivec2 texel)
{
    vec3 light = sunlight * max(dot(p.normal, frame.sun_direction), 0.0);
    add_lights(light, p, lamps, there, texel);
    return dot(light, vec3(0.2126, 0.7152, 0.0722));
}

// Share of what would fall on it without shadows; 1 where nothing would. All pixels go through: a group of them shares its lamps.
float left_by_shadows(LitPoint p, float view_m, float lamps, bool there, ivec2 texel)
{
    p.gathers = GATHERS_FALLING;
    p.film = WaterFilm(0.0, 1.0, 0.0, 0.0, p.normal);
    p.translucency.strength = 0.0;
    vec3 sunlight = vec3(0.0);
    if (SUN != 0u) sunlight = frame.sun_illuminance * sun_cookie(p.position, view_m);
    const float seen = falling(p, sunlight * p.sunlit, lamps, there, texel);
    p.unshadowed = true;
    const float all = falling(p, sunlight, lamps, there, texel);
    return all > 0.0 ? min(seen / all, 1.0) : 1.0;
}

#endif
