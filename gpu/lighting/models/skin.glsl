// Skin: a diffuse answer that was integrated over round surfaces beforehand, so that red light goes on
// past the terminator where the surface curves (formulas/light/skin.h); the standard highlight. Light that
// comes through ears and fingers is the pass's (translucency_...).
#include "gpu/lighting/models/lighting_model.glsl"
#include "gpu/lighting/models/standard.glsl"

vec3 skin_light(LitPoint p, vec3 to_light)
{
    const float nl = dot(p.normal, to_light);
    const vec3 all = shade_lobe(p.lobe, to_light);
    const float soft = dot(p.layers.other_normal, to_light);
    return all + p.lobe.diffuse * (skin_lookup(soft, p.curvature) - vec3(clamp(nl, 0.0, 1.0)));
}

Reflected skin_surround(LitPoint p, Surroundings s)
{
    return standard_surround(p, s);
}

vec3 skin_own(LitPoint p)
{
    return p.emission;
}
