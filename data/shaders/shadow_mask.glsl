// An example of shadows that are partly baked: the left half of the map holds what comes round corners, its
// right half how much is seen of the sun (red) and of lamps (green, blue, alpha, by their mask_channel). Near
// the camera real-time shadows count, far away the baked ones; light and highlights are real-time everywhere.
// Of lamps whose shadows are not drawn in real time the baked ones count near by, too.
//
//   [materials."wall*"]
//   surface = "shadow_mask.glsl"
//   light_map_texture = "mixed.exr"    # `petrichor scene --bake shadow_mask`
#include "gpu/passes/surface/own_light_map.glsl"

const float kRealTimeUntil_m = 30.0;
const float kBakedFrom_m = 60.0;

void shadow_mask_input(inout SurfaceInput at) {}

void shadow_mask_surface(SurfaceInput at, inout SurfaceData data)
{
    if (!has(TEXTURE_LIGHT_MAP)) return;
    data.texel.baked = baked_light(light_map_part(at, 0, 2).rgb);
    const float fade =
        light_map_fade(length(frame.camera_m - at.position), kRealTimeUntil_m, kBakedFrom_m);
    map_shadows(data, light_map_part(at, 1, 2), fade);
}
