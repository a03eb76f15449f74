#ifndef PETRICHOR_TEXPROC_CODECS_DECODER_TEXTURE_H
#define PETRICHOR_TEXPROC_CODECS_DECODER_TEXTURE_H

#include <functional>
#include <span>

#include "texproc/codecs/decoder/header.h"
#include "texproc/codecs/files/io.h"

namespace petrichor::texproc::decoder {

/// Reads the largest level of a DDS or KTX2 file that lies in memory, as read_with_oiio() does;
/// with limits.max_side the largest that fits, where the file has one.
void read_gpu_texture(std::span<const std::byte> file, const std::string& format,
                      const ReadOptions& limits, const Accept& accept);

}  // namespace petrichor::texproc::decoder

#endif
