// Constants of one material, as the surface passes read them. What a property means: its row in
// scene/material_table.h, by the same name. A row without a field here is not shaded, or is part of
// the pipeline's state.
#ifndef PETRICHOR_GPU_UPLOAD_MATERIAL_IO_H
#define PETRICHOR_GPU_UPLOAD_MATERIAL_IO_H

#include "base/interop.h"

// X(type, name); uint: a flag or the index of a choice.
#define MATERIAL_FIELDS(X)         \
    X(vec4, base_color_factor)     \
    X(float, metallic_factor)      \
    X(float, roughness_factor)     \
    X(float, normal_scale)         \
    X(float, occlusion_strength)   \
    X(vec3, emissive_factor)       \
    X(float, emissive_strength)    \
    X(uint, alpha_mode)            \
    X(float, alpha_cutoff)         \
    X(float, ior)                  \
    X(float, specular_factor)      \
    X(vec3, specular_color_factor) \
    X(float, transmission_factor)  \
    X(float, thickness_factor)     \
    X(float, attenuation_distance) \
    X(vec3, attenuation_color)     \
    X(uint, premultiplied_alpha)   \
    X(float, dispersion)           \
    X(vec3, workflow_specular_factor) \
    X(float, glossiness_factor)    \
    X(float, iridescence_factor)   \
    X(float, iridescence_ior)      \
    X(float, iridescence_thickness_minimum) \
    X(float, iridescence_thickness_maximum) \
    X(float, clearcoat_normal_scale) \
    X(float, skin_blur)            \
    X(float, vertex_occlusion)     \
    X(float, clearcoat_factor)     \
    X(float, clearcoat_roughness_factor) \
    X(vec3, sheen_color_factor)    \
    X(float, sheen_roughness_factor) \
    X(float, anisotropy_strength)  \
    X(float, anisotropy_rotation)  \
    X(float, diffuse_transmission_factor) \
    X(float, porosity)             \
    X(float, film)                 \
    X(float, beads)                \
    X(float, default_height)       \
    X(float, hollow_tiling)        \
    X(float, height_scale_m)       \
    X(float, parallax_steps)       \
    X(float, parallax_level)       \
    X(float, water_slope_damp)     \
    X(vec4, water_accumulation)    \
    X(vec4, water_color)           \
    X(float, ripple_refraction)    \
    X(float, flow_tiling)          \
    X(float, flow_speed)           \
    X(float, flow_interval_s)      \
    X(float, flow_refraction)      \
    X(float, flow_normal_strength) \
    X(float, snow_slope_damp)      \
    X(vec2, snow_accumulation)     \
    X(float, snow_normal_strength) \
    X(float, snow_detail_strength) \
    X(float, snow_opacity)         \
    X(vec4, snow_local_tiling)     \
    X(float, snow_mask_normal_scale) \
    X(float, mix_factor)           \
    X(vec3, second_color_factor)   \
    X(float, second_metallic_factor) \
    X(float, second_roughness_factor) \
    X(float, second_specular_factor) \
    X(float, second_normal_scale)  \
    X(uint, second_occlusion_in_alpha) \
    X(vec4, second_water_accumulation) \
    X(vec4, second_water_color)    \
    X(vec3, third_color_factor)    \
    X(float, third_roughness_factor) \
    X(vec3, fourth_color_factor)   \
    X(float, fourth_roughness_factor) \
    X(float, layers_by_height)     \
    X(float, far_start_m)          \
    X(float, far_fade_m)           \
    X(uint, sheltered)             \
    X(float, light_map_scale)      \
    X(float, light_map_sky)        \
    X(vec4, decal_weights)         \
    X(float, decal_reach_m)

// X(slot, name): the name is that of the row in material_textures() and of the sampler, whose
// binding in the material's set is 1 + slot.
#define MATERIAL_TEXTURES(X)         \
    X(0, base_color_texture)         \
    X(1, normal_texture)             \
    X(2, metallic_roughness_texture) \
    X(3, occlusion_texture)          \
    X(4, emissive_texture)           \
    X(5, height_texture)             \
    X(6, puddle_mask_texture)        \
    X(7, snow_mask_texture)          \
    X(8, light_map_texture)      \
    X(9, snow_mask_normal_texture) \
    X(10, mix_mask_texture)      \
    X(11, second_base_color_texture) \
    X(12, second_normal_texture) \
    X(13, second_metallic_roughness_texture) \
    X(14, second_height_texture) \
    X(15, far_texture)
#define TEXTURE_BASE_COLOR 0
#define TEXTURE_NORMAL 1
#define TEXTURE_METALLIC_ROUGHNESS 2
#define TEXTURE_OCCLUSION 3
#define TEXTURE_EMISSIVE 4
#define TEXTURE_HEIGHT 5
#define TEXTURE_PUDDLE_MASK 6
#define TEXTURE_SNOW_MASK 7
#define TEXTURE_LIGHT_MAP 8
#define TEXTURE_SNOW_MASK_NORMAL 9
#define TEXTURE_MIX_MASK 10
#define TEXTURE_SECOND_BASE_COLOR 11
#define TEXTURE_SECOND_NORMAL 12
#define TEXTURE_SECOND_METALLIC_ROUGHNESS 13
#define TEXTURE_SECOND_HEIGHT 14
#define TEXTURE_FAR 15
#define TEXTURE_SLOTS 16

