// An example of a light map that a surface of your own decodes: a directional one. Its left half holds
// the light, its right half the shares in which it comes from three sides (formulas/light/light_map.h),
// so that normal maps show in baked light, and smooth surfaces mirror it.
//
//   [materials."wall*"]
//   surface = "directional_light_map.glsl"
//   light_map_texture = "light_and_sides.exr"
#include "gpu/passes/surface/own_light_map.glsl"

void directional_light_map_input(inout SurfaceInput at) {}

void directional_light_map_surface(SurfaceInput at, inout SurfaceData data)
{
    if (!has(TEXTURE_LIGHT_MAP)) return;
    const vec3 color = light_map_part(at, 0, 2).rgb;
    const vec3 sides = light_map_part(at, 1, 2).rgb;
    const TangentFrame f = tangent_frame(at);
    const vec3 n = data.texel.base_normal;
    const vec3 bent = vec3(dot(n, f.tangent), dot(n, f.bitangent), dot(n, f.normal));
    data.texel.baked = baked_light(directional_light_map(color, sides, bent));

    // One highlight, where most of the light comes from: Blinn 1977, made so that it sends on no more
    // than it gets.
    const vec3 light = to_world(f, light_map_direction(sides));
    const float alpha = max(data.texel.roughness * data.texel.roughness, 0.02);
    const float power = 2.0 / (alpha * alpha) - 2.0;
    const float nh = saturate(dot(n, normalize(light + toward_eye(at))));
    const float lobe = (power + 8.0) / 8.0 * pow(nh, power) * saturate(dot(n, light));
    const vec3 f0 = mix(data.texel.f0, data.texel.base_color, data.texel.metallic);
    data.emission += baked_light(color) * f0 * lobe;
}
