#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_PSD_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_PSD_H

#include <span>

#include "texproc/codecs/decoder/header.h"

namespace petrichor::texproc::decoder {

/// Reads the merged picture of a grey or RGB PSD or PSB file with every channel that the file has:
/// the image library drops the fourth, which packed maps keep their smoothness in. 8, 16 and 32
/// bits, plain or run-length coded. Where the file says that alpha is the transparency of its
/// layers, the colours, which are stored as seen on white, are freed of the white; else all numbers
/// stay as they are. False: of a kind that is left to the image library (indexed, CMYK, zipped,
/// ...). Throws std::runtime_error with the reason when it is damaged.
bool read_psd(std::span<const std::byte> file, const Accept& accept);

}  // namespace petrichor::texproc::decoder

#endif
