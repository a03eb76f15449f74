#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_DDS_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_DDS_H

#include <cstddef>
#include <span>
#include <vector>

#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc::detail {

/// Everything before the texels of a texture with this many levels, whose bytes may lie elsewhere.
/// Linear formats that the first version of the container knows are written so (most programs read
/// them), all others with the DX10 header. Throws Error for what the container cannot say (rgb16,
/// sRGB of bc4, ...).
std::vector<std::byte> dds_header(const MipTexture& texture, std::size_t levels);

/// Reads the levels of the first image (face, layer). The bytes may be anything: throws
/// std::runtime_error with the reason ("it is truncated: ..."). Texels with bit masks are widened
/// to 8 or 16 bits a channel, blue-first ones turned round.
MipTexture parse_dds(std::span<const std::byte> bytes, const ReadOptions& limits);

}  // namespace petrichor::texproc::detail

#endif
