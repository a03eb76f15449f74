#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_DECODE_BLOCK_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_DECODE_BLOCK_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace petrichor::texproc::detail {

using Rgba8Block = std::array<std::array<std::uint8_t, 4>, 16>;  // texel, channel

/// Endpoint channels of 5 and 6 bits to 8, nearest.
constexpr int widen5(int v)
{
    return (v * 527 + 23) >> 6;
}
constexpr int widen6(int v)
{
    return (v * 259 + 33) >> 6;
}

/// The four colours of a BC1 block: R, G, B, A. Two thirds of one and one third of the other; with
/// `three` (and c0 <= c1, which callers check) the half-way colour and transparent black.
std::array<std::array<std::uint8_t, 4>, 4> bc1_palette(std::uint16_t c0, std::uint16_t c1,
                                                       bool three);

/// The eight values of a BC4 block.
std::array<std::uint8_t, 8> bc4_palette(int r0, int r1);
/// The same in codes with their fractions.
inline std::array<float, 8> exact_bc4_palette(int r0, int r1)
{
    const int steps = r0 > r1 ? 7 : 5;
    const float first = static_cast<float>(r0), last = static_cast<float>(r1);
    std::array<float, 8> palette{first, last, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 255.0f};
    for (int k = 1; k < steps; ++k) {
        palette[static_cast<std::size_t>(k) + 1] =
            (static_cast<float>(steps - k) * first + static_cast<float>(k) * last) /
            static_cast<float>(steps);
    }
    return palette;
}

void decode_bc1(const std::byte* block, bool always_four, Rgba8Block& to);
std::array<std::uint8_t, 16> decode_bc4(const std::byte* block);
std::array<float, 16> decode_bc4_exact(const std::byte* block);  ///< 0..1
std::array<float, 16> decode_bc4_signed(const std::byte* block);
void decode_bc7(const std::byte* block, Rgba8Block& to);
void decode_uastc(const std::byte* block, Rgba8Block& to);
/// Half-float bits.
std::array<std::array<std::uint16_t, 3>, 16> decode_bc6h(const std::byte* block, bool is_signed);

}  // namespace petrichor::texproc::detail

#endif
