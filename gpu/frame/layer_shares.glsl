// What textures of layers say at a pixel, beside the G-buffer: shares of the material's factors. Written
// by the surface resolve and read by the lighting, in scenes that have such textures alone.
#ifndef PETRICHOR_LAYER_SHARES_GLSL
#define PETRICHOR_LAYER_SHARES_GLSL

#include "formulas/codec/octahedral.h"
#include "gpu/upload/material_io.h"

struct LayerShares {
    float coat;
    float coat_roughness;
    float anisotropy;
    float transmitted;
    vec3 sheen;
    float sheen_roughness;
    float translucency;
    float curvature;
    vec3 other_normal;  // of the coat, or of skin's diffuse light
    vec3 second_normal;  // of a second lobe; of materials that have its texture
    float second_roughness;
    float second_share;  // of what is mirrored
    float film;            // of a thin film; beside a second lobe in place of a curvature, which is of skin
    float film_thickness;  // 0..1 of what the material allows; of materials without a second lobe
    vec3 through;          // colour of what comes through; of materials that have its texture
};

LayerShares all_shares(vec3 normal)
{
    return LayerShares(1.0, 1.0, 1.0, 1.0, vec3(1.0), 1.0, 1.0, 1.0, normal, normal, 1.0, 0.0, 1.0, 1.0,
                       vec3(1.0));
}

// kind: SHARES_.. of the material. The normal of a second lobe, or the colour of what comes through, takes the place of
// the textures of sheen.
uvec4 pack_shares(LayerShares s, uint kind)
{
    const bool two_lobes = kind == SHARES_LOBES;
    const vec4 color = kind == SHARES_THROUGH ? vec4(sqrt(s.through), 1.0) : vec4(sqrt(s.sheen), s.sheen_roughness);
    return uvec4(packUnorm4x8(vec4(s.coat, s.coat_roughness, s.anisotropy, s.transmitted)),
                 two_lobes ? packSnorm2x16(octahedral_encode(s.second_normal))
                           : packUnorm4x8(color),
                 packUnorm4x8(vec4(s.translucency, two_lobes ? s.film : s.curvature, two_lobes ? s.second_roughness : s.film, two_lobes ? s.second_share : s.film_thickness)),
                 packSnorm2x16(octahedral_encode(s.other_normal)));
}

LayerShares unpack_shares(uvec4 code, uint kind)
{
    const bool two_lobes = kind == SHARES_LOBES;
    const vec4 a = unpackUnorm4x8(code.x);
    const vec4 told = unpackUnorm4x8(code.y);
    const vec4 b = kind == SHARES_SHEEN ? told : vec4(1.0);
    const vec4 c = unpackUnorm4x8(code.z);
    return LayerShares(a.x, a.y, a.z, a.w, b.rgb * b.rgb, b.w, c.x, two_lobes ? 1.0 : c.y,
                       octahedral_decode(unpackSnorm2x16(code.w)), octahedral_decode(unpackSnorm2x16(code.y)), c.z,
                       two_lobes ? c.w : 0.0, two_lobes ? c.y : c.z, two_lobes ? 1.0 : c.w,
                       kind == SHARES_THROUGH ? told.rgb * told.rgb : vec3(1.0));
}

#endif
