#ifndef PETRICHOR_TEXPROC_DETAIL_KTX2_H
#define PETRICHOR_TEXPROC_DETAIL_KTX2_H

#include <cstddef>
#include <span>
#include <vector>

#include "texproc/files/texture.h"

namespace petrichor::texproc::detail {

/// A whole KTX2 file: header, level index, data format descriptor, writer's name, levels from the
/// smallest up, each aligned. `zstd` 0: stored plain, 1..22: each level compressed. Throws Error for
/// what the container cannot say. Source: KTX 2.0, Khronos Data Format Specification 1.3.
std::vector<std::byte> ktx2_file(const MipTexture& texture, int zstd);

/// Reads the levels of the first face and layer of bytes that may be anything: throws
/// std::runtime_error with the reason.
MipTexture parse_ktx2(std::span<const std::byte> bytes, const ReadOptions& limits);

}  // namespace petrichor::texproc::detail

#endif
