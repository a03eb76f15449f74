// Sun and lamps on lighting models of users' own that gather light first and are composed with their material
// once. Included by the lighting pass; left out where nothing in the picture has such a model.
#ifndef PETRICHOR_GATHERED_LIGHT_GLSL
#define PETRICHOR_GATHERED_LIGHT_GLSL

// Film and what comes through a surface are no part of the model: they lie in every sum alike.
const bool COVERED = FILM != 0u || BLEEDS;

// One of the sums over sun and lamps.
vec3 gathered_part(LitPoint p, uint part, vec3 sunlight, float lamps, bool there, ivec2 texel)
{
    if (p.gathers != GATHERS_NOTHING_FIRST) p.gathers = part;
    vec3 light = shadowed_light(p, frame.sun_direction, p.sunlit) * sunlight;
    add_lights(light, p, lamps, there, texel);
    return light;
}

struct Gathered {
    LightSum sum;
    vec3 rest;  // radiance beside the model's
};

// `diffuse` is the sum that was taken already. All pixels go through: a group of them shares its lamps.
Gathered gather_rest(LitPoint p, vec3 diffuse, vec3 sunlight, float lamps, bool there, ivec2 texel)
{
    Gathered all;
    all.rest = COVERED ? gathered_part(p, GATHERS_REST, sunlight, lamps, there, texel) : vec3(0.0);
    all.sum.diffuse = diffuse - all.rest;
    all.sum.specular = gathered_part(p, GATHERS_SPECULAR, sunlight, lamps, there, texel) - all.rest;
    return all;
}

#endif
