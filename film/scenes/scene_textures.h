#ifndef PETRICHOR_FILM_SCENES_SCENE_TEXTURES_H
#define PETRICHOR_FILM_SCENES_SCENE_TEXTURES_H

#include <vector>

#include "base/interrupted.h"
#include "gpu/renderer.h"
#include "scene/scene.h"

namespace petrichor::film {

struct TextureOptions {
    int max_size = 4096;  ///< larger images start at the mip level that fits, texels
    int threads = 0;  ///< images at once; 0: the cores, at most 4 (a 4k image takes about 0.6 GiB)
    StopRequest stop = {};  ///< asked before each image
};

/// What one texture of the renderer is made from. An image that materials use in two ways becomes
/// two.
struct TextureRecipe {
    enum class Kind {
        Color,    ///< base colour, emission: sRGB
        Normal,   ///< filtered as directions
        Surface,  ///< R occlusion, G roughness, B metallic
        Scalar,   ///< one channel: occlusion, height, masks
    };
    int image = 0;  ///< index into Scene::textures as loaded
    Kind kind = Kind::Color;
    float alpha_cutoff = -1.0f;     ///< Color of a MASK material: keep the coverage in small levels
    bool alpha_covers = false;      ///< Color of a MASK or BLEND material: weighed by its alpha
    int normal_image = -1;          ///< Surface: the normal map whose lost detail becomes roughness
    float normal_scale = 1.0f;      ///< Surface: scale of that normal map
    float roughness_factor = 1.0f;  ///< Surface with a normal map: multiplied in here

    bool operator==(const TextureRecipe&) const = default;
};

/// Decides how each image is filtered, from how the materials use it, and lets the materials point
/// at the results: afterwards scene.textures has one entry a recipe (those added have no bytes). A
/// normal and a metallic-roughness texture of one material are paired when they share the
/// coordinates and the wrapping; the material's roughness factor then moves into the texture.
std::vector<TextureRecipe> plan_textures(scene::Scene& scene);

/// Decodes and filters all textures of a scene, in parallel; result[i] belongs to scene.textures[i]
/// once this has changed the scene as plan_textures does. The encoded bytes are released.
/// Same bytes for any thread count. Throws Error for a damaged image.
std::vector<gpu::Texture> prepare_textures(scene::Scene& scene, const TextureOptions& options = {});

}  // namespace petrichor::film

#endif
