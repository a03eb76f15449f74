#include "texproc/codecs/blocks/detail/block_table.h"

#include <cassert>
#include <cstring>

#include "texproc/codecs/blocks/detail/decode_block.h"

namespace petrichor::texproc::detail {

namespace {

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
    if (sign == BlockSign::Signed) put_all(decode_bc4_signed(block));
    if (sign == BlockSign::Unsigned) put_all(decode_bc4(block));
    if (sign == BlockSign::Exact) put_all(decode_bc4_exact(block));
}

template <class Texels>
void put_texels(const Texels& texels, BlockBytes& to)
{
    static_assert(sizeof(Texels) <= sizeof(BlockBytes));
    std::memcpy(to.data(), texels.data(), sizeof texels);
}

void decode_1(const std::byte* from, BlockSign, BlockBytes& to)
{
    Rgba8Block texels;
    decode_bc1(from, false, texels);
    put_texels(texels, to);
}

void decode_2(const std::byte* from, BlockSign, BlockBytes& to)
{
    Rgba8Block texels;
    decode_bc1(from + 8, true, texels);
    for (std::size_t t = 0; t < 16; ++t) {
        const int four = (static_cast<int>(from[t / 2]) >> (4 * (t % 2))) & 15;
        texels[t][3] = static_cast<std::uint8_t>(17 * four);
    }
    put_texels(texels, to);
}

void decode_3(const std::byte* from, BlockSign, BlockBytes& to)
{
    Rgba8Block texels;
    decode_bc1(from + 8, true, texels);
    const auto alpha = decode_bc4(from);
    for (std::size_t t = 0; t < 16; ++t) texels[t][3] = alpha[t];
    put_texels(texels, to);
}

void decode_4(const std::byte* from, BlockSign sign, BlockBytes& to)
{
    put_channel(from, sign, 0, 1, to);
}

void decode_5(const std::byte* from, BlockSign sign, BlockBytes& to)
{
    for (std::size_t c = 0; c < 2; ++c) put_channel(from + 8 * c, sign, c, 2, to);
}

void decode_6h(const std::byte* from, BlockSign sign, BlockBytes& to)
{
    put_texels(decode_bc6h(from, sign == BlockSign::Signed), to);
}

void decode_7(const std::byte* from, BlockSign, BlockBytes& to)
{
    Rgba8Block texels;
    decode_bc7(from, texels);
    put_texels(texels, to);
}

void decode_u(const std::byte* from, BlockSign, BlockBytes& to)
{
    Rgba8Block texels;
    decode_uastc(from, texels);
    put_texels(texels, to);
}

void encode_1(const BlockTexels& texels, const BlockOptions& options, std::byte* to)
{
    encode_kernel().bc1(texels, options, options.punch_through ? Bc1Use::Holes : Bc1Use::Opaque,
                        to);
}

void encode_3(const BlockTexels& texels, const BlockOptions& options, std::byte* to)
{
    encode_kernel().bc4(texels.plane[3], options.quality, to);
    encode_kernel().bc1(texels, options, Bc1Use::Four, to + 8);
}

void encode_4(const BlockTexels& texels, const BlockOptions& options, std::byte* to)
{
    encode_kernel().bc4(texels.plane[0], options.quality, to);
}

void encode_5(const BlockTexels& texels, const BlockOptions& options, std::byte* to)
{
    encode_kernel().bc4(texels.plane[0], options.quality, to);
    encode_kernel().bc4(texels.plane[1], options.quality, to + 8);
}

void encode_7(const BlockTexels& texels, const BlockOptions& options, std::byte* to)
{
    encode_kernel().bc7(texels, options, to);
}

void encode_u(const BlockTexels& texels, const BlockOptions& options, std::byte* to)
{
    encode_kernel().uastc(texels, options, to);
}

BlockRow astc_row(Block block, const char* title, int side, BlockLabel label)
{
    return {.block = block,
            .title = title,
            .bytes = 16,
            .channels = 4,
            .halves = false,
            .wide = false,
            .decode = nullptr,
            .encode = nullptr,
            .color_model = 162,
            .labels = {std::move(label)},
            .side = side,
            .astc = true};
}

}  // namespace

const std::vector<BlockRow>& block_table()
{
    // {name, channels, signed, DXGI, its sRGB, Vulkan, its sRGB, four letters, parts}
    static const std::vector<BlockRow> table{
        {Block::Bc1, "BC1", 8, 4, false, false, decode_1, encode_1, 128,
         {{"bc1", 3, false, 71, 72, 131, 132, "DXT1", {0}},
          {"bc1a", 4, false, 71, 72, 133, 134, "DXT1", {1}}}},
        {Block::Bc2, "BC2", 16, 4, false, false, decode_2, nullptr, 129,
         {{"bc2", 4, false, 74, 75, 135, 136, "", {15, 0}}}},
        {Block::Bc3, "BC3", 16, 4, false, false, decode_3, encode_3, 130,
         {{"bc3", 4, false, 77, 78, 137, 138, "DXT5", {15, 0}}}},
        {Block::Bc4, "BC4", 8, 1, false, true, decode_4, encode_4, 131,
         {{"bc4", 1, false, 80, 0, 139, 0, "ATI1", {0}},
          {"bc4-signed", 1, true, 81, 0, 140, 0, "", {0}}}},
        {Block::Bc5, "BC5", 16, 2, false, true, decode_5, encode_5, 132,
         {{"bc5", 2, false, 83, 0, 141, 0, "ATI2", {0, 1}},
          {"bc5-signed", 2, true, 84, 0, 142, 0, "", {0, 1}}}},
        {Block::Bc6h, "BC6H", 16, 3, true, false, decode_6h, nullptr, 133,
         {{"bc6h", 3, false, 95, 0, 143, 0, "", {0}},
          {"bc6h-signed", 3, true, 96, 0, 144, 0, "", {0}}},
         encode_bc6h},
        {Block::Bc7, "BC7", 16, 4, false, false, decode_7, encode_7, 134,
         {{"bc7", 4, false, 98, 99, 145, 146, "", {0}}}},
        {Block::Uastc, "UASTC", 16, 4, false, false, decode_u, encode_u, 166,
         {{"uastc", 3, false, 0, 0, 0, 0, "", {0}}, {"uastca", 4, false, 0, 0, 0, 0, "", {3}}}},
        astc_row(Block::Astc4, "ASTC 4x4", 4, {"astc-4x4", 4, false, 0, 0, 157, 158, "", {0}}),
        astc_row(Block::Astc5, "ASTC 5x5", 5, {"astc-5x5", 4, false, 0, 0, 161, 162, "", {0}}),
        astc_row(Block::Astc6, "ASTC 6x6", 6, {"astc-6x6", 4, false, 0, 0, 165, 166, "", {0}}),
        astc_row(Block::Astc8, "ASTC 8x8", 8, {"astc-8x8", 4, false, 0, 0, 171, 172, "", {0}}),
    };
    return table;
}

const BlockRow& row_of(Block block)
{
    const auto& table = block_table();
    const auto index = static_cast<std::size_t>(block);
    assert(index < table.size() && table[index].block == block);
    return table[index];
}

}  // namespace petrichor::texproc::detail
