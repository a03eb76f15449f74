// What the lighting pass is told: the constants of its variants, the frame, textures, tables, what it writes.
layout(local_size_x_id = PIXEL_LIST_SPEC_INVOCATIONS) in;
layout(constant_id = LIGHTING_SPEC_WEATHER) const uint WEATHER = 1u;
layout(constant_id = LIGHTING_SPEC_SHADOWS) const uint SHADOWS = 1u;
layout(constant_id = LIGHTING_SPEC_IMAGE_BASED_LIGHT) const uint IMAGE_BASED_LIGHT = 1u;
layout(constant_id = LIGHTING_SPEC_AMBIENT_OCCLUSION) const uint AMBIENT_OCCLUSION = 1u;
const bool BENT_NORMALS = AMBIENT_OCCLUSION > 1u;
layout(constant_id = LIGHTING_SPEC_EMISSION) const uint EMISSION = 1u;
layout(constant_id = LIGHTING_SPEC_GAMMA) const uint GAMMA = 0u;
layout(constant_id = LIGHTING_SPEC_BAKED) const uint BAKED = 0u;
layout(constant_id = LIGHTING_SPEC_ALL_LIGHTS) const uint ALL_LIGHTS = 0u;
layout(constant_id = LIGHTING_SPEC_PATCHES) const uint PATCHES = 0u;
layout(constant_id = LIGHTING_SPEC_LAMP_SHADOWS) const uint LAMP_SHADOWS = 1u;
layout(constant_id = LIGHTING_SPEC_RECTANGLES) const uint RECTANGLES = 1u;
// Constants, not branches: a device without branches of its own computes both sides of one.
layout(constant_id = LIGHTING_SPEC_GUSTS) const uint GUSTS = 1u;
layout(constant_id = LIGHTING_SPEC_FOG) const uint FOG = 1u;
layout(constant_id = LIGHTING_SPEC_LAYERS) const uint LAYERS = 0u;
layout(constant_id = LIGHTING_SPEC_SOFT_LAMPS) const uint SOFT_LAMPS = 0u;
layout(constant_id = LIGHTING_SPEC_SHARES) const uint SHARES = 0u;
layout(constant_id = LIGHTING_SPEC_SUN) const uint SUN = 1u;
layout(constant_id = LIGHTING_SPEC_WAYS) const uint WAYS = 0u;
layout(constant_id = LIGHTING_SPEC_LAZAROV) const uint LAZAROV = 0u;
layout(constant_id = LIGHTING_SPEC_HORIZON) const uint HORIZON = 0u;
layout(constant_id = LIGHTING_SPEC_GRAIN) const uint GRAIN = 0u;
layout(constant_id = LIGHTING_SPEC_SNOW_SCATTER) const uint SNOW_SCATTER = 0u;
layout(constant_id = LIGHTING_SPEC_SPARKLE) const uint SPARKLE = 0u;
layout(constant_id = LIGHTING_SPEC_ICE) const uint ICE = 0u;
layout(constant_id = LIGHTING_SPEC_FILM) const uint FILM = 0u;
layout(constant_id = LIGHTING_SPEC_PARTS) const uint PARTS = 0u;
layout(constant_id = LIGHTING_SPEC_PROBES) const uint PROBES = 0u;
layout(constant_id = LIGHTING_SPEC_PICTURE) const uint PICTURE = 1u;
layout(constant_id = LIGHTING_SPEC_GATHERS) const uint GATHERS = 0u;
#define ROW(number_, name_) \
    layout(constant_id = LIGHTING_SPEC_MODEL + number_) const uint USES_##name_ = 1u;
LIGHTING_MODELS(ROW)
#undef ROW

#define FRAME_PLACE binding = LIGHTING_FRAME
#include "gpu/frame/frame_words.glsl"
layout(binding = LIGHTING_OCCLUSION) uniform usamplerBuffer occlusion_words;
layout(binding = LIGHTING_SHADOW) uniform sampler2DArray shadow_map;
layout(binding = LIGHTING_LAMP_SHADOWS) uniform sampler2DArray lamp_shadow_map;
layout(binding = LIGHTING_SKY_QUADS) uniform usamplerBuffer sky_quads;
layout(binding = LIGHTING_ENV_BRDF) uniform sampler2D env_brdf;
layout(binding = LIGHTING_LIGHTS) uniform samplerBuffer lights;
layout(binding = LIGHTING_MATERIALS) uniform samplerBuffer material_looks;
layout(binding = LIGHTING_LAYERS) uniform samplerBuffer layers_table;
layout(binding = LIGHTING_LTC) uniform samplerBuffer ltc_matrices;
layout(binding = LIGHTING_PROFILES) uniform samplerBuffer light_profiles;
layout(binding = LIGHTING_SKIN) uniform samplerBuffer skin_table;
layout(binding = LIGHTING_SHARES) uniform usampler2D layer_shares;
layout(binding = LIGHTING_LIGHT_LISTS) uniform usamplerBuffer light_lists;
layout(binding = LIGHTING_ACCUMULATED, rgba32f) uniform image2D accumulated;
layout(binding = LIGHTING_PARTS, rgba32f) uniform image2DArray light_parts;
layout(binding = LIGHTING_SKY_VISIBILITY) uniform sampler2DArrayShadow sky_visibility_map;
layout(binding = LIGHTING_PATCH_POINTS) uniform usamplerBuffer patch_point_texels;
layout(binding = LIGHTING_PROBE_BANDS) uniform usamplerBuffer probe_bands;
layout(binding = LIGHTING_RADIANCE, rgba16f) uniform writeonly image2D radiance_out;
layout(binding = LIGHTING_MIRROR_WEIGHT, rgba16f) uniform writeonly image2D mirror_weight;
layout(binding = LIGHTING_MIRROR_SHAPE, rgba16_snorm) uniform writeonly image2D mirror_shape;
layout(binding = LIGHTING_MIRROR_LIST, scalar) buffer Mirrors { uint mirror_count; uint mirror_pixels[]; };
