// An example of a lighting model of your own: Minnaert's law (1941), between velvet and the moon.
//
//   [materials."curtain*"]
//   lighting_model = "minnaert.glsl"    # beside the scenario, or here among the data
//
// What a LitPoint holds and which functions a model has: gpu/lighting/models/lighting_model.glsl.
#include "gpu/lighting/models/lighting_model.glsl"

const float kMinnaert = 1.5;  // 1 is Lambert's law; above, edges darken; below, they shine

vec3 minnaert_light(LitPoint p, vec3 to_light)
{
    const float nl = clamp(dot(p.normal, to_light), 0.0, 1.0);
    const float nv = clamp(dot(p.normal, p.view), 0.02, 1.0);
    return p.albedo / kPi * pow(nl, kMinnaert) * pow(nv, kMinnaert - 1.0);
}

Reflected minnaert_surround(LitPoint p, Surroundings s)
{
    return Reflected(p.albedo * s.irradiance * bounced_occlusion(p.albedo, s.occlusion) * s.scale,
                     vec3(0.0));
}

vec3 minnaert_own(LitPoint p)
{
    return p.emission;
}
