// Minimalist Cook-Torrance of Unity's lightweight pipeline, with the answer to surroundings that goes
// with it (formulas/light/other_lobes.h): to compare with pictures of that pipeline.
#include "gpu/lighting/models/lighting_model.glsl"

vec3 lwrp_light(LitPoint p, vec3 to_light)
{
    return shade_lwrp(p.normal, p.view, to_light, p.diffuse, p.specular, p.roughness * p.roughness);
}

Reflected lwrp_surround(LitPoint p, Surroundings s)
{
    const float alpha = p.roughness * p.roughness;
    const float nv = clamp(dot(p.normal, p.view), 0.0, 1.0);
    const float most = max(p.specular.r, max(p.specular.g, p.specular.b));
    const float grazing = clamp(1.0 - p.roughness + most, 0.0, 1.0);
    const float turned = (1.0 - nv) * (1.0 - nv);
    Reflected r;
    r.radiance = p.diffuse * s.irradiance * s.occlusion * s.scale;
    r.mirror = mix(p.specular, vec3(grazing), turned * turned) *
               (s.specular_occlusion * s.scale / (alpha * alpha + 1.0));
    return r;
}

vec3 lwrp_own(LitPoint p)
{
    return p.emission;
}
