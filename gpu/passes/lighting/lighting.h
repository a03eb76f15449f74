#ifndef PETRICHOR_GPU_PASSES_LIGHTING_LIGHTING_H
#define PETRICHOR_GPU_PASSES_LIGHTING_LIGHTING_H

#include <optional>

#include "gpu/frame/pixel_list.h"
#include "gpu/passes/depth_maps/depth_maps.h"
#include "gpu/passes/lamp_shadows/lamp_shadows.h"
#include "gpu/passes/lighting/light_tables.h"
#include "gpu/passes/lights/lights.h"
#include "gpu/passes/reflections/probe_table.h"
#include "gpu/passes/sky/sky.h"

namespace petrichor::gpu {

inline constexpr const char* kLightingShader = "lighting.comp";
/// With users' own models in it; added to the pipelines when a scene has some.
inline constexpr const char* kOwnLightingShader = "own_lighting.comp";

/// What a frame wants of the lighting pass; each choice is a compiled variant.
struct LightingVariant {
    bool weather = true;
    bool shadows = true;
    bool image_based_light = true;
    bool mirrors_picture = true;  ///< the reflections behind it do
    bool ambient_occlusion = true;
    bool bent_normals = false;  ///< the occlusion has some
    bool emission = true;
    std::uint32_t baked = 0;  ///< LIGHTING_BAKED_..
    bool gamma = false;
    bool patch_light = false;
    bool lamp_shadows = false;
    bool soft_lamps = false;  ///< shadows are seen from other points than the lamps' middles
    bool rectangles = false;  ///< some lights are surfaces that glow
    std::uint32_t ways = 0;   ///< LIGHTS_... of the lights
    bool night = false;       ///< stars and moon may be seen
    bool fog = false;
    bool gusts = false;       ///< the fog is thick in places
    bool sun = true;          ///< it shines
    bool background = true;   ///< the sky is seen where there is no surface
    std::optional<float> skyline_from_m;  ///< Sky::skyline_from_m, where there is one
    bool lazarov = false;     ///< FrameSettings::lazarov
    bool horizon = false;     ///< of the mesh
    bool grain = false;       ///< FrameSettings::anisotropic_dither
    Pixels pixels = Pixels::All;
    bool all_lights = false;  ///< without lists: what they are tested against
    std::string shader = kLightingShader;
    bool snow_scatter = false;  ///< snow is seen, and its scatter has a colour
    bool sparkle = false;       ///< snow is seen under the sun
    bool ice = false;           ///< water that stands is frozen
    bool film = false;               ///< of water, a lobe of its own
    bool split = false;              ///< the light is written taken apart, too: into `parts`
    GpuImage* parts = nullptr;       ///< never null in a pass (gpu/outputs/light_parts.h)
    GpuImage* shares = nullptr;      ///< of textures of layers; null: there are none
    std::uint32_t layers = 0;        ///< LAYERS_... of what is in the picture
    std::vector<bool> models{true};  ///< by number: something in the picture has it
    bool gathers = false;  ///< one of them gathers light before its material is asked
};

// Where a surface is: applies weather to the dry material, then light, and adds the sample to the sum.
//
//   reads    the G-buffer, depth_rows, surface_tiles, screen_occlusion, shadow, lamp_shadows, sky maps, light lists, patch_points
//   writes   radiance, mirror_list and for its pixels mirror_weight and mirror_shape for the reflections, with image-based light
//   edits    accumulated; light_parts of frames that ask
void add_lighting(FrameGraph& graph, FrameTargets& targets, const GpuScene& scene,
                  LightTable& lights, LightTables& light_tables, SkyMaps& sky,
                  DepthMaps& depth_maps, LampShadows& lamp_shadows, const ProbeTable& probes,
                  const ConstantsRange& constants, const LightingVariant& variant);

}  // namespace petrichor::gpu

#endif
