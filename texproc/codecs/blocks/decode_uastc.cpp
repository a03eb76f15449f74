#include <array>
#include <cstddef>
#include <cstdint>

#include "texproc/codecs/blocks/detail/bit_reader.h"
#include "texproc/codecs/blocks/detail/decode_block.h"
#include "texproc/codecs/blocks/detail/uastc_tables.h"

namespace petrichor::texproc::detail {

namespace {

// The mode that the lowest bits name; -1: none.
int mode_of(int seven_bits)
{
    for (std::size_t m = 0; m < kUastcModes.size(); ++m) {
        const UastcMode& mode = kUastcModes[m];
        if ((seven_bits & ((1 << mode.code_bits) - 1)) == mode.code) return static_cast<int>(m);
    }
    return -1;
}

// Bits that so many digits of a base share.
int shared_bits(int base, int digits)
{
    constexpr int kThree[6] = {0, 2, 4, 5, 7, 8}, kFive[4] = {0, 3, 5, 7};
    return base == 3 ? kThree[digits] : kFive[digits];
}

// The ends as 8-bit values.
void take_ends(BitReader& bits, const UastcMode& mode, std::array<int, 18>& ends)
{
    const UastcRange& range = kUastcRanges[static_cast<std::size_t>(mode.range)];
    const int count = 2 * mode.channels * mode.subsets;
    std::array<int, 18> digits{};
    const int group = range.base == 3 ? 5 : 3;
    for (int i = 0; range.base && i < count; i += group) {
        const int here = count - i < group ? count - i : group;
        int packed = bits.take(shared_bits(range.base, here));
        for (int k = 0; k < here; ++k, packed /= range.base)
            digits[static_cast<std::size_t>(i + k)] = packed % range.base;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        ends[i] = uastc_end(bits.take(range.bits) | digits[i] << range.bits, mode.range);
}

}  // namespace

void decode_uastc(const std::byte* block, Rgba8Block& to)
{
    to = {};  // what is not a block is black and transparent
    BitReader bits(block);
    const int number = mode_of(static_cast<int>(block[0]) & 127);
    if (number < 0) return;
    const UastcMode& mode = kUastcModes[static_cast<std::size_t>(number)];
    bits.take(mode.code_bits);
    if (number == kUastcFlat) {
        std::array<std::uint8_t, 4> color;
        for (std::uint8_t& c : color) c = static_cast<std::uint8_t>(bits.take(8));
        to.fill(color);
        return;
    }
    bits.take(mode.hint_bits);
    const int pattern = bits.take(mode.pattern_bits);
    if (mode.pattern_bits && pattern >= uastc_pattern_count(number)) return;
    int apart = mode.channels - 1;  // the channel with weights of its own
    if (mode.planes == 2 && mode.channels > 2) apart = bits.take(2);
    std::array<int, 18> ends{};
    take_ends(bits, mode, ends);
    std::array<int, 3> anchors{-1, -1, -1};
    for (int s = 0; s < mode.subsets; ++s)
        anchors[static_cast<std::size_t>(s)] = uastc_anchor(number, pattern, s);
    for (int t = 0; t < 16; ++t) {
        const int subset = uastc_subset(number, pattern, t);
        const bool anchor = anchors[static_cast<std::size_t>(subset)] == t;
        int weight[2] = {};
        for (int p = 0; p < mode.planes; ++p)
            weight[p] =
                uastc_weight(bits.take(mode.weight_bits - (anchor ? 1 : 0)), mode.weight_bits);
        const int* of = &ends[static_cast<std::size_t>(2 * mode.channels * subset)];
        int value[4] = {0, 0, 0, 255};
        for (int c = 0; c < mode.channels; ++c) {
            const int w = weight[mode.planes == 2 && c == apart ? 1 : 0];
            value[c] = uastc_mix(of[2 * c], of[2 * c + 1], w);
        }
        if (mode.channels == 2) {
            value[3] = value[1];
            value[1] = value[2] = value[0];
        }
        for (std::size_t c = 0; c < 4; ++c)
            to[static_cast<std::size_t>(t)][c] = static_cast<std::uint8_t>(value[c]);
    }
}

}  // namespace petrichor::texproc::detail
