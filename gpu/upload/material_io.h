// Constants of one material, as the surface pass reads them.
#ifndef PETRICHOR_GPU_UPLOAD_MATERIAL_IO_H
#define PETRICHOR_GPU_UPLOAD_MATERIAL_IO_H

#include "base/interop.h"

#define TEXTURE_BASE_COLOR 0
#define TEXTURE_NORMAL 1
#define TEXTURE_METALLIC_ROUGHNESS 2
#define TEXTURE_OCCLUSION 3
#define TEXTURE_EMISSIVE 4
#define TEXTURE_HEIGHT 5
#define TEXTURE_PUDDLE_MASK 6
#define TEXTURE_SNOW_MASK 7
#define TEXTURE_SLOTS 8

#define MATERIAL_MASK 256u   // alpha test
#define MATERIAL_BLEND 512u  // stochastic transparency
#define MATERIAL_UNLIT 1024u
#define MATERIAL_SHELTERED 2048u
#define MATERIAL_DOUBLE_SIDED 4096u
// bits 0..7: texture slot present; bits 16..23: slot reads texcoord 1

// Lighting models, in the G-buffer's model byte.
#define MODEL_STANDARD 0u
#define MODEL_UNLIT 1u

SHARED_BEGIN

// uv' = (dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z)
struct TextureTransform {
    vec3 row0;
    vec3 row1;
};

struct MaterialConstants {
    vec4 base_color;
    vec3 emissive;
    float metallic;
    float roughness;
    float normal_scale;
    float occlusion_strength;
    float alpha_cutoff;
    float f0;        // dielectric reflectance at normal incidence
    float porosity;  // negative: from roughness
    float default_height;
    float water_slope_damp;
    vec4 water_accumulation;
    vec4 water_color;
    float flow_tiling;
    float flow_speed;
    float flow_interval_s;
    float flow_refraction;
    float flow_normal_strength;
    float snow_slope_damp;
    vec2 snow_accumulation;
    float snow_normal_strength;
    float snow_detail_strength;
    float snow_opacity;
    uint flags;
    TextureTransform transforms[TEXTURE_SLOTS];
};

// Push constants of one draw.
struct DrawConstants {
    vec4 to_world[3];         // rows of the affine transform
    vec4 normal_to_world[3];  // rows; xyz used
    uint instance_id;
    uint material_id;
    uint padding[2];
};

SHARED_END

#endif
