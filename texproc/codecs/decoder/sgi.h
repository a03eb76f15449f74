#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_SGI_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_SGI_H

#include <cstddef>
#include <span>

#include "texproc/codecs/decoder/header.h"

namespace petrichor::texproc::decoder {

/// Reads an SGI picture (.sgi, .rgb, .bw) in memory, 8 or 16 bits, plain or run-length coded. The
/// image library reads this format only by name, which the decoder cannot open any more. Throws
/// std::runtime_error with the reason. Source: Haeberli, The SGI Image File Format, version 1.00.
void read_sgi(std::span<const std::byte> file, const Accept& accept);

}  // namespace petrichor::texproc::decoder

#endif
