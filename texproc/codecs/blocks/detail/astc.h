#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_ASTC_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_ASTC_H

#include <cstddef>
#include <span>
#include <vector>

#include "texproc/codecs/blocks/blocks.h"

namespace petrichor::texproc::detail {

// ASTC by Arm's library, where the program was built with it (has_astc()); without it both throw Error.
// Blocks know nothing of each other: strips of them are coded at the same time, and the bytes do not depend on it.

/// image: U8; channels as encode_blocks() takes them. side: texels along a block.
std::vector<std::byte> encode_astc(const RawImage& image, int side, const BlockOptions& options);
/// U8 with 4 channels. A block that is no valid one is magenta, as the format has it.
RawImage decode_astc(std::span<const std::byte> bytes, int side, int width, int height, bool srgb, int threads);

}  // namespace petrichor::texproc::detail

#endif
