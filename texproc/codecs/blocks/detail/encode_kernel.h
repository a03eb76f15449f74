// One source, two instruction sets, the same bits: the encoders of single blocks.
#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_ENCODE_KERNEL_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_ENCODE_KERNEL_H

#include <array>
#include <cstddef>
#include <cstdint>

#include "texproc/codecs/blocks/blocks.h"

namespace petrichor::texproc::detail {

/// 16 texels as four planes of codes.
struct BlockTexels {
    alignas(16) std::uint8_t plane[4][16];
};

/// What a block of BC1 may use.
enum class Bc1Use {
    Opaque,  ///< four colours, or three
    Holes,   ///< texels with alpha below one half become transparent
    Four,    ///< four colours only: within BC3 the order of the endpoints says nothing
};

struct EncodeKernel {
    void (*bc1)(const BlockTexels&, const BlockOptions&, Bc1Use, std::byte* to);
    void (*bc4)(const std::uint8_t* values, BlockQuality, std::byte* to);
    void (*bc7)(const BlockTexels&, const BlockOptions&, std::byte* to);
    void (*uastc)(const BlockTexels&, const BlockOptions&, std::byte* to);
};

extern const EncodeKernel kEncodeKernelBase;
extern const EncodeKernel kEncodeKernelAvx2;
/// The fastest that this machine has.
const EncodeKernel& encode_kernel();

}  // namespace petrichor::texproc::detail

#endif
