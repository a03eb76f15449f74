#ifndef PETRICHOR_FILM_SCENES_TEXTURE_ENTRY_H
#define PETRICHOR_FILM_SCENES_TEXTURE_ENTRY_H

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/renderer.h"

namespace petrichor::film {

/// Finished textures as one run of bytes, for the cache: format, size and levels; names and
/// samplers are not part of it.
struct TextureEntry {
    std::vector<std::byte> head;
    std::vector<std::span<const std::byte>> parts;  ///< the head and all levels, into `textures`
};
TextureEntry entry_of(const std::vector<gpu::Texture>& textures);

/// The same back, as views into the bytes, which `holder` keeps; nothing when the bytes are not what
/// entry_of() wrote.
std::optional<std::vector<gpu::Texture>> textures_in(std::span<const std::byte> bytes,
                                                     std::shared_ptr<const void> holder);

}  // namespace petrichor::film

#endif
