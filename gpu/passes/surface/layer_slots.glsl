// Textures that share a few slots of a material: where each is, and reading it.
#ifndef PETRICHOR_SURFACE_LAYER_SLOTS_GLSL
#define PETRICHOR_SURFACE_LAYER_SLOTS_GLSL

#include "gpu/passes/surface/textures.glsl"

// Number of the slot from 1; 0: the material has no such texture.
uint layer_slot(int role)
{
    const uint roles = role < LAYER_ROLES_A_WORD       ? LAYER_ROLES_A
                       : role < 2 * LAYER_ROLES_A_WORD ? LAYER_ROLES_B
                                                       : LAYER_ROLES_C;
    return roles >> (4 * (role % LAYER_ROLES_A_WORD)) & 15u;
}

bool has_layer(int role)
{
    return layer_slot(role) != 0u;
}

vec4 layer_texel(int role, SurfaceInput at, vec2 shift, float wider)
{
    const uint slot = layer_slot(role);
    Uv uv = coordinates(TEXTURE_SLOTS + int(slot) - 1, at, shift);
    uv.dx *= wider;
    uv.dy *= wider;
    if (slot == 1u) return texel(layer_texture_0, uv);
    if (slot == 2u) return texel(layer_texture_1, uv);
    if (slot == 3u) return texel(layer_texture_2, uv);
    if (slot == 4u) return texel(layer_texture_3, uv);
    if (slot == 5u) return texel(layer_texture_4, uv);
    return texel(layer_texture_5, uv);
}

// 1 without a texture.
float layer_number(int role, SurfaceInput at, vec2 shift)
{
    if (!has_layer(role)) return 1.0;
    return dot(layer_texel(role, at, shift, 1.0),
               material.slots[TEXTURE_SLOTS + int(layer_slot(role)) - 1].channel);
}

#endif
