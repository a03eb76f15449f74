#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_PNG_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_PNG_H

#include <cstddef>
#include <span>

#include "texproc/codecs/decoder/header.h"

namespace petrichor::texproc::decoder {

/// Reads a PNG file in memory with libpng: as read_with_oiio() would, without the fifth of a second
/// that loading the image library costs. Palettes become RGB, transparent colours an alpha channel,
/// 1, 2 and 4 bits become 8. Throws std::runtime_error with the reason.
void read_png(std::span<const std::byte> file, const Accept& accept);

}  // namespace petrichor::texproc::decoder

#endif
