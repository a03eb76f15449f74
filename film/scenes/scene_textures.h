#ifndef PETRICHOR_FILM_SCENES_SCENE_TEXTURES_H
#define PETRICHOR_FILM_SCENES_SCENE_TEXTURES_H

#include <vector>

#include "base/content_cache.h"
#include "base/interrupted.h"
#include "film/scenes/prepared_texture.h"
#include "film/scenes/texture_plan.h"
#include "gpu/renderer.h"
#include "scene/scene.h"
#include "texproc/material/chains.h"

namespace petrichor::film {

struct TextureOptions {
    int max_size = 4096;  ///< larger images start at the mip level that fits, texels
    int threads = 0;  ///< images at once; 0: the cores, at most 4 (a 4k image takes about 0.6 GiB)
    StopRequest stop = {};                     ///< asked before each image
    BlockSupport blocks = BlockSupport::Fast;  ///< of the device: block_support()
    texproc::PrefilterChoice prefilter{};      ///< the default is that of `texture build`
    std::vector<bool> moving_roughness{};  ///< as in plan_textures
    ContentCache cache{};  ///< finished textures are kept here; the default keeps nothing
};

/// Finishes all textures of a scene, in parallel; result[i] belongs to scene.textures[i] once this
/// has changed the scene as plan_textures does. Images with their own levels (DDS, KTX2) are loaded
/// as they are; all others are decoded and filtered as `texture build` does: normals and roughness
/// of a material together, colour in linear light, the rest plain. The encoded bytes are released.
///
/// Same bytes for any thread count, and with a cold, a warm or no cache. What a user should know
/// (labels that differ, a cache that cannot be written, how long the first start took) is added to
/// scene.warnings. Throws Error for a damaged image, Interrupted after a stop.
std::vector<gpu::Texture> prepare_textures(scene::Scene& scene, const TextureOptions& options = {});

}  // namespace petrichor::film

#endif
