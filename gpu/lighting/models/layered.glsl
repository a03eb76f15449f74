// The standard model with what lies over and in it: clear coat, sheen, anisotropic highlights, light
// through thin sheets (formulas/light/layers.h), a second lobe of its texels (formulas/light/two_lobes.h). Materials that have one of these get it unless they
// name another. Its mirror image of the surroundings is that of the base; the pass adds the coat's.
#include "gpu/lighting/models/lighting_model.glsl"

vec3 layered_light(LitPoint p, vec3 to_light)
{
    Lobe lobe = p.lobe;
    vec3 base;
    if (p.second.share > 0.0) {
        base = shade_two_lobes(lobe, p.second.lobe, p.second.share, p.normal, to_light);
        lobe.normal = p.normal;
    } else {
        base = shade_lobe(lobe, to_light);
    }
    return shade_layers_over(base, lobe, to_light, p.roughness, p.layers);
}

Reflected layered_surround(LitPoint p, Surroundings s)
{
    const vec3 single = p.specular * s.split_sum.x + vec3(s.split_sum.y);
    const float lost = 1.0 - (s.split_sum.x + s.split_sum.y);
    const vec3 average = p.specular + (vec3(1.0) - p.specular) * (1.0 / 21.0);
    const vec3 multiple = single * average * lost / (vec3(1.0) - average * lost);
    const float nv = clamp(dot(p.normal, p.view), 0.0, 1.0);
    const float fibres = min(sheen_albedo(nv, p.layers.sheen_roughness), 1.0);
    const float below =
        1.0 - fibres * max(p.layers.sheen.x, max(p.layers.sheen.y, p.layers.sheen.z));
    const vec3 through = p.albedo * (vec3(1.0) - single - multiple);
    const vec3 front = multiple + through * (1.0 - p.layers.transmitted);
    Reflected r;
    r.radiance = (front * below + p.layers.sheen * fibres) * s.irradiance *
                 bounced_occlusion(p.albedo, s.occlusion) * s.scale;
    // Of what comes from behind as much is left as from before.
    const float left = max(1.0 - max(p.specular.r, max(p.specular.g, p.specular.b)), 1.0e-3);
    const vec3 behind = p.layers.through * (vec3(1.0) - single - multiple) / left;
    r.radiance += behind * p.layers.transmitted * below * s.irradiance_behind * s.occlusion * s.scale;
    r.mirror = single * (below * s.specular_occlusion * s.scale);
    return r;
}

vec3 layered_own(LitPoint p)
{
    return p.emission;
}
