#ifndef PETRICHOR_FILM_SCENES_TEXTURE_PLAN_H
#define PETRICHOR_FILM_SCENES_TEXTURE_PLAN_H

#include <vector>

#include "scene/scene.h"

namespace petrichor::film {

/// What one texture of the renderer is made from. An image that materials use in two ways becomes
/// two.
struct TextureRecipe {
    enum class Kind {
        Color,    ///< base colour, emission: sRGB
        Normal,   ///< filtered as directions
        Surface,  ///< R occlusion, G roughness, B metallic
        Scalar,   ///< one channel: occlusion, height, masks
        Light,    ///< linear and unbounded: light maps
        Weights,  ///< four channels: weights of a ground's layers
    };
    int image = 0;  ///< index into Scene::textures as loaded
    Kind kind = Kind::Color;
    int channel = 0;                ///< Scalar: the one that is kept, 0 red .. 3 alpha
    float alpha_cutoff = -1.0f;     ///< Color of a MASK material: keep the coverage in small levels
    bool alpha_covers = false;      ///< Color of a MASK or BLEND material: weighed by its alpha
    /// Surface: the normal map whose lost detail becomes roughness; Color: whose slopes darken it.
    int normal_image = -1;
    /// Normal: the surface map whose roughness it is filtered with; Color: which tells metal.
    int surface_image = -1;
    float normal_scale = 1.0f;      ///< of such a pair: scale of the normal map
    float roughness_factor = 1.0f;  ///< of such a pair: multiplied into the surface map
    float metallic_factor = 0.0f;   ///< Color: of the material
    bool fades_to_grey = false;     ///< Color: of fine detail, which small levels lose
    bool prepared = false;          ///< brings its own levels (DDS, KTX2): loaded as it is

    bool operator==(const TextureRecipe&) const = default;
};

/// Decides how each image is filtered, from how the materials use it, and lets the materials point
/// at the results: afterwards scene.textures has one entry a recipe (those added have no bytes). A
/// normal and a metallic-roughness texture of one material are paired when they share the
/// coordinates and the wrapping; the material's roughness factor then moves into the texture.
///
///   moving  materials, by index, whose roughness factor changes over a film: theirs stays a factor,
///           and the texture is filtered as if it were 1; beyond its end: none
std::vector<TextureRecipe> plan_textures(scene::Scene& scene, const std::vector<bool>& moving = {});

}  // namespace petrichor::film

#endif
