// Textures of layers: what they say at a point, and what of it stays in the surface: reflectance by the
// specular workflow, by KHR_materials_specular, under a thin film.
#ifndef PETRICHOR_LAYER_TEXTURES_GLSL
#define PETRICHOR_LAYER_TEXTURES_GLSL

#include "formulas/light/iridescence.h"
#include "gpu/passes/surface/layer_slots.glsl"
#include "gpu/passes/surface/sets.glsl"

vec3 layer_color(int role, SurfaceInput at, vec2 shift)
{
    return has_layer(role) ? layer_texel(role, at, shift, 1.0).rgb : vec3(1.0);
}

// At normal incidence (KHR_materials_ior, KHR_materials_specular).
vec3 dielectric_reflectance(SurfaceInput at, vec2 shift)
{
    const float root = (material.ior - 1.0) / (material.ior + 1.0);
    vec3 tint = material.specular_color_factor;
    if (has_layer(LAYER_TEXTURE_SPECULAR_COLOR)) tint *= layer_color(LAYER_TEXTURE_SPECULAR_COLOR, at, shift);
    float strength = material.specular_factor;
    if (has_layer(LAYER_TEXTURE_SPECULAR)) strength *= layer_number(LAYER_TEXTURE_SPECULAR, at, shift);
    if (MIXED && material.second_specular_factor >= 0.0)
        strength = strength * at.shares.x + material.second_specular_factor * at.shares.y;
    return min(root * root * tint, vec3(1.0)) * strength;
}

// Reflectance and smoothness told, instead of metallic and roughness.
void specular_workflow(inout GBufferTexel texel, inout float roughness, SurfaceInput at, vec2 shift)
{
    vec4 told = vec4(material.workflow_specular_factor, material.glossiness_factor);
    if (has_layer(LAYER_TEXTURE_SPECULAR_GLOSSINESS)) {
        told *= layer_texel(LAYER_TEXTURE_SPECULAR_GLOSSINESS, at, shift, 1.0);
    }
    texel.f0 = told.rgb;
    texel.metallic = 0.0;
    roughness = 1.0 - told.a;
}

// Metal told as reflectance.
void as_reflectance(inout GBufferTexel texel)
{
    texel.f0 = mix(texel.f0, texel.base_color, texel.metallic);
    texel.base_color *= 1.0 - texel.metallic;
    texel.metallic = 0.0;
}

// How thick a film is, 0..1 of what the material allows.
float film_thickness(SurfaceInput at, vec2 shift)
{
    return layer_number(LAYER_TEXTURE_IRIDESCENCE_THICKNESS, at, shift);
}

// Of the surface.
float film_share(SurfaceInput at, vec2 shift)
{
    return layer_number(LAYER_TEXTURE_IRIDESCENCE, at, shift);
}

// Last of all, where glass keeps no metal: as_reflectance() has told it.
void place_film(inout GBufferTexel texel, SurfaceInput at)
{
    if ((BESIDES & BESIDES_FILM_PLACED) != 0u) texel.metallic = film_share(at, vec2(0.0));
}

// A thin film colours what is mirrored, as the eye here sees it: told as the reflectance that would show it,
// so that lights and surroundings answer alike.
void add_thin_film(inout GBufferTexel texel, SurfaceInput at, vec2 shift)
{
    const vec3 to_eye = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u
                            ? -frame.forward
                            : normalize(frame.camera_m - at.position);
    const float nv = clamp(abs(dot(texel.base_normal, to_eye)), 0.02, 1.0);
    const float share = material.iridescence_factor * film_share(at, shift);
    const float thickness_nm = mix(material.iridescence_thickness_minimum,
                                   material.iridescence_thickness_maximum,
                                   film_thickness(at, shift));
    as_reflectance(texel);
    texel.f0 = mix(texel.f0, thin_film_f0(material.iridescence_ior, thickness_nm, texel.f0, nv), share);
}

// What there is room for, as lighting has it from the row of the material's layers.
uint kind_of_shares()
{
    return has_layer(LAYER_TEXTURE_SECOND_LOBE) ? SHARES_LOBES : has_layer(LAYER_TEXTURE_THROUGH) ? SHARES_THROUGH : SHARES_SHEEN;
}

LayerShares layer_shares(SurfaceInput at, TangentFrame f, vec3 normal, vec2 shift)
{
    LayerShares s = all_shares(material.clearcoat_factor > 0.0 ? at.normal : normal);
    s.coat = layer_number(LAYER_TEXTURE_CLEARCOAT, at, shift);
    s.coat_roughness = layer_number(LAYER_TEXTURE_CLEARCOAT_ROUGHNESS, at, shift);
    s.sheen = layer_color(LAYER_TEXTURE_SHEEN_COLOR, at, shift);
    s.sheen_roughness = layer_number(LAYER_TEXTURE_SHEEN_ROUGHNESS, at, shift);
    s.transmitted = layer_number(LAYER_TEXTURE_DIFFUSE_TRANSMISSION, at, shift);
    s.through = layer_color(LAYER_TEXTURE_THROUGH, at, shift);
    s.translucency = layer_number(LAYER_TEXTURE_TRANSLUCENCY, at, shift);
    s.film = film_share(at, shift);
    s.film_thickness = film_thickness(at, shift);
    s.curvature = layer_number(LAYER_TEXTURE_SKIN_CURVATURE, at, shift);
    if (has_layer(LAYER_TEXTURE_ANISOTROPY)) {
        s.anisotropy = layer_texel(LAYER_TEXTURE_ANISOTROPY, at, shift, 1.0).b;
    }
    if (has_layer(LAYER_TEXTURE_CLEARCOAT_NORMAL)) {
        const vec3 n = unpack_normal(layer_texel(LAYER_TEXTURE_CLEARCOAT_NORMAL, at, shift, 1.0).xy,
                                     material.clearcoat_normal_scale);
        s.other_normal = normalize(to_world(f, n));
    }
    if ((BESIDES & BESIDES_SOFT_NORMAL) != 0u) {
        // Three levels up (Lux 2.02); without the fine bumps of a second set.
        vec3 n = vec3(0.0, 0.0, 1.0);
        if (has(TEXTURE_NORMAL)) {
            Uv uv = coordinates(TEXTURE_NORMAL, at, shift);
            uv.dx *= 8.0;
            uv.dy *= 8.0;
            n = unpack_normal(texel(normal_texture, uv).xy, material.normal_scale);
        }
        s.other_normal = normalize(mix(normal, normalize(to_world(f, n)), material.skin_blur));
    }
    return s;
}

#endif
