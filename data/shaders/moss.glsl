// An example of a surface of your own: moss where a stone or a wall stays damp. It grows on what faces
// the sky and at the foot of the scene, in cushions; puddles do not stand on it.
//
//   [materials."stone*"]
//   surface = "moss.glsl"    # beside the scenario, or here among the data
//
// What the two functions may change: gpu/passes/surface/own_surface.glsl.
#include "gpu/passes/surface/own_surface.glsl"

const vec3 kMossColor = vec3(0.065, 0.105, 0.02);

float moss_at(SurfaceInput at)
{
    const vec2 p = at.position.xz + at.position.y * vec2(0.7, 0.4);
    const float cushions = 0.6 * tileable_noise(p * 1.7, 1024, 5u) + 0.4 * tileable_noise(p * 9.0, 1024, 6u);
    const float damp = 0.55 * saturate(at.normal.y) + 0.45 * exp(-0.8 * max(at.position.y, 0.0));
    return smooth_edge(0.55, 0.75, cushions * 0.7 + damp * 0.5);
}

void moss_input(inout SurfaceInput at)
{
    at.weather.g *= 1.0 - moss_at(at);
}

void moss_surface(SurfaceInput at, inout SurfaceData data)
{
    const float moss = moss_at(at);
    const float tuft = tileable_noise(at.position.xz * 60.0 + at.position.y * 43.0, 4096, 7u);
    data.texel.base_color = mix(data.texel.base_color, kMossColor * (0.5 + tuft), moss);
    data.texel.roughness = mix(data.texel.roughness, 0.95, moss);
    data.texel.metallic *= 1.0 - moss;
    data.texel.porosity = mix(data.texel.porosity, 1.0, moss);
    data.texel.occlusion *= 1.0 - 0.3 * moss * (1.0 - tuft);
}
