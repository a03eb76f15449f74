// UASTC LDR 4x4: nineteen ways to spend 128 bits, chosen so that every block is also one of ASTC
// and nearly one of BC7 (Khronos Data Format Specification 1.3, "UASTC"; Geldreich 2020, "UASTC
// texture specification").
#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_UASTC_TABLES_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_UASTC_TABLES_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace petrichor::texproc::detail {

struct UastcMode {
    int code, code_bits;  ///< from the lowest bit of the block on
    int range;            ///< of the ends, a row of kUastcRanges
    int channels;         ///< 2: luminance and alpha, 3, 4
    int weight_bits;
    int planes;  ///< 2: one channel has weights of its own
    int subsets;
    int hint_bits;     ///< what transcoders to BC1, ETC1 and ETC2 read
    int pattern_bits;  ///< 0: one subset
};
constexpr int kUastcFlat = 8;  // the mode of one colour
constexpr std::array<UastcMode, 19> kUastcModes{{
    {1, 4, 6, 3, 4, 1, 1, 15, 0},   {53, 6, 7, 3, 2, 1, 1, 15, 0},  {29, 5, 1, 3, 3, 1, 2, 15, 5},
    {3, 5, 0, 3, 2, 1, 3, 15, 4},   {19, 5, 3, 3, 2, 1, 2, 15, 5},  {11, 5, 7, 3, 3, 1, 1, 15, 0},
    {27, 5, 5, 3, 2, 2, 1, 15, 0},  {7, 5, 3, 3, 2, 1, 2, 15, 5},   {23, 5, 7, 4, 0, 0, 0, 0, 0},
    {15, 5, 1, 4, 2, 1, 2, 23, 5},  {2, 3, 4, 4, 4, 1, 1, 17, 0},   {0, 2, 4, 4, 2, 2, 1, 17, 0},
    {6, 3, 6, 4, 3, 1, 1, 17, 0},   {31, 5, 7, 4, 1, 2, 1, 23, 0},  {13, 5, 7, 4, 2, 1, 1, 23, 0},
    {5, 7, 7, 2, 4, 1, 1, 23, 0},   {21, 6, 7, 2, 2, 1, 2, 23, 5},  {37, 6, 7, 2, 2, 2, 1, 23, 0},
    {9, 4, 2, 3, 5, 1, 1, 15, 0},
}};

/// How ends are stored: so many bits each, and a digit of base 3 or 5 each, of which several share
/// some bits (ASTC's bounded integer sequences).
struct UastcRange {
    int bits;
    int base;  ///< 0: bits only
    constexpr int levels() const { return (1 << bits) * (base ? base : 1); }
};
constexpr std::array<UastcRange, 8> kUastcRanges{
    {{2, 3}, {4, 0}, {5, 0}, {3, 5}, {4, 3}, {5, 5}, {6, 3}, {8, 0}}};

/// Partitions that ASTC and BC7 share: bit t of a word is the subset of texel t.
constexpr std::array<std::uint16_t, 30> kUastcPatterns2{
    0xcccc, 0x8888, 0x1111, 0xecc8, 0x377f, 0xfeec, 0x0137, 0x137f, 0xc800, 0x0013,
    0xfe80, 0x17ff, 0x0017, 0x00ff, 0xfff0, 0x0fff, 0xff71, 0x8eff, 0x08ce, 0x008c,
    0x7310, 0xceff, 0x7331, 0x088c, 0xceef, 0x6666, 0xf00f, 0x5555, 0x0f0f, 0x36c9};
/// Two subsets that BC7 has as three of which two agree: mode 7.
constexpr std::array<std::uint16_t, 19> kUastcPatterns23{
    0x00f0, 0x4444, 0x0133, 0xcc80, 0xf0ff, 0x2222, 0xffc8, 0xccce, 0x3c03, 0x00ee,
    0x7700, 0x3003, 0x00ce, 0xff80, 0x6fff, 0x1333, 0x11ff, 0x136c, 0x00ef};
/// Three subsets, two bits a texel: mode 3.
constexpr std::array<std::uint32_t, 11> kUastcPatterns3{
    0xa5a50000, 0xaa005555, 0xaa000055, 0x0000aa55, 0x25252525, 0x94949494,
    0x58585858, 0x56560202, 0x92929292, 0x55aa0055, 0xa05050a0};

constexpr int uastc_pattern_count(int mode)
{
    return mode == 3   ? static_cast<int>(kUastcPatterns3.size())
           : mode == 7 ? static_cast<int>(kUastcPatterns23.size())
                       : static_cast<int>(kUastcPatterns2.size());
}
constexpr int uastc_subset(int mode, int pattern, int texel)
{
    const std::size_t p = static_cast<std::size_t>(pattern);
    if (kUastcModes[static_cast<std::size_t>(mode)].subsets < 2) return 0;
    if (mode == 3) return static_cast<int>(kUastcPatterns3[p] >> (2 * texel)) & 3;
    return (mode == 7 ? kUastcPatterns23[p] : kUastcPatterns2[p]) >> texel & 1;
}
/// The texel whose weight is stored without its highest bit: the first of its subset.
constexpr int uastc_anchor(int mode, int pattern, int subset)
{
    for (int t = 0; t < 16; ++t) {
        if (uastc_subset(mode, pattern, t) == subset) return t;
    }
    return 0;
}

/// Weights of 64 for a stored index: its bits repeated to six, and a step over the middle.
constexpr int uastc_weight(int index, int bits)
{
    const int six = bits == 1   ? 63 * index
                    : bits == 2 ? 21 * index
                    : bits == 3 ? 9 * index
                    : bits == 4 ? 4 * index + (index >> 2)
                                : 2 * index + (index >> 4);
    return six + (six > 32 ? 1 : 0);
}

/// A channel between two ends, as a decoder of ASTC computes it for data.
constexpr int uastc_mix(int low, int high, int weight)
{
    return ((257 * (low * (64 - weight) + high * weight) + 32) >> 6) >> 8;
}

/// The 8-bit value of a stored end (bits below, digit above): ASTC, "Endpoint unquantization".
constexpr int uastc_end(int code, int range)
{
    const UastcRange& r = kUastcRanges[static_cast<std::size_t>(range)];
    const int bits = code & ((1 << r.bits) - 1), digit = code >> r.bits;
    if (r.base == 0) {
        int value = 0;
        for (int shift = 8 - r.bits; shift > -r.bits; shift -= r.bits)
            value |= shift >= 0 ? bits << shift : bits >> -shift;
        return value;
    }
    const int low = bits & 1;
    const int b = bits >> 1;  // b, c, d, ... of the standard from the lowest bit up
    int scale = 0, spread = 0;
    if (r.base == 3) {
        switch (r.bits) {
            case 2: scale = 93, spread = b << 8 | b << 4 | b << 2 | b << 1; break;
            case 4: scale = 22, spread = b << 6 | b; break;
            default: scale = 5, spread = b << 4 | b >> 4; break;
        }
    } else {
        switch (r.bits) {
            case 3: scale = 26, spread = b << 7 | b << 1 | b >> 1; break;
            default: scale = 6, spread = b << 5 | b >> 3; break;
        }
    }
    const int all = low ? 511 : 0;
    const int value = (digit * scale + spread) ^ all;
    return (all & 0x80) | value >> 2;
}

}  // namespace petrichor::texproc::detail

#endif
