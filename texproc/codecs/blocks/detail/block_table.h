#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_BLOCK_TABLE_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_BLOCK_TABLE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "texproc/codecs/blocks/blocks.h"
#include "texproc/codecs/blocks/detail/encode_bc6h.h"
#include "texproc/codecs/blocks/detail/encode_kernel.h"

namespace petrichor::texproc::detail {

/// The 16 texels of one block as bytes of the output image.
using BlockBytes = std::array<std::byte, 16 * 16>;

/// One way to name a block format in files.
struct BlockLabel {
    const char* name;  ///< as users write it
    int channels;      ///< of what is stored
    bool is_signed;
    std::uint32_t dxgi, dxgi_srgb, vulkan, vulkan_srgb;  ///< 0: there is none
    const char* four_letters;                            ///< of DDS before DXGI; "": none
    /// Of the descriptor of KTX2: the channel of each equal part of a block, alpha 15.
    std::vector<int> parts;
};

/// A block format, told once: codec and names. A new one is a value of Block and a row here.
struct BlockRow {
    Block block;
    const char* title;
    std::size_t bytes;  ///< of a block
    int channels;       ///< that decoding gives
    bool halves;        ///< decoded to F16, else to U8
    bool wide;          ///< signed and exact numbers are decoded to F32
    /// Null: a level at a time.
    void (*decode)(const std::byte* from, BlockSign sign, BlockBytes& to);
    /// Null: it can only be read, or is made from half floats.
    void (*encode)(const BlockTexels& texels, const BlockOptions& options, std::byte* to);
    int color_model;  ///< of the Khronos data format
    std::vector<BlockLabel> labels;
    void (*encode_halves)(const HalfTexels& texels, const BlockOptions& options, bool is_signed,
                          std::byte* to) = nullptr;
    int side = 4;        ///< texels along a block
    bool astc = false;   ///< coded a level at a time (detail/astc.h), not by the functions above
};

const std::vector<BlockRow>& block_table();
const BlockRow& row_of(Block block);

}  // namespace petrichor::texproc::detail

#endif
