// Hair: two highlights along the strands, which lie along the tangent (anisotropy_rotation turns it): one
// of their surface, one through them and coloured (formulas/light/other_lobes.h).
#include "gpu/lighting/models/lighting_model.glsl"
#include "gpu/lighting/models/standard.glsl"

// Strands hide each other: so much is scattered between them.
const float kHairDiffuse = 0.4;

vec3 hair_light(LitPoint p, vec3 to_light)
{
    // A film over the strands colours them by the half vector.
    vec3 f0 = vec3(kHairReflectance);
    if (p.thin_film.share > 0.0)
        f0 = clamp(f0 + filmed_f0(p.thin_film, clamp(sqrt(0.5 + 0.5 * dot(p.view, to_light)), 0.02, 1.0)) - p.thin_film.f0, vec3(0.0), vec3(1.0));
    return shade_hair(p.normal, p.layers.tangent, p.view, to_light, p.diffuse * kHairDiffuse,
                      p.base_color, f0, p.roughness, p.hair_shift);
}

Reflected hair_surround(LitPoint p, Surroundings s)
{
    Reflected r = standard_surround(p, s);
    // A highlight that is as wide as the sky across the strands.
    r.radiance *= mix(kHairDiffuse, 1.0, 0.5);
    r.mirror *= 0.5;
    return r;
}

vec3 hair_own(LitPoint p)
{
    return p.emission;
}
