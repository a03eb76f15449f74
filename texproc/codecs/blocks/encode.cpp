#include "texproc/codecs/blocks/blocks.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "texproc/codecs/blocks/detail/astc.h"
#include "texproc/codecs/blocks/detail/block_table.h"
#include "texproc/codecs/blocks/detail/decode_block.h"
#include "texproc/codecs/blocks/detail/repeat.h"

namespace petrichor::texproc {

const detail::EncodeKernel& detail::encode_kernel()
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) return kEncodeKernelAvx2;
#endif
    return kEncodeKernelBase;
}

namespace {

// First number of a texel of a block; what lies past an edge repeats the edge.
std::size_t first_number(const RawImage& image, int bx, int by, int texel)
{
    const int x = std::min(4 * bx + texel % 4, image.width - 1);
    const int y = std::min(4 * by + texel / 4, image.height - 1);
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
            static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(image.channels);
}

// The 16 texels of a block in four planes.
detail::BlockTexels gather(const RawImage& image, int bx, int by)
{
    detail::BlockTexels texels;
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    for (int t = 0; t < 16; ++t) {
        const std::size_t at = first_number(image, bx, by, t);
        const auto code = [&](std::size_t c) {
            return static_cast<std::uint8_t>(image.bytes[at + c]);
        };
        texels.plane[0][t] = code(0);
        texels.plane[1][t] = channels > 1 ? code(1) : code(0);
        texels.plane[2][t] = channels > 2 ? code(2) : channels == 1 ? code(0) : std::uint8_t{0};
        texels.plane[3][t] = channels > 3 ? code(3) : std::uint8_t{255};
    }
    return texels;
}

detail::HalfTexels gather_halves(const RawImage& image, int bx, int by)
{
    detail::HalfTexels texels;
    const std::size_t channels = static_cast<std::size_t>(image.channels);
    for (int t = 0; t < 16; ++t) {
        const std::size_t at = first_number(image, bx, by, t);
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint16_t half = 0;
            if (c < channels || channels == 1)
                std::memcpy(&half, &image.bytes[2 * (at + (channels == 1 ? 0 : c))], 2);
            texels.plane[c][t] = half;
        }
    }
    return texels;
}

}  // namespace

std::vector<std::byte> encode_blocks(const RawImage& image, Block block,
                                     const BlockOptions& options)
{
    const detail::BlockRow& format = detail::row_of(block);
    if (!format.encode && !format.encode_halves && !format.astc) {
        throw Error(std::string("block texture: ") + format.title + " can be read, not written",
                    "Use bc3 or bc7, or bc6h for what is beyond 0..1.");
    }
    const PixelType type = format.encode_halves ? PixelType::F16 : PixelType::U8;
    if (image.width < 1 || image.height < 1 || image.channels < 1 || image.type != type ||
        image.bytes.size() != image.values() * size_of(type)) {
        const std::string numbers = format.encode_halves ? "half floats" : "8-bit codes";
        throw Error("block texture: it is made from " + numbers + ", at least one pixel of them",
                    "Convert the image to " + numbers + " first.");
    }
    if (!(options.repeat >= 0.0f)) {
        throw Error("block texture: the price of a bit must be 0 or more, got " +
                        std::to_string(options.repeat),
                    "Give a number from 0 (no bytes are repeated), or leave it out.");
    }
    if (!(options.repeat_most > 0.0f)) {
        throw Error("block texture: repeated bytes must be allowed an error of more than 0 codes, got " +
                        std::to_string(options.repeat_most),
                    "Give codes such as 1, or leave it out.");
    }
    if (options.repeat > 0.0f && !format.encode) {
        throw Error(std::string("block texture: ") + format.title +
                        " cannot trade error for size",
                    "Use BC1, BC3, BC4, BC5, BC7 or UASTC, or leave it out.");
    }
    if (format.astc) return detail::encode_astc(image, format.side, options);
    // An alpha that data do not have is read by nobody, and 254 in its place frees the low bits of ends (mode 6).
    BlockOptions chosen = options;
    if (block == Block::Bc7 && image.channels < 4 && !options.srgb) chosen.weights[3] = 0.0f;
    std::vector<std::byte> bytes(blocks_size(block, image.width, image.height));
    const int across = (image.width + 3) / 4;
    parallel_for(static_cast<std::size_t>((image.height + 3) / 4), options.threads,
                 [&](std::size_t by) {
                     std::byte* to =
                         bytes.data() + by * static_cast<std::size_t>(across) * format.bytes;
                     for (int bx = 0; bx < across; ++bx, to += format.bytes) {
                         const int y = static_cast<int>(by);
                         if (format.encode_halves) {
                             format.encode_halves(gather_halves(image, bx, y), options,
                                                  options.is_signed, to);
                         } else {
                             format.encode(gather(image, bx, y), chosen, to);
                         }
                     }
                 });
    if (options.repeat > 0.0f) {
        std::array<float, 4> weights = options.weights;
        if (image.channels < 4) weights[3] = std::max(weights[3], 1.0f);  // opaque stays so
        detail::repeat_blocks(
            bytes, across, format,
            [&](int bx, int by) {
                detail::BlockTexels texels = gather(image, bx, by);
                // An alpha that the blocks cannot hold is no error of theirs.
                if (block == Block::Bc1 && !options.punch_through)
                    std::fill(std::begin(texels.plane[3]), std::end(texels.plane[3]),
                              std::uint8_t{255});
                return texels;
            },
            weights,
            options.repeat, options.repeat_most, options.threads);
    }
    return bytes;
}

