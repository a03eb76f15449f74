// Hair: two highlights along the strands, which lie along the tangent (anisotropy_rotation turns it): one
// of their surface, one through them and coloured (formulas/light/other_lobes.h).
#include "gpu/lighting/models/lighting_model.glsl"
#include "gpu/lighting/models/standard.glsl"

// Strands hide each other: so much is scattered between them.
const float kHairDiffuse = 0.4;

vec3 hair_light(LitPoint p, vec3 to_light)
{
    return shade_hair(p.normal, p.layers.tangent, p.view, to_light, p.diffuse * kHairDiffuse,
                      p.base_color, p.roughness, p.hair_shift);
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
