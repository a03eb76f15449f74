// An example of a light map that a surface of your own decodes: a dual one. Its left half holds what
// comes round corners, for places where sun and lamps shine in real time; its right half holds all
// light, for places so far away that they need not.
//
//   [materials."wall*"]
//   surface = "dual_light_map.glsl"
//   light_map_texture = "near_and_far.exr"    # `petrichor scene --bake indirect`, `--bake light_map`
#include "gpu/passes/surface/own_light_map.glsl"

const float kRealTimeUntil_m = 20.0;
const float kBakedFrom_m = 40.0;

void dual_light_map_input(inout SurfaceInput at) {}

void dual_light_map_surface(SurfaceInput at, inout SurfaceData data)
{
    if (!has(TEXTURE_LIGHT_MAP)) return;
    // In steps of the code, so that what the map gains is what sun and lamps lose.
    const float fade = baked_shadow_step(
        light_map_fade(length(frame.camera_m - at.position), kRealTimeUntil_m, kBakedFrom_m));
    data.texel.baked = baked_light(
        dual_light_map(light_map_part(at, 0, 2).rgb, light_map_part(at, 1, 2).rgb, fade));
    map_holds_direct(data, fade);
}
