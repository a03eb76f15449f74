#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_ENCODE_BC6H_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_ENCODE_BC6H_H

#include <cstddef>
#include <cstdint>

#include "texproc/codecs/blocks/blocks.h"

namespace petrichor::texproc::detail {

/// Three planes of 16 half floats, as bits.
struct HalfTexels {
    std::uint16_t plane[3][16];
};

/// The block of least squared error of the half floats taken as integers, which is an error
/// relative to the light. Infinite ones become the largest finite one, what is no number 0, and
/// negative ones 0 where the format has no sign.
void encode_bc6h(const HalfTexels& texels, const BlockOptions& options, bool is_signed,
                 std::byte* to);

}  // namespace petrichor::texproc::detail

#endif
