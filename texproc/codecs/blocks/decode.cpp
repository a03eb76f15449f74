#include "texproc/codecs/blocks/blocks.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/codecs/blocks/detail/decode_block.h"

namespace petrichor::texproc {

namespace {

// The 16 texels of one block as bytes of the output image.
using BlockBytes = std::array<std::byte, 16 * 16>;

template <class Value>
void put(BlockBytes& to, std::size_t at, Value value)
{
    std::memcpy(to.data() + at * sizeof value, &value, sizeof value);
}

void put_channel(const std::byte* block, BlockSign sign, std::size_t channel, std::size_t channels,
                 BlockBytes& to)
{
    const auto put_all = [&](const auto& values) {
        for (std::size_t t = 0; t < 16; ++t) put(to, t * channels + channel, values[t]);
    };
    if (sign == BlockSign::Signed) put_all(detail::decode_bc4_signed(block));
    if (sign == BlockSign::Unsigned) put_all(detail::decode_bc4(block));
    if (sign == BlockSign::Exact) put_all(detail::decode_bc4_exact(block));
}

void decode_one(const std::byte* from, Block block, BlockSign sign, BlockBytes& to)
{
    if (block == Block::Bc4 || block == Block::Bc5) {
        const std::size_t channels = block == Block::Bc4 ? 1 : 2;
        for (std::size_t c = 0; c < channels; ++c) {
            put_channel(from + 8 * c, sign, c, channels, to);
        }
        return;
    }
    if (block == Block::Bc6h) {
        const auto texels = detail::decode_bc6h(from, sign == BlockSign::Signed);
        std::memcpy(to.data(), texels.data(), sizeof texels);
        return;
    }
    detail::Rgba8Block texels;
    if (block == Block::Bc7) {
        detail::decode_bc7(from, texels);
    } else {
        const bool alpha_first = block != Block::Bc1;
        detail::decode_bc1(alpha_first ? from + 8 : from, alpha_first, texels);
        if (block == Block::Bc3) {
            const auto alpha = detail::decode_bc4(from);
            for (std::size_t t = 0; t < 16; ++t) texels[t][3] = alpha[t];
        } else if (block == Block::Bc2) {
            for (std::size_t t = 0; t < 16; ++t) {
                const int four = (static_cast<int>(from[t / 2]) >> (4 * (t % 2))) & 15;
                texels[t][3] = static_cast<std::uint8_t>(17 * four);
            }
        }
    }
    std::memcpy(to.data(), texels.data(), sizeof texels);
}

}  // namespace

std::size_t blocks_size(Block block, int width, int height)
{
    return static_cast<std::size_t>((width + 3) / 4) * static_cast<std::size_t>((height + 3) / 4) *
           block_bytes(block);
}

int channels_of(Block block)
{
    return block == Block::Bc4 ? 1 : block == Block::Bc5 ? 2 : block == Block::Bc6h ? 3 : 4;
}

RawImage decode_blocks(std::span<const std::byte> bytes, Block block, int width, int height,
                       BlockSign sign, int threads)
{
    if (width < 1 || height < 1 || bytes.size() < blocks_size(block, width, height)) {
        throw Error("block texture: " + std::to_string(width) + " x " + std::to_string(height) +
                        " texels need more than the " + std::to_string(bytes.size()) +
                        " bytes that are there",
                    "Export the file again; it is damaged.");
    }
    const bool wide = sign != BlockSign::Unsigned && (block == Block::Bc4 || block == Block::Bc5);
    const PixelType type = block == Block::Bc6h ? PixelType::F16
                           : wide               ? PixelType::F32
                                                : PixelType::U8;
    RawImage image{width, height, channels_of(block), type, {}, {}};
    image.bytes.resize(image.values() * size_of(type));
    const std::size_t pixel = static_cast<std::size_t>(image.channels) * size_of(type);
    const std::size_t row = pixel * static_cast<std::size_t>(width);
    const int across = (width + 3) / 4;
    parallel_for(static_cast<std::size_t>((height + 3) / 4), threads, [&](std::size_t by) {
        const int y0 = 4 * static_cast<int>(by);
        const int rows = std::min(4, height - y0);
        const std::byte* from =
            bytes.data() + by * static_cast<std::size_t>(across) * block_bytes(block);
        for (int bx = 0; bx < across; ++bx, from += block_bytes(block)) {
            BlockBytes texels;
            decode_one(from, block, sign, texels);
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
