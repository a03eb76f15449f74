#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_PNG_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_PNG_H

#include <string>

#include "texproc/codecs/decoder/header.h"

namespace petrichor::texproc::decoder {

/// Reads a PNG file with libpng: as read_with_oiio() would, without the fifth of a second that
/// loading the image library costs. Palettes become RGB, transparent colours an alpha channel, 1, 2
/// and 4 bits become 8. Throws std::runtime_error with the reason.
void read_png(const std::string& path, const Accept& accept);

}  // namespace petrichor::texproc::decoder

#endif
