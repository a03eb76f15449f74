#ifndef PETRICHOR_FILM_SCENES_MEMORY_BUDGET_H
#define PETRICHOR_FILM_SCENES_MEMORY_BUDGET_H

#include <cstdint>

#include "film/scenes/scene_textures.h"
#include "scene/scene.h"

namespace petrichor::film {

/// What rendering a scene takes, bytes, known before an image is decoded. An estimate from above.
struct MemoryNeed {
    std::uint64_t textures = 0;  ///< with all mip levels, here and on the device
    std::uint64_t making = 0;    ///< while they are made, several at a time
    std::uint64_t geometry = 0;  ///< vertices and indices, here and on the device
    std::uint64_t frame = 0;     ///< targets and pictures on their way to the disk
    std::uint64_t total() const { return textures + making + geometry + frame; }
    /// What one more renderer takes beside the first: its device's copies, maps and programs.
    std::uint64_t another() const { return textures / 2 + geometry / 2 + frame + (448u << 20); }
};

/// Looks at the heads of the scene's images. Throws Error for one that is damaged.
MemoryNeed memory_need(const scene::Scene& scene, const TextureOptions& options, int width,
                       int height);

/// Three quarters of the memory of this machine, or of what its control group allows.
std::uint64_t default_memory_budget();

/// Throws Error, with what each part takes and what to lower, when a scene needs more than `budget`
/// bytes (0: the default).
MemoryNeed check_memory(const scene::Scene& scene, const TextureOptions& options, int width,
                        int height, std::uint64_t budget);

}  // namespace petrichor::film

#endif
