#include <array>
#include <cstddef>
#include <cstdint>

#include "texproc/codecs/blocks/detail/bit_reader.h"
#include "texproc/codecs/blocks/detail/decode_block.h"
#include "texproc/codecs/blocks/detail/uastc_tables.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t at(int i)
{
    return static_cast<std::size_t>(i);
}

// What the seven lowest bits of a block name: a mode, or -1.
constexpr std::array<std::int8_t, 128> kModeOf = [] {
    std::array<std::int8_t, 128> table{};
    for (std::size_t bits = 0; bits < 128; ++bits) {
        table[bits] = -1;
        for (std::size_t m = kUastcModes.size(); m-- > 0;) {
            const UastcMode& mode = kUastcModes[m];
            if ((static_cast<int>(bits) & ((1 << mode.code_bits) - 1)) == mode.code)
                table[bits] = static_cast<std::int8_t>(m);
        }
    }
    return table;
}();

// 8-bit values of the codes of every range.
constexpr std::array<std::array<std::uint8_t, 256>, 8> kEnds = [] {
    std::array<std::array<std::uint8_t, 256>, 8> table{};
    for (int range = 0; range < 8; ++range) {
        for (int code = 0; code < kUastcRanges[at(range)].levels(); ++code)
            table[at(range)][at(code)] = static_cast<std::uint8_t>(uastc_end(code, range));
    }
    return table;
}();

// Five digits of base 3 in 8 bits, three of base 5 in 7; what no group holds is read in the same way.
constexpr std::array<std::array<std::uint8_t, 5>, 256> digits_of(int base, int digits)
{
    std::array<std::array<std::uint8_t, 5>, 256> table{};
    for (int packed = 0; packed < 256; ++packed) {
        for (int k = 0, rest = packed; k < digits; ++k, rest /= base)
            table[at(packed)][at(k)] = static_cast<std::uint8_t>(rest % base);
    }
    return table;
}
constexpr std::array<std::array<std::uint8_t, 5>, 256> kThrees = digits_of(3, 5), kFives = digits_of(5, 3);

// By the group of the mode (two subsets, mode 7, mode 3) and pattern: subsets, two bits a texel, and their first texels.
struct Pattern {
    std::uint32_t subsets = 0;
    std::array<std::uint8_t, 3> anchors{};
};
constexpr std::array<std::array<Pattern, 32>, 3> kPatterns = [] {
    std::array<std::array<Pattern, 32>, 3> table{};
    constexpr int kModeOfGroup[3] = {2, 7, 3};
    for (int group = 0; group < 3; ++group) {
        const int mode = kModeOfGroup[group];
        for (int p = 0; p < uastc_pattern_count(mode); ++p) {
            Pattern& pattern = table[at(group)][at(p)];
            for (int t = 0; t < 16; ++t)
                pattern.subsets |= static_cast<std::uint32_t>(uastc_subset(mode, p, t)) << (2 * t);
            for (int s = 0; s < kUastcModes[at(mode)].subsets; ++s)
                pattern.anchors[at(s)] = static_cast<std::uint8_t>(uastc_anchor(mode, p, s));
        }
    }
    return table;
}();

// By bits of a weight and index.
constexpr std::array<std::array<int, 32>, 6> kWeights = [] {
    std::array<std::array<int, 32>, 6> table{};
    for (int bits = 1; bits < 6; ++bits) {
        for (int k = 0; k < 1 << bits; ++k) table[at(bits)][at(k)] = uastc_weight(k, bits);
    }
    return table;
}();

// Bits that so many digits of a base share.
int shared_bits(int base, int digits)
{
    constexpr int kThree[6] = {0, 2, 4, 5, 7, 8}, kFive[4] = {0, 3, 5, 7};
    return base == 3 ? kThree[digits] : kFive[digits];
}

