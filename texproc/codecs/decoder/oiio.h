#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_OIIO_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_OIIO_H

#include <span>
#include <string>
#include <vector>

#include "texproc/codecs/decoder/header.h"

namespace petrichor::texproc::decoder {

/// Lets the library do now what it would do at its first file: it opens files and starts threads
/// for that, which the decoder gives up before it reads anything.
void warm_up_oiio();

/// Reads the first image of a file in memory with the image library. Throws std::runtime_error with
/// the library's reason.
void read_with_oiio(std::span<const std::byte> file, const std::string& format,
                    const Accept& accept);

/// A file of these pixels; the format comes from the extension of `name`. Throws
/// std::runtime_error.
std::vector<unsigned char> write_with_oiio(const std::string& name, const Header& header,
                                           const std::byte* pixels, int quality);

}  // namespace petrichor::texproc::decoder

#endif
