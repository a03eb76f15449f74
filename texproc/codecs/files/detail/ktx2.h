#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_KTX2_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_KTX2_H

#include <cstddef>
#include <span>
#include <vector>

#include "texproc/codecs/files/detail/texture_shape.h"
#include "texproc/codecs/files/texture.h"

namespace petrichor::texproc::detail {

/// The parts of a file in their order; they lie in `own` or in the levels that were given.
struct Ktx2Parts {
    std::vector<std::vector<std::byte>> own;
    LevelBytes parts;
};

/// A KTX2 file: header, level index, data format descriptor, writer's name, levels from the
/// smallest up, each aligned. `levels` may lie elsewhere than in `texture`. `zstd` 0: stored
/// plain, 1..22: each level compressed. Throws Error for what the container cannot say. Source:
/// KTX 2.0, Khronos Data Format Specification 1.3.
Ktx2Parts ktx2_parts(const MipTexture& texture, const LevelBytes& levels, int zstd);

/// The same in one piece.
std::vector<std::byte> ktx2_file(const MipTexture& texture, int zstd);

/// Reads the levels of the first face and layer of bytes that may be anything: throws
/// std::runtime_error with the reason.
MipTexture parse_ktx2(std::span<const std::byte> bytes, const ReadOptions& limits);

}  // namespace petrichor::texproc::detail

#endif
