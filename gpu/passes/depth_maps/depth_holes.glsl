// Where a material lets the light of a depth map through.
#ifndef PETRICHOR_DEPTH_HOLES_GLSL
#define PETRICHOR_DEPTH_HOLES_GLSL

#include "formulas/noise/noise.h"
#include "gpu/upload/material_io.h"

layout(set = 0, binding = 0, scalar) uniform Material { MaterialConstants material; };
layout(set = 0, binding = 1) uniform sampler2D base_color_map;

vec2 slot_uv(int slot, vec4 uv)
{
    const TextureSlot t = material.slots[slot];
    const vec2 p = t.texcoord != 0u ? uv.zw : uv.xy;
    return vec2(dot(t.row0.xy, p) + t.row0.z, dot(t.row1.xy, p) + t.row1.z);
}

// read: alpha of the colour texture there.
bool hole_of(float read, ivec2 texel)
{
    float alpha = material.base_color_factor.a;
    if (material.slots[TEXTURE_BASE_COLOR].present != 0u) alpha *= read;
    alpha *= 1.0 - 0.9 * material.transmission_factor;
    if (material.alpha_mode == ALPHA_MASK && alpha < material.alpha_cutoff) return true;
    // What lets light through by chance is as dense in the map as it is opaque; the filter of the
    // shadow makes a grey of it.
    const bool chance = material.alpha_mode == ALPHA_BLEND || material.transmission_factor > 0.0;
    return chance && alpha <= dither(texel, 0u);
}

#endif
