#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "texproc/codecs/blocks/detail/bc7_tables.h"
#include "texproc/codecs/blocks/detail/bit_reader.h"
#include "texproc/codecs/blocks/detail/decode_block.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t at(int i)
{
    return static_cast<std::size_t>(i);
}

// A partition: subsets, two bits a texel, and the texels whose index lacks its highest bit, in rising order.
struct Pattern {
    std::uint32_t subsets = 0;
    std::array<std::uint8_t, 3> anchors{};
};
// By number of subsets less one.
constexpr std::array<std::array<Pattern, 64>, 3> kPatterns = [] {
    std::array<std::array<Pattern, 64>, 3> table{};
    for (int subsets = 1; subsets <= 3; ++subsets) {
        for (int p = 0; p < 64; ++p) {
            Pattern& pattern = table[at(subsets - 1)][at(p)];
            for (int t = 0; t < 16; ++t)
                pattern.subsets |= static_cast<std::uint32_t>(bc7_subset(subsets, p, t)) << (2 * t);
            for (int s = 0; s < subsets; ++s)
                pattern.anchors[at(s)] = static_cast<std::uint8_t>(bc7_anchor(subsets, p, s));
            if (subsets == 3 && pattern.anchors[1] > pattern.anchors[2]) {
                const std::uint8_t first = pattern.anchors[2];
                pattern.anchors[2] = pattern.anchors[1];
                pattern.anchors[1] = first;
            }
        }
    }
    return table;
}();

// Indices of 16 texels, each of `width` bits: those of anchors get the highest bit that is not stored.
std::uint64_t with_anchors(std::uint64_t stored, int width, const Pattern& pattern, int subsets)
{
    for (int s = 0; s < subsets; ++s) {
        const int place = pattern.anchors[at(s)] * width + width - 1;
        const std::uint64_t below = (std::uint64_t{1} << place) - 1;
        stored = (stored & below) | (stored & ~below) << 1;
    }
    return stored;
}

std::size_t index_of(std::uint64_t indices, int width, int texel)
{
    return static_cast<std::size_t>(indices >> (width * texel) & ((1u << width) - 1));
}

using Color = std::array<std::uint8_t, 4>;

// Every colour between two ends: bc7_mix() as one product and one sum.
template <int kBits>
void fill_palette(const int (&a)[4], const int (&b)[4], Color* to)
{
    constexpr const int* kWeights = bc7_weights(kBits);
    for (int k = 0; k < 1 << kBits; ++k)
        for (int c = 0; c < 4; ++c)
            to[k][at(c)] = static_cast<std::uint8_t>((64 * a[c] + 32 + (b[c] - a[c]) * kWeights[k]) >> 6);
}

template <int kNumber>
void decode_mode(BitReader bits, Rgba8Block& to)
{
    constexpr Bc7Mode kMode = kBc7Modes[kNumber];
    bits.take_some(kNumber + 1);
    const Pattern& pattern = kPatterns[kMode.subsets - 1][at(bits.take(kMode.partition_bits))];
    const int rotation = bits.take(kMode.rotation_bits);
    const bool swapped = bits.take(kMode.selector_bits) != 0;

    constexpr int kEnds = 2 * kMode.subsets;
    int ends[kEnds][4];
    for (int c = 0; c < 4; ++c) {
        const int depth = c < 3 ? kMode.color_bits : kMode.alpha_bits;
        for (auto& end : ends) end[c] = bits.take(depth);
    }
    constexpr bool kLow = kMode.endpoint_p_bits || kMode.shared_p_bits;
    int low = 0;
    for (int e = 0; e < kEnds; ++e) {
        if (kMode.endpoint_p_bits || (kMode.shared_p_bits && e % 2 == 0)) low = bits.take_some(1);
        for (int c = 0; c < 4; ++c) {
            const int depth = c < 3 ? kMode.color_bits : kMode.alpha_bits;
            ends[e][c] = depth == 0 ? 255
                         : kLow     ? bc7_widen(2 * ends[e][c] + low, depth + 1)
                                    : bc7_widen(ends[e][c], depth);
        }
    }

    constexpr int kWidth = kMode.index_bits, kOther = kMode.index2_bits;
    if constexpr (kOther == 0) {
        Color colors[kMode.subsets][1 << kWidth];
        for (int s = 0; s < kMode.subsets; ++s)
            fill_palette<kWidth>(ends[2 * s], ends[2 * s + 1], colors[s]);
        const std::uint64_t indices = with_anchors(bits.rest(), kWidth, pattern, kMode.subsets);
        for (int t = 0; t < 16; ++t)
            to[at(t)] = colors[pattern.subsets >> (2 * t) & 3][index_of(indices, kWidth, t)];
    } else {  // colour and alpha have indices of their own
        Color by_first[1 << kWidth], by_second[1 << kOther];
        fill_palette<kWidth>(ends[0], ends[1], by_first);
        fill_palette<kOther>(ends[0], ends[1], by_second);
        const std::uint64_t first = with_anchors(static_cast<std::uint64_t>(bits.take_some(16 * kWidth - 1)),
                                                 kWidth, pattern, 1);
        const std::uint64_t second = with_anchors(bits.rest(), kOther, pattern, 1);
        for (int t = 0; t < 16; ++t) {
            const Color& one = by_first[index_of(first, kWidth, t)];
            const Color& other = by_second[index_of(second, kOther, t)];
            Color& texel = to[at(t)];
            texel = swapped ? other : one;
            texel[3] = swapped ? one[3] : other[3];
            if (rotation) std::swap(texel[3], texel[at(rotation - 1)]);
        }
    }
}

}  // namespace

void decode_bc7(const std::byte* block, Rgba8Block& to)
{
    const BitReader bits(block);
    switch (std::countr_zero(static_cast<unsigned>(block[0]) | 256u)) {
        case 0: return decode_mode<0>(bits, to);
        case 1: return decode_mode<1>(bits, to);
        case 2: return decode_mode<2>(bits, to);
        case 3: return decode_mode<3>(bits, to);
        case 4: return decode_mode<4>(bits, to);
        case 5: return decode_mode<5>(bits, to);
        case 6: return decode_mode<6>(bits, to);
        case 7: return decode_mode<7>(bits, to);
        default: to = Rgba8Block{};  // reserved: the format asks for zeros
    }
}

}  // namespace petrichor::texproc::detail
