#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_REPEAT_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_REPEAT_H

#include <cstddef>
#include <functional>
#include <span>

#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/blocks/detail/block_table.h"
#include "texproc/codecs/blocks/detail/encode_kernel.h"

namespace petrichor::texproc::detail {

/// Makes the blocks of a level repeat bytes of blocks before them where that costs little, so that
/// a general compressor finds them (rate-distortion optimisation). A block takes over a run of
/// bytes from an earlier one at the same place within the block if error + price * bits is the
/// least, bits by a simple account of what such a compressor spends.
///
/// Chunks of rows stand for themselves: the same bytes at any number of threads.
///
///   blocks    a whole level, `across` blocks a row; changed
///   texels    of a block as it was before encoding
///   weights   of the channels; 0 leaves one out
///   most      root mean square error, in codes, up to which a block may get by that; > 0
///   price     mean squared error of a channel, summed over 16 texels, that a bit may cost; > 0
void repeat_blocks(std::span<std::byte> blocks, int across, const BlockRow& format,
                   const std::function<BlockTexels(int bx, int by)>& texels,
                   const std::array<float, 4>& weights, float price, float most,
                   int threads);

}  // namespace petrichor::texproc::detail

#endif
