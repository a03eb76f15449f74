#include "texproc/codecs/blocks/blocks.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/codecs/blocks/detail/astc.h"
#include "texproc/codecs/blocks/detail/block_table.h"

namespace petrichor::texproc {

std::size_t blocks_size(Block block, int width, int height)
{
    const int side = block_side(block);
    return static_cast<std::size_t>((width + side - 1) / side) *
           static_cast<std::size_t>((height + side - 1) / side) * block_bytes(block);
}

int block_side(Block block)
{
    return detail::row_of(block).side;
}

std::size_t block_bytes(Block block)
{
    return detail::row_of(block).bytes;
}

int channels_of(Block block)
{
    return detail::row_of(block).channels;
}

PixelType decoded_type(Block block, bool is_signed)
{
    const detail::BlockRow& row = detail::row_of(block);
    if (row.halves) return PixelType::F16;
    return is_signed && row.wide ? PixelType::F32 : PixelType::U8;
}

RawImage decode_blocks(std::span<const std::byte> bytes, Block block, int width, int height,
                       BlockSign sign, int threads, bool srgb)
{
    if (width < 1 || height < 1 || bytes.size() < blocks_size(block, width, height)) {
        throw Error("block texture: " + std::to_string(width) + " x " + std::to_string(height) +
                        " texels need more than the " + std::to_string(bytes.size()) +
                        " bytes that are there",
                    "Export the file again; it is damaged.");
    }
    const detail::BlockRow& row_of_block = detail::row_of(block);
    if (row_of_block.astc)
        return detail::decode_astc(bytes, row_of_block.side, width, height, srgb, threads);
    const PixelType type = decoded_type(block, sign != BlockSign::Unsigned);
    RawImage image{width, height, channels_of(block), type, {}, {}};
    image.bytes.resize(image.values() * size_of(type));
    const std::size_t pixel = static_cast<std::size_t>(image.channels) * size_of(type);
    const std::size_t row = pixel * static_cast<std::size_t>(width);
    const int across = (width + 3) / 4;
    parallel_for(static_cast<std::size_t>((height + 3) / 4), threads, [&](std::size_t by) {
        const int y0 = 4 * static_cast<int>(by);
        const int rows = std::min(4, height - y0);
        const std::byte* from =
            bytes.data() + by * static_cast<std::size_t>(across) * row_of_block.bytes;
        for (int bx = 0; bx < across; ++bx, from += row_of_block.bytes) {
            detail::BlockBytes texels;
            row_of_block.decode(from, sign, texels);
            const std::size_t length =
                pixel * static_cast<std::size_t>(std::min(4, width - 4 * bx));
            for (int y = 0; y < rows; ++y) {
                std::memcpy(image.bytes.data() + static_cast<std::size_t>(y0 + y) * row +
                                4 * pixel * static_cast<std::size_t>(bx),
                            texels.data() + 4 * pixel * static_cast<std::size_t>(y), length);
            }
        }
    });
    return image;
}

}  // namespace petrichor::texproc
