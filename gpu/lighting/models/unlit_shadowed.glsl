// The base colour as it is (unlit.glsl), darkened by seven tenths where shadows take all light of sun and lamps that
// would fall on it, and by as much less as they leave: for painted grounds and backdrops that things stand on.
#include "gpu/lighting/models/lighting_model.glsl"

const float kUnlitShadow = 0.7;

vec3 unlit_shadowed_light(LitPoint p, vec3 to_light)
{
    return vec3(0.0);
}

Reflected unlit_shadowed_surround(LitPoint p, Surroundings s)
{
    return Reflected(vec3(0.0), vec3(0.0));
}

vec3 unlit_shadowed_own(LitPoint p)
{
    return p.base_color * mix(1.0 - kUnlitShadow, 1.0, p.left) / p.exposure + p.emission;
}
