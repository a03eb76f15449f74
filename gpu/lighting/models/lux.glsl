// The standard model of Lux 2.02, which is that of Unity 5.6 (formulas/light/other_lobes.h), for parity.
// `[render] ambient_fit` chooses how it mirrors surroundings.
#include "gpu/lighting/models/lighting_model.glsl"

vec3 lux_light(LitPoint p, vec3 to_light)
{
    return shade_lux(p.normal, p.view, to_light, p.diffuse, p.specular, p.roughness);
}

Reflected lux_surround(LitPoint p, Surroundings s)
{
    Reflected r;
    r.radiance = p.diffuse * s.irradiance * s.occlusion * s.scale;
    r.mirror = (p.specular * s.split_sum.x + vec3(s.split_sum.y)) * (s.specular_occlusion * s.scale);
    return r;
}

vec3 lux_own(LitPoint p)
{
    return p.emission;
}
