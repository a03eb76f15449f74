// BC6H: packed half-float endpoints. Source: Khronos Data Format Specification 1.3, BPTC.
#include "texproc/codecs/blocks/detail/bc6h_modes.h"
#include "texproc/codecs/blocks/detail/bc7_tables.h"
#include "texproc/codecs/blocks/detail/bit_reader.h"
#include "texproc/codecs/blocks/detail/decode_block.h"

#include <cstring>

namespace petrichor::texproc::detail {

namespace {

int mode_number(BitReader& bits)
{
    const int two = bits.take(2);
    if (two < 2) return two;
    const int five = two | (bits.take(3) << 2);
    for (int mode = 2; mode < 14; ++mode)
        if (kBc6hModeCodes[mode] == five) return mode;
    return -1;
}

int sign_extended(int value, int bits)
{
    const int top = 1 << (bits - 1);
    return (value ^ top) - top;
}

std::uint16_t to_half_bits(int value, bool is_signed)
{
    const int half = bc6h_half(value, is_signed);
    return static_cast<std::uint16_t>(half < 0 || value < 0 ? 0x8000 | -half : half);
}

}  // namespace

std::array<std::array<std::uint16_t, 3>, 16> decode_bc6h(const std::byte* block, bool is_signed)
{
    std::array<std::array<std::uint16_t, 3>, 16> texels{};
    BitReader bits(block);
    const int number = mode_number(bits);
    if (number < 0) return texels;  // reserved: black
    const Bc6hMode& mode = kBc6hModes[number];
    int endpoint[4][3] = {};
    int partition = 0;
    each_bc6h_bit(mode.fields, [&](int e, int c, int bit) {
        (e < 0 ? partition : endpoint[e][c]) |= bits.take(1) << bit;
    });
    const int endpoints = 2 * mode.regions;
    for (int c = 0; c < 3; ++c) {
        if (is_signed) endpoint[0][c] = sign_extended(endpoint[0][c], mode.bits);
        for (int e = 1; e < endpoints; ++e) {
            int& value = endpoint[e][c];
            if (is_signed || mode.transformed) value = sign_extended(value, mode.delta[c]);
            if (mode.transformed) {
                value = (endpoint[0][c] + value) & ((1 << mode.bits) - 1);
                if (is_signed) value = sign_extended(value, mode.bits);
            }
        }
        for (int e = 0; e < endpoints; ++e) {
            endpoint[e][c] = bc6h_unquantized(endpoint[e][c], mode.bits, is_signed);
        }
    }
    const int index_bits = mode.regions == 2 ? 3 : 4;
    const int* weights = bc7_weights(index_bits);
    for (int t = 0; t < 16; ++t) {
        const int region = bc7_subset(mode.regions, partition, t);
        const bool anchor = t == bc7_anchor(mode.regions, partition, region);
        const int weight = weights[bits.take(index_bits - (anchor ? 1 : 0))];
        for (int c = 0; c < 3; ++c) {
            const int a = endpoint[2 * region][c], b = endpoint[2 * region + 1][c];
            texels[static_cast<std::size_t>(t)][static_cast<std::size_t>(c)] =
                to_half_bits((a * (64 - weight) + b * weight + 32) >> 6, is_signed);
        }
    }
    return texels;
}

}  // namespace petrichor::texproc::detail
