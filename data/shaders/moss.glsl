// An example of a surface of your own: moss where a stone or a wall stays damp. It grows on what faces
// the sky and at the foot of the scene, in cushions; puddles do not stand on it.
//
//   [materials."stone*"]
//   surface = "moss.glsl"    # beside the scenario, or here among the data
//
// What the two functions may change: gpu/passes/surface/own_surface.glsl.
#include "gpu/passes/surface/own_surface.glsl"

const vec3 kMossColor = vec3(0.065, 0.105, 0.02);

// Cushions of two sizes, in space: a picture laid over ground and walls alike would be drawn out on one of them.
float moss_lumps(vec3 p) { return 0.6 * endless_noise_3(p * 2.3 + 3.0, 5u) + 0.4 * endless_noise_3(p * 7.0, 6u); }

// bare: 0 in joints and hollows .. 1 on what stands out of them.
float moss_at(SurfaceInput at, float bare)
{
    const float damp = 0.6 * saturate(at.normal.y) + 0.5 * exp(-1.1 * max(at.position.y, 0.0));
    return smooth_edge(0.73, 0.87, 1.1 * moss_lumps(at.position) + 0.28 * damp + 0.3 * min(1.0 - bare, 0.5));
}

void moss_input(inout SurfaceInput at)
{
    at.weather.g *= 1.0 - moss_at(at, 0.7);
}

void moss_surface(SurfaceInput at, inout SurfaceData data)
{
    const vec3 p = at.position;
    const float moss = moss_at(at, data.texel.occlusion);
    // Cushions bulge, and are darker at their rims; tufts on them are seen from near.
    const float here = endless_noise_3(p * 14.0, 7u);
    const vec3 slope = vec3(endless_noise_3(p * 14.0 + vec3(0.2, 0.0, 0.0), 7u), endless_noise_3(p * 14.0 + vec3(0.0, 0.2, 0.0), 7u),
                            endless_noise_3(p * 14.0 + vec3(0.0, 0.0, 0.2), 7u)) - here;
    const float tuft = endless_noise_3(p * 70.0, 8u);
    const vec3 young = vec3(0.105, 0.120, 0.022);
    const vec3 color = mix(kMossColor, young, smooth_edge(0.45, 0.75, moss_lumps(p * 0.6 + 3.0)));
    data.texel.base_color = mix(data.texel.base_color, color * (0.35 + 0.7 * here + 0.5 * tuft), moss);
    data.texel.base_normal = normalize(mix(data.texel.base_normal, at.normal - 3.5 * (slope - at.normal * dot(slope, at.normal)), moss));
    data.texel.roughness = mix(data.texel.roughness, 0.95, moss);
    data.texel.metallic *= 1.0 - moss;
    data.texel.porosity = mix(data.texel.porosity, 1.0, moss);
    data.texel.occlusion *= 1.0 - 0.5 * moss * (1.0 - here);
}
