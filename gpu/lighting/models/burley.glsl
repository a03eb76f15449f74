// Disney's diffuse under the standard highlight (Burley 2012): rough surfaces are brighter at grazing
// angles, up to 1.4 times what comes in.
#include "gpu/lighting/models/lighting_model.glsl"
#include "gpu/lighting/models/standard.glsl"

vec3 burley_light(LitPoint p, vec3 to_light)
{
    return shade_burley(p.normal, p.view, to_light, p.diffuse, p.specular, p.roughness);
}

Reflected burley_surround(LitPoint p, Surroundings s)
{
    return standard_surround(p, s);
}

vec3 burley_own(LitPoint p)
{
    return p.emission;
}
