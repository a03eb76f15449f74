// The Blinn-Phong model that surface shaders of Unity have built in (Blinn 1977), to compare with scenes that were made
// for it: albedo n.l + specular (n.h)^(128 shininess), a pi-th of it per lux. Shininess is 1 less the roughness, the
// colour of the highlight the reflectance at normal incidence. As there it mirrors no surroundings, and highlights of
// smooth things may send out more than comes in.
//
//   [materials."*"]
//   lighting_model = "blinn_phong.glsl"    # beside the scenario, or here among the data
//
// It gathers light first, as in a pre-pass, or answers light by light ([render] lighting_path): the same picture, since
// what is gathered of highlights keeps the colour of each light.
#include "gpu/lighting/models/lighting_model.glsl"

LightSum blinn_phong_gather(LitPoint p, vec3 to_light)
{
    const float nl = max(dot(p.normal, to_light), 0.0);
    const float nh = max(dot(p.normal, normalize(to_light + p.view)), 0.0);
    const float power = max(128.0 * (1.0 - p.roughness), 1.0);
    return LightSum(vec3(nl), vec3(nl > 0.0 ? pow(nh, power) : 0.0));
}

vec3 blinn_phong_compose(LitPoint p, LightSum sum)
{
    return (p.albedo * sum.diffuse + p.specular * sum.specular) / kPi;
}

Reflected blinn_phong_surround(LitPoint p, Surroundings s)
{
    return Reflected(p.albedo * s.irradiance * bounced_occlusion(p.albedo, s.occlusion) * s.scale, vec3(0.0));
}

vec3 blinn_phong_own(LitPoint p)
{
    return p.emission;
}
