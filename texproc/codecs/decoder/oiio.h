#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_OIIO_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_OIIO_H

#include <string>

#include "texproc/codecs/decoder/header.h"

namespace petrichor::texproc::decoder {

/// Reads the first image of `path` with the image library. Throws std::runtime_error with the
/// library's reason.
void read_with_oiio(const std::string& path, const std::string& format, const Accept& accept);

/// Writes pixels with the image library; the format comes from the extension of `path`.
void write_with_oiio(const std::string& path, const Header& header, const std::byte* pixels,
                     int quality);

}  // namespace petrichor::texproc::decoder

#endif
