#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "formulas/noise/noise.h"
#include "gpu/upload/material_io.h"

layout(set = 0, binding = 0, scalar) uniform Material { MaterialConstants material; };
layout(set = 0, binding = 1) uniform sampler2D base_color_map;

layout(location = 0) in vec4 in_uv;

void main()
{
    const TextureSlot t = material.slots[TEXTURE_BASE_COLOR];
    const vec2 p = t.texcoord != 0u ? in_uv.zw : in_uv.xy;
    const vec2 uv = vec2(dot(t.row0.xy, p) + t.row0.z, dot(t.row1.xy, p) + t.row1.z);
    float alpha = material.base_color_factor.a;
    if (t.present != 0u) alpha *= texture(base_color_map, uv).a;
    alpha *= 1.0 - 0.9 * material.transmission_factor;
    if (material.alpha_mode == ALPHA_MASK && alpha < material.alpha_cutoff) discard;
    // What lets light through by chance is as dense in the map as it is opaque; the filter of the
    // shadow makes a grey of it.
    const bool chance = material.alpha_mode == ALPHA_BLEND || material.transmission_factor > 0.0;
    if (chance && alpha <= dither(ivec2(gl_FragCoord.xy), 0u)) discard;
}