std::array<std::uint8_t, 8> encode_bc4_block(const std::array<std::uint8_t, 16>& values,
                                             BlockQuality quality)
{
    std::array<std::byte, 8> bytes;
    detail::encode_kernel().bc4(values.data(), quality, bytes.data());
    std::array<std::uint8_t, 8> block;
    std::memcpy(block.data(), bytes.data(), 8);
    return block;
}

Bc4Choice encode_bc4_block(const TexelCosts& costs, int reach)
{
    int low = 255, high = 0;
    for (const auto& cost : costs) {
        const auto [least, most] = std::minmax_element(cost.begin(), cost.end());
        if (*least == *most) continue;  // a texel to which every code is the same
        const int best = static_cast<int>(least - cost.begin());
        low = std::min(low, best);
        high = std::max(high, best);
    }
    if (low > high) low = high = 0;
    Bc4Choice choice;
    choice.cost = std::numeric_limits<double>::infinity();
    int chosen[2] = {low, low};
    const auto look = [&](int r0, int r1) {
        const auto palette = detail::bc4_palette(r0, r1);
        double total = 0.0;
        for (const auto& cost : costs) {
            float least = cost[palette[0]];
            for (const std::uint8_t p : palette) least = std::min(least, cost[p]);
            total += static_cast<double>(least);
        }
        if (total < choice.cost) {
            choice.cost = total;
            chosen[0] = r0;
            chosen[1] = r1;
        }
    };
    for (int a = std::max(0, low - reach); a <= std::min(255, low + reach); ++a) {
        for (int b = std::max(0, high - reach); b <= std::min(255, high + reach); ++b) {
            look(a, b);  // six values and 0 and 255 when a <= b, else eight
            look(b, a);
        }
    }
    const auto palette = detail::bc4_palette(chosen[0], chosen[1]);
    std::uint64_t bits =
        static_cast<std::uint64_t>(chosen[0]) | static_cast<std::uint64_t>(chosen[1]) << 8;
    for (std::size_t t = 0; t < 16; ++t) {
        std::size_t index = 0;
        for (std::size_t k = 1; k < 8; ++k) {
            if (costs[t][palette[k]] < costs[t][palette[index]]) index = k;
        }
        choice.values[t] = palette[index];
        bits |= static_cast<std::uint64_t>(index) << (16 + 3 * t);
    }
    for (std::size_t i = 0; i < 8; ++i)
        choice.block[i] = static_cast<std::uint8_t>(bits >> (8 * i));
    return choice;
}

}  // namespace petrichor::texproc
