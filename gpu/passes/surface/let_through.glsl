// What a surface keeps and what it lets through from behind: glTF's BLEND, with or without its
// reflections, and KHR_materials_transmission with the absorption of KHR_materials_volume.
#ifndef PETRICHOR_LET_THROUGH_GLSL
#define PETRICHOR_LET_THROUGH_GLSL

#include "gpu/passes/surface/holes.glsl"
#include "gpu/passes/surface/layer_textures.glsl"

struct LetThrough {
    float matt;    // share of the diffuse light that stays
    float whole;   // and of all that the surface sends
    vec3 through;  // share of what lies behind
    float body;    // of the material's thickness
};

// Of white light, after the way through the body (Beer's law as the extension writes it).
vec3 body_attenuation(float share)
{
    if (material.attenuation_distance <= 0.0 || material.thickness_factor <= 0.0) return vec3(1.0);
    return pow(max(material.attenuation_color, vec3(1.0e-4)),
               vec3(share * material.thickness_factor / material.attenuation_distance));
}

// opacity: of a surface of one's own, which keeps its reflections; below 0: the material's alpha
LetThrough let_through(SurfaceInput at, vec3 base_color, float metallic, vec3 f0, vec3 normal, float opacity)
{
    const bool blends = material.alpha_mode == ALPHA_BLEND;
    const float alpha = blends ? clamp(opacity < 0.0 ? surface_alpha(at) : opacity, 0.0, 1.0) : 1.0;
    const vec3 to_eye = (frame.flags & FRAME_ORTHOGRAPHIC) != 0u
                            ? -frame.forward
                            : normalize(frame.camera_m - at.position);
    const float grazing = 1.0 - clamp(dot(normal, to_eye), 0.0, 1.0);
    const vec3 mirrored = f0 + (1.0 - f0) * pow(grazing, 5.0);  // Schlick 1994
    const float passes = material.transmission_factor * (1.0 - metallic) *
                         layer_number(LAYER_TEXTURE_TRANSMISSION, at, vec2(0.0));
    LetThrough l;
    l.body = layer_number(LAYER_TEXTURE_THICKNESS, at, vec2(0.0));
    const vec3 refracted = base_color * body_attenuation(l.body) * (passes * (1.0 - mirrored));
    l.matt = 1.0 - passes;
    l.whole = alpha;
    l.through = vec3(1.0 - alpha);
    if (material.premultiplied_alpha != 0u || opacity >= 0.0) {
        l.matt *= alpha;
        l.whole = 1.0;
        l.through *= 1.0 - mirrored;
    }
    l.through += alpha * refracted;
    return l;
}

#endif
