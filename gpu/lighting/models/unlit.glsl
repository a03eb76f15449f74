// KHR_materials_unlit: the base colour as it is, whatever the light and the exposure. It is
// display-referred: divided by the exposure, so that 1 is exposed to 1 by day and by night.
#include "gpu/lighting/models/lighting_model.glsl"

vec3 unlit_light(LitPoint p, vec3 to_light)
{
    return vec3(0.0);
}

Reflected unlit_surround(LitPoint p, Surroundings s)
{
    return Reflected(vec3(0.0), vec3(0.0));
}

vec3 unlit_own(LitPoint p)
{
    return p.base_color / p.exposure + p.emission;
}