// Textures of layers share a few slots behind those: a device may have no more than 32 samplers a stage.
// A material's are in the slots in this order; which is where its roles say.
// X(role, name): the name is that of the row in material_textures().
#define LAYER_TEXTURES(X)                \
    X(0, clearcoat_texture)              \
    X(1, clearcoat_roughness_texture)    \
    X(2, clearcoat_normal_texture)       \
    X(3, sheen_color_texture)            \
    X(4, sheen_roughness_texture)        \
    X(5, anisotropy_texture)             \
    X(6, diffuse_transmission_texture)   \
    X(7, translucency_texture)           \
    X(8, skin_curvature_texture)         \
    X(9, transmission_texture)           \
    X(10, thickness_texture)             \
    X(11, specular_texture)              \
    X(12, specular_color_texture)        \
    X(13, iridescence_texture)           \
    X(14, iridescence_thickness_texture) \
    X(15, specular_glossiness_texture)   \
    X(16, third_base_color_texture)      \
    X(17, third_normal_texture)          \
    X(18, third_metallic_roughness_texture) \
    X(19, fourth_base_color_texture)     \
    X(20, fourth_normal_texture)         \
    X(21, fourth_metallic_roughness_texture) \
    X(22, second_lobe_texture)           \
    X(23, diffuse_transmission_color_texture)
#define LAYER_TEXTURE_CLEARCOAT 0
#define LAYER_TEXTURE_CLEARCOAT_ROUGHNESS 1
#define LAYER_TEXTURE_CLEARCOAT_NORMAL 2
#define LAYER_TEXTURE_SHEEN_COLOR 3
#define LAYER_TEXTURE_SHEEN_ROUGHNESS 4
#define LAYER_TEXTURE_ANISOTROPY 5
#define LAYER_TEXTURE_DIFFUSE_TRANSMISSION 6
#define LAYER_TEXTURE_TRANSLUCENCY 7
#define LAYER_TEXTURE_SKIN_CURVATURE 8
#define LAYER_TEXTURE_TRANSMISSION 9
#define LAYER_TEXTURE_THICKNESS 10
#define LAYER_TEXTURE_SPECULAR 11
#define LAYER_TEXTURE_SPECULAR_COLOR 12
#define LAYER_TEXTURE_IRIDESCENCE 13
#define LAYER_TEXTURE_IRIDESCENCE_THICKNESS 14
#define LAYER_TEXTURE_SPECULAR_GLOSSINESS 15
#define LAYER_TEXTURE_THIRD 16   // three in a row: colour, normal, packed
#define LAYER_TEXTURE_FOURTH 19
#define LAYER_TEXTURE_SECOND_LOBE 22
#define LAYER_TEXTURE_THROUGH 23  // colour of what comes through a thin sheet
#define LAYER_TEXTURE_ROLES 24
#define LAYER_ROLES_A_WORD 8  // four bits a role: 0 none, else the number of the slot from 1
#define LAYER_ROLE_WORDS 3
#define LAYER_TEXTURE_SLOTS 6
#define MATERIAL_TEXTURE_SLOTS (TEXTURE_SLOTS + LAYER_TEXTURE_SLOTS)
// Roles up to here, and those of the second lobe, of where a thin film is and of the colour of what comes through, are shares that lighting reads a pixel; how thick that is, too, along a grain.
#define LAYER_TEXTURES_OF_LIGHT 9

// What else a material's surface does, SURFACE_SPEC_BESIDES.
#define BESIDES_SPECULAR_WORKFLOW 1u
#define BESIDES_IRIDESCENT 2u  // its film is told as reflectance
#define BESIDES_SOFT_NORMAL 4u  // of skin
#define BESIDES_SHARES 8u       // lighting reads shares in this scene
#define BESIDES_ALONG 16u       // its light depends on the tangent
#define BESIDES_ONE_READ 32u    // occlusion is a channel of what roughness and metal are read from
#define BESIDES_WIDE_GROUND 64u // its colour varies over the land (formulas/weather/ground_tone.h)
#define BESIDES_AS_CLEARED 128u  // it mirrors as glass does and has no grain: the payload of a cleared G-buffer
#define BESIDES_FILM_TOLD 256u  // a thin film whose thickness stands where others have the turn of their tangent
#define BESIDES_FILM_PLACED 512u  // .. and its share where others have their metal, which is told as reflectance

// Indices of alpha_mode.
#define ALPHA_OPAQUE 0u
#define ALPHA_MASK 1u
#define ALPHA_BLEND 2u

