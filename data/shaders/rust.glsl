// An example of a surface of your own: iron that rusts, most where water runs down and stands.
//
//   [materials."*post"]
//   surface = "rust.glsl"
#include "gpu/passes/surface/own_surface.glsl"

float rust_at(SurfaceInput at)
{
    const float spots = tileable_noise(at.position.xz * 11.0 + at.position.y * 3.0, 1024, 21u);
    const float runs = tileable_noise(vec2(at.position.x + at.position.z, 0.15 * at.position.y) * 14.0,
                                      1024, 22u);
    return smooth_edge(0.45, 0.7, 0.5 * spots + 0.4 * runs + 0.15 * saturate(at.normal.y));
}

void rust_input(inout SurfaceInput at) {}

void rust_surface(SurfaceInput at, inout SurfaceData data)
{
    const float rust = rust_at(at);
    const float dark = tileable_noise(at.position.xz * 47.0 + at.position.y * 31.0, 4096, 23u);
    data.texel.base_color =
        mix(data.texel.base_color, mix(vec3(0.17, 0.06, 0.02), vec3(0.35, 0.13, 0.04), dark), rust);
    data.texel.metallic *= 1.0 - rust;
    data.texel.roughness = mix(data.texel.roughness, 0.9, rust);
    data.texel.porosity = mix(data.texel.porosity, 0.8, rust);
}
