// An example of a lighting model that gathers light first: bands, as a painter of cels has them, over the
// sum of all lights, so that two lamps together step up where each alone would not.
//
//   [materials."lantern*"]
//   lighting_model = "toon.glsl"    # beside the scenario, or here among the data
//
// What a LitPoint holds and which functions a model has: gpu/lighting/models/lighting_model.glsl.
#include "gpu/lighting/models/lighting_model.glsl"

const float kToonBands = 4.0;   // from black to what the display shows as white
const float kToonEdge = 0.08;   // of a band: soft enough for an edge without stairs
const float kToonShine = 0.55;  // of a highlight's peak: brighter is white

// How far up the bands a brightness of 0 (black) .. 1 (white) is.
float toon_step(float bright)
{
    const float at = max(bright, 0.0) * kToonBands;
    return (floor(at) + smoothstep(1.0 - kToonEdge, 1.0, fract(at))) / kToonBands;
}

LightSum toon_gather(LitPoint p, vec3 to_light)
{
    const float nl = clamp(dot(p.normal, to_light), 0.0, 1.0);
    const float nh = clamp(dot(p.normal, normalize(to_light + p.view)), 0.0, 1.0);
    const float alpha = p.roughness * p.roughness;
    return LightSum(vec3(nl), vec3(nl > 0.0 ? pow(nh, 2.0 / (alpha * alpha)) : 0.0));
}

vec3 toon_compose(LitPoint p, LightSum sum)
{
    const vec3 matt = sum.diffuse / kPi;
    const float lit = dot(matt, vec3(0.2126, 0.7152, 0.0722));
    const float shown = lit * p.exposure;
    const vec3 color = matt / max(lit, 1.0e-6);
    const float shine = dot(sum.specular, vec3(0.2126, 0.7152, 0.0722)) / kPi * p.exposure;
    const float spot = smoothstep(kToonShine, kToonShine * (1.0 + kToonEdge), shine);
    const float white = 1.0 / max(p.exposure, 1.0e-20);
    return p.albedo * color * (toon_step(shown) * white) + color * (spot * white * (1.0 - p.roughness));
}

Reflected toon_surround(LitPoint p, Surroundings s)
{
    return Reflected(p.albedo * s.irradiance * bounced_occlusion(p.albedo, s.occlusion) * s.scale,
                     vec3(0.0));
}

vec3 toon_own(LitPoint p)
{
    return p.emission;
}
