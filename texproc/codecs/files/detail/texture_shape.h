#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_TEXTURE_SHAPE_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_TEXTURE_SHAPE_H

#include <span>
#include <vector>

#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc::detail {

using LevelBytes = std::vector<std::span<const std::byte>>;

/// What make_texture() makes, without its levels. Throws Error for a chain that is not one.
MipTexture texture_shape(std::span<const RawImage> levels, const TextureWriteOptions& options);

/// The bytes of a texture's levels, to be written while it lives.
LevelBytes level_bytes_of(const MipTexture& texture);

}  // namespace petrichor::texproc::detail

#endif
