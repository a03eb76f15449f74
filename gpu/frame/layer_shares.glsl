// What textures of layers say at a pixel, beside the G-buffer: shares of the material's factors. Written
// by the surface resolve and read by the lighting, in scenes that have such textures alone.
#ifndef PETRICHOR_LAYER_SHARES_GLSL
#define PETRICHOR_LAYER_SHARES_GLSL

#include "formulas/codec/octahedral.h"

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
};

LayerShares all_shares(vec3 normal)
{
    return LayerShares(1.0, 1.0, 1.0, 1.0, vec3(1.0), 1.0, 1.0, 1.0, normal);
}

uvec4 pack_shares(LayerShares s)
{
    return uvec4(packUnorm4x8(vec4(s.coat, s.coat_roughness, s.anisotropy, s.transmitted)),
                 packUnorm4x8(vec4(sqrt(s.sheen), s.sheen_roughness)),
                 packUnorm4x8(vec4(s.translucency, s.curvature, 0.0, 0.0)),
                 packSnorm2x16(octahedral_encode(s.other_normal)));
}

LayerShares unpack_shares(uvec4 code)
{
    const vec4 a = unpackUnorm4x8(code.x);
    const vec4 b = unpackUnorm4x8(code.y);
    const vec4 c = unpackUnorm4x8(code.z);
    return LayerShares(a.x, a.y, a.z, a.w, b.rgb * b.rgb, b.w, c.x, c.y,
                       octahedral_decode(unpackSnorm2x16(code.w)));
}

#endif
