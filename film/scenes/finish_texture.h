#ifndef PETRICHOR_FILM_SCENES_FINISH_TEXTURE_H
#define PETRICHOR_FILM_SCENES_FINISH_TEXTURE_H

#include <string>
#include <vector>

#include "film/scenes/scene_textures.h"

namespace petrichor::film {

/// What is made in one go: one texture, or the surface and the normal map of a material, whose
/// levels are chosen together.
struct TextureJob {
    int texture = -1;         ///< index of the recipe
    int normal_texture = -1;  ///< index of the recipe of the normals; none: -1
};
/// The jobs of all recipes that `used` names; every used texture belongs to exactly one.
std::vector<TextureJob> texture_jobs(const std::vector<TextureRecipe>& recipes,
                                     const std::vector<bool>& used);

struct FinishedTextures {
    std::vector<gpu::Texture> textures;  ///< of the job's texture, then of its normals
    std::vector<std::string> notes;
    bool as_stored = false;  ///< nothing was computed: not worth keeping
};

/// Decodes, filters and rounds what a job asks for. Throws Error that names a damaged image.
FinishedTextures finish_textures(const scene::Scene& scene,
                                 const std::vector<TextureRecipe>& recipes, const TextureJob& job,
                                 const TextureOptions& options);

}  // namespace petrichor::film

#endif
