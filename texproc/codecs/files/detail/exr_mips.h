#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_EXR_MIPS_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_EXR_MIPS_H

#include <filesystem>

#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc::detail {

/// Writes halves or floats as a tiled EXR with mip levels (64 x 64 tiles, zip, levels rounded
/// down), labelled as a periodic texture, with oiio:AverageColor, oiio:SHA-1 and, where all texels
/// are alike, oiio:ConstantColor. Throws Error unless all levels down to 1 x 1 are there.
void write_exr_mips(const std::filesystem::path& path, const MipTexture& texture);

}  // namespace petrichor::texproc::detail

#endif
