// The base colour as it is (unlit.glsl), darkened by seven tenths where the sun's shadow falls: for painted
// grounds and backdrops that things stand on.
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
    return p.base_color * mix(1.0 - kUnlitShadow, 1.0, p.sunlit) / p.exposure + p.emission;
}