// What a material's wetness lets water do (scene::Wetness).
#define WATER_STANDS 1u
#define WATER_RIPPLES 2u
#define WATER_FLOWS 4u
#define WATER_BEADS 8u  // and: it stands in beads
#define WATER_STEEP 16u  // of what is so steep that none stands on it (gpu/upload/steep_triangles.h)

// How its height map moves what is seen (scene::Parallax).
#define PARALLAX_NONE 0u
#define PARALLAX_SIMPLE 1u
#define PARALLAX_OCCLUSION 2u
#define PARALLAX_LEVEL 4u  // and: heights are read at a level of their own

// What its second set of textures is for (scene::SecondSetUse).
#define SECOND_NONE 0u
#define SECOND_MIX 1u
#define SECOND_DETAIL 2u
#define SECOND_LAYERS 3u

// How snow lies on it (scene::SnowRule, scene::SnowMapping).
#define SNOW_LIES 1u
#define SNOW_GRASS 2u
#define SNOW_VERTEX 4u
#define SNOW_LOCAL 8u
#define SNOW_TRACKS 16u  // feet and tyres have trodden it somewhere
#define SNOW_BODY 32u    // some of what is seen is snow itself (gpu/snow)

// What lighting asks of a material, by its number in the G-buffer: texels of four floats.
//   0  water_color
//   1  snow_opacity, transmission_factor, ior, thickness_factor
//   2  second_water_color; that of the first set again where it has none of its own
//   3  roughness_factor, receives_decals, dispersion, LOOK_.. of light
#define MATERIAL_LOOK_TEXELS 4
#define LOOK_POINT_LAMPS 1u
#define LOOK_UNSHADOWED 2u

// What an instance has instead of its materials' own, by Draw's number, from 1; negative: their own.
//   0  base colour, metallic
//   1  roughness, emission (a factor), -, -
#define INSTANCE_LOOK_TEXELS 2

// Layers of those materials that have some, by number:
//   0  lighting model, diffuse_transmission_factor, clearcoat_factor, clearcoat_roughness_factor
//   1  sheen_color_factor, sheen_roughness_factor
//   2  anisotropy_strength, scatter_bias, scatter_power, hair_shift
//   3  translucency, translucency_power, translucency_distortion, translucency_scale
//   4  translucency_color, translucency_shadow
//   5  scatter_color, skin_curvature
//   6  skin_curvature_scale, second_scatter_bias, second_scatter_power, 1: two sets are mixed
//   7  second_scatter_color, SHARES_..
//   8  of a thin film: iridescence_factor, iridescence_ior, iridescence_thickness_minimum and _maximum
//   9  diffuse_transmission_color_factor, ROW_..
#define LAYERS_TEXELS 10
#define ROW_THROUGH_OF_BASE 1u  // what comes through has the base colour
#define ROW_FILM_PLACED 2u      // where metal is told stands what share of the surface a thin film covers

// What of its textures the shares of a pixel hold, where they have room for one of these (gpu/frame/layer_shares.glsl).
#define SHARES_SHEEN 0u
#define SHARES_LOBES 1u    // the second lobe's normal
#define SHARES_THROUGH 2u  // the colour of what comes through

// Which of them a material has.
#define LAYERS_COAT 1u
#define LAYERS_SHEEN 2u
#define LAYERS_ANISOTROPY 4u
#define LAYERS_TRANSMISSION 8u
#define LAYERS_TRANSLUCENT 16u
#define LAYERS_SCATTER 32u
#define LAYERS_SKIN 64u
#define LAYERS_HAIR 128u
#define LAYERS_SECOND_LOBE 256u
#define LAYERS_IRIDESCENT 512u  // its film is coloured by each lamp
#define LAYERS_LATER (LAYERS_TRANSLUCENT | LAYERS_SCATTER | LAYERS_SKIN | LAYERS_HAIR)


SHARED_BEGIN

struct TextureSlot {
    vec3 row0;      // uv' = (dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z)
    vec3 row1;
    uint texcoord;  // of the mesh, 0 or 1
    uint present;   // 0: there is no texture, white stands in
    vec4 channel;   // 1 for the channel that is read of a texture of one number, else 0
};

#define MATERIAL_FIELD(type, name) type name;
struct MaterialConstants {
    MATERIAL_FIELDS(MATERIAL_FIELD)
    uint lighting_model;  // its number (gpu/lighting/models_io.h)
    TextureSlot slots[MATERIAL_TEXTURE_SLOTS];
};
#undef MATERIAL_FIELD
#define MATERIAL_WORD_COUNT 382
#ifdef __cplusplus
static_assert(sizeof(MaterialConstants) == 4 * MATERIAL_WORD_COUNT);
#endif

// Push constants of one draw.
struct DrawConstants {
    vec4 to_world[3];         // rows of the affine transform
    vec4 normal_to_world[3];  // rows; xyz used
    uint instance_id;
    uint material_id;
    uint look;     // of the instance, in the table of looks; 0: its materials' own
    uint fade;     // of a level of detail: shares of the pixels, from and to, in 16 bits each; 0: all
};

SHARED_END

#endif
