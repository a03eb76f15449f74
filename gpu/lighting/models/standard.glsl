// glTF's metallic-roughness: GGX over Lambert.
#ifndef PETRICHOR_GPU_LIGHTING_STANDARD_GLSL
#define PETRICHOR_GPU_LIGHTING_STANDARD_GLSL

#include "gpu/lighting/models/lighting_model.glsl"

vec3 standard_light(LitPoint p, vec3 to_light)
{
    return shade_lobe(p.lobe, to_light);
}

Reflected standard_surround(LitPoint p, Surroundings s)
{
    // Energy that one bounce loses comes back (Fdez-Aguera 2019).
    const vec3 single = p.specular * s.split_sum.x + vec3(s.split_sum.y);
    const float lost = 1.0 - (s.split_sum.x + s.split_sum.y);
    const vec3 average = p.specular + (vec3(1.0) - p.specular) * (1.0 / 21.0);
    const vec3 multiple = single * average * lost / (vec3(1.0) - average * lost);
    Reflected r;
    r.radiance = (multiple + p.albedo * (vec3(1.0) - single - multiple)) * s.irradiance *
                 bounced_occlusion(p.albedo, s.occlusion) * s.scale;
    r.mirror = single * (s.specular_occlusion * s.scale);
    return r;
}

vec3 standard_own(LitPoint p)
{
    return p.emission;
}

#endif
