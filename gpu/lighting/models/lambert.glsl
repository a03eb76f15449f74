// A perfect diffuser: all of its albedo, nothing mirrored, neither of lights nor of the surroundings.
#include "gpu/lighting/models/lighting_model.glsl"

vec3 lambert_light(LitPoint p, vec3 to_light)
{
    return p.albedo * (clamp(dot(p.normal, to_light), 0.0, 1.0) / kPi);
}

Reflected lambert_surround(LitPoint p, Surroundings s)
{
    return Reflected(p.albedo * s.irradiance * bounced_occlusion(p.albedo, s.occlusion) *
                         s.scale,
                     vec3(0.0));
}

vec3 lambert_own(LitPoint p)
{
    return p.emission;
}