// The ends as 8-bit values.
void take_ends(BitReader& bits, const UastcMode& mode, std::array<int, 20>& ends)
{
    const UastcRange& range = kUastcRanges[at(mode.range)];
    const int count = 2 * mode.channels * mode.subsets;
    std::array<int, 20> digits{};  // room for a whole last group
    const int group = range.base == 3 ? 5 : 3;
    for (int i = 0; range.base && i < count; i += group) {
        const int here = count - i < group ? count - i : group;
        const int packed = bits.take(shared_bits(range.base, here));
        const auto& found = (range.base == 3 ? kThrees : kFives)[at(packed)];
        for (int k = 0; k < here; ++k) digits[at(i + k)] = found[at(k)];
    }
    for (std::size_t i = 0; i < at(count); ++i)
        ends[i] = kEnds[at(mode.range)][at(bits.take(range.bits) | digits[i] << range.bits)];
}

}  // namespace

void decode_uastc(const std::byte* block, Rgba8Block& to)
{
    BitReader bits(block);
    const int number = kModeOf[static_cast<std::size_t>(block[0]) & 127];
    if (number < 0) {
        to = {};  // what is not a block is black and transparent
        return;
    }
    const UastcMode& mode = kUastcModes[at(number)];
    bits.take(mode.code_bits);
    if (number == kUastcFlat) {
        std::array<std::uint8_t, 4> color;
        for (std::uint8_t& c : color) c = static_cast<std::uint8_t>(bits.take(8));
        to.fill(color);
        return;
    }
    bits.take(mode.hint_bits);
    const int number_of_pattern = bits.take(mode.pattern_bits);
    if (mode.pattern_bits && number_of_pattern >= uastc_pattern_count(number)) {
        to = {};
        return;
    }
    int apart = mode.channels - 1;  // the channel with weights of its own
    if (mode.planes == 2 && mode.channels > 2) apart = bits.take(2);
    std::array<int, 20> ends{};
    take_ends(bits, mode, ends);
    const Pattern pattern =
        mode.pattern_bits ? kPatterns[number == 3 ? 2 : number == 7 ? 1 : 0][at(number_of_pattern)] : Pattern{};

    // Every colour that a subset can have, then a look at each texel's. uastc_mix() is one product and one sum.
    std::array<std::array<std::array<std::uint8_t, 4>, 32>, 3> colors;
    const int steps = 1 << mode.weight_bits;
    const auto& weights = kWeights[at(mode.weight_bits)];
    for (int s = 0; s < mode.subsets; ++s) {
        const int* of = &ends[at(2 * mode.channels * s)];
        int start[4] = {0, 0, 0, 255 << 14}, step[4] = {};
        for (int c = 0; c < mode.channels; ++c) {
            start[c] = 257 * 64 * of[2 * c] + 32;
            step[c] = 257 * (of[2 * c + 1] - of[2 * c]);
        }
        if (mode.channels == 2) {
            start[3] = start[1], step[3] = step[1];
            start[1] = start[2] = start[0], step[1] = step[2] = step[0];
        }
        for (int k = 0; k < steps; ++k) {
            for (std::size_t c = 0; c < 4; ++c)
                colors[at(s)][at(k)][c] = static_cast<std::uint8_t>((start[c] + step[c] * weights[at(k)]) >> 14);
        }
    }
    std::uint32_t first = 0;  // a bit for each texel whose weights lack the highest
    for (int s = 0; s < mode.subsets; ++s) first |= 1u << pattern.anchors[at(s)];
    if (mode.planes == 1) {
        for (int t = 0; t < 16; ++t) {
            const int width = mode.weight_bits - static_cast<int>(first >> t & 1);
            to[at(t)] = colors[pattern.subsets >> (2 * t) & 3][at(bits.take_some(width))];
        }
        return;
    }
    const std::size_t own = at(mode.channels == 2 ? 3 : apart);
    const bool has_own = mode.channels == 2 || apart < mode.channels;
    for (int t = 0; t < 16; ++t) {
        const int width = mode.weight_bits - (t == 0 ? 1 : 0);
        to[at(t)] = colors[0][at(bits.take(width))];
        const int second = bits.take(width);
        if (has_own) to[at(t)][own] = colors[0][at(second)][own];
    }
}

}  // namespace petrichor::texproc::detail
