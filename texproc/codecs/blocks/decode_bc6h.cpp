// BC6H: 14 modes of packed half-float endpoints. Source: Khronos Data Format Specification 1.3,
// BPTC.
#include "texproc/codecs/blocks/detail/bc7_tables.h"
#include "texproc/codecs/blocks/detail/bit_reader.h"
#include "texproc/codecs/blocks/detail/decode_block.h"

#include <cstring>

namespace petrichor::texproc::detail {

namespace {

// A field of the header: `name` is channel and endpoint (r0 = red of the first, ...), bits `high`
// to `low` of it, stored from `low` up; high < low means the other way round.
struct Mode {
    int bits;          // of the first endpoint
    int delta[3];      // of the others, for red, green, blue; 0 in direct modes: as the first
    bool transformed;  // the others are differences to the first
    int regions;
    const char* fields;  // "r0:9-0 ..." in storage order; d is the partition
};

// Endpoints: 0 = first of region 0, 1 = second of region 0, 2 and 3 of region 1 (w, x, y, z in the
// format's text).
constexpr Mode kModes[14] = {
    {10,
     {5, 5, 5},
     true,
     2,
     "g2:4 b2:4 b3:4 r0:9-0 g0:9-0 b0:9-0 r1:4-0 g3:4 g2:3-0 g1:4-0 b3:0 g3:3-0 b1:4-0 b3:1 b2:3-0 "
     "r2:4-0 b3:2 r3:4-0 b3:3 d:4-0"},
    {7,
     {6, 6, 6},
     true,
     2,
     "g2:5 g3:4 g3:5 r0:6-0 b3:0 b3:1 b2:4 g0:6-0 b2:5 b3:2 g2:4 b0:6-0 b3:3 b3:5 b3:4 r1:5-0 "
     "g2:3-0 g1:5-0 g3:3-0 b1:5-0 b2:3-0 r2:5-0 r3:5-0 d:4-0"},
    {11,
     {5, 4, 4},
     true,
     2,
     "r0:9-0 g0:9-0 b0:9-0 r1:4-0 r0:10 g2:3-0 g1:3-0 g0:10 b3:0 g3:3-0 b1:3-0 b0:10 b3:1 b2:3-0 "
     "r2:4-0 b3:2 r3:4-0 b3:3 d:4-0"},
    {11,
     {4, 5, 4},
     true,
     2,
     "r0:9-0 g0:9-0 b0:9-0 r1:3-0 r0:10 g3:4 g2:3-0 g1:4-0 g0:10 g3:3-0 b1:3-0 b0:10 b3:1 b2:3-0 "
     "r2:3-0 b3:0 b3:2 r3:3-0 g2:4 b3:3 d:4-0"},
    {11,
     {4, 4, 5},
     true,
     2,
     "r0:9-0 g0:9-0 b0:9-0 r1:3-0 r0:10 b2:4 g2:3-0 g1:3-0 g0:10 b3:0 g3:3-0 b1:4-0 b0:10 b2:3-0 "
     "r2:3-0 b3:1 b3:2 r3:3-0 b3:4 b3:3 d:4-0"},
    {9,
     {5, 5, 5},
     true,
     2,
     "r0:8-0 b2:4 g0:8-0 g2:4 b0:8-0 b3:4 r1:4-0 g3:4 g2:3-0 g1:4-0 b3:0 g3:3-0 b1:4-0 b3:1 b2:3-0 "
     "r2:4-0 b3:2 r3:4-0 b3:3 d:4-0"},
    {8,
     {6, 5, 5},
     true,
     2,
     "r0:7-0 g3:4 b2:4 g0:7-0 b3:2 g2:4 b0:7-0 b3:3 b3:4 r1:5-0 g2:3-0 g1:4-0 b3:0 g3:3-0 b1:4-0 "
     "b3:1 b2:3-0 r2:5-0 r3:5-0 d:4-0"},
    {8,
     {5, 6, 5},
     true,
     2,
     "r0:7-0 b3:0 b2:4 g0:7-0 g2:5 g2:4 b0:7-0 g3:5 b3:4 r1:4-0 g3:4 g2:3-0 g1:5-0 g3:3-0 b1:4-0 "
     "b3:1 b2:3-0 r2:4-0 b3:2 r3:4-0 b3:3 d:4-0"},
    {8,
     {5, 5, 6},
     true,
     2,
     "r0:7-0 b3:1 b2:4 g0:7-0 b2:5 g2:4 b0:7-0 b3:5 b3:4 r1:4-0 g3:4 g2:3-0 g1:4-0 b3:0 g3:3-0 "
     "b1:5-0 b2:3-0 r2:4-0 b3:2 r3:4-0 b3:3 d:4-0"},
    {6,
     {6, 6, 6},
     false,
     2,
     "r0:5-0 g3:4 b3:0 b3:1 b2:4 g0:5-0 g2:5 b2:5 b3:2 g2:4 b0:5-0 g3:5 b3:3 b3:5 b3:4 r1:5-0 "
     "g2:3-0 g1:5-0 g3:3-0 b1:5-0 b2:3-0 r2:5-0 r3:5-0 d:4-0"},
    {10, {10, 10, 10}, false, 1, "r0:9-0 g0:9-0 b0:9-0 r1:9-0 g1:9-0 b1:9-0"},
    {11, {9, 9, 9}, true, 1, "r0:9-0 g0:9-0 b0:9-0 r1:8-0 r0:10 g1:8-0 g0:10 b1:8-0 b0:10"},
    {12,
     {8, 8, 8},
     true,
     1,
     "r0:9-0 g0:9-0 b0:9-0 r1:7-0 r0:10-11 g1:7-0 g0:10-11 b1:7-0 b0:10-11"},
    {16,
     {4, 4, 4},
     true,
     1,
     "r0:9-0 g0:9-0 b0:9-0 r1:3-0 r0:10-15 g1:3-0 g0:10-15 b1:3-0 b0:10-15"}};

// Two bits 0 or 1 name the first two modes; five bits the others.
int mode_number(BitReader& bits)
{
    const int two = bits.take(2);
    if (two < 2) return two;
    const int five = two | (bits.take(3) << 2);
    switch (five) {
        case 0x02:
            return 2;
        case 0x06:
            return 3;
        case 0x0a:
            return 4;
        case 0x0e:
            return 5;
        case 0x12:
            return 6;
        case 0x16:
            return 7;
        case 0x1a:
            return 8;
        case 0x1e:
            return 9;
        case 0x03:
            return 10;
        case 0x07:
            return 11;
        case 0x0b:
            return 12;
        case 0x0f:
            return 13;
        default:
            return -1;
    }
}

int number_at(const char*& p)
{
    int v = 0;
    while (*p >= '0' && *p <= '9') v = 10 * v + (*p++ - '0');
    return v;
}

int read_fields(BitReader& bits, const char* p, int (&endpoint)[4][3])
{
    int partition = 0;
    while (*p) {
        const char name = *p++;
        int& value = name == 'd' ? partition
                                 : endpoint[*p++ - '0'][name == 'r'   ? 0
                                                        : name == 'g' ? 1
                                                                      : 2];
        ++p;  // the colon
        const int first = number_at(p);
        int last = first;
        if (*p == '-') last = number_at(++p);
        if (first >= last) {
            for (int bit = last; bit <= first; ++bit) value |= bits.take(1) << bit;
        } else {  // the high bits of the long modes are stored from the top down
            for (int bit = last; bit >= first; --bit) value |= bits.take(1) << bit;
        }
        if (*p == ' ') ++p;
    }
    return partition;
}

int sign_extended(int value, int bits)
{
    const int top = 1 << (bits - 1);
    return (value ^ top) - top;
}

int unquantized(int value, int bits, bool is_signed)
{
    if (!is_signed) {
        if (bits >= 15 || value == 0) return value;
        if (value == (1 << bits) - 1) return 0xffff;
        return ((value << 15) + 0x4000) >> (bits - 1);
    }
    if (bits >= 16) return value;
    const int size = value < 0 ? -value : value;
    int wide = 0;
    if (size >= (1 << (bits - 1)) - 1) {
        wide = 0x7fff;
    } else if (size) {
        wide = ((size << 15) + 0x4000) >> (bits - 1);
    }
    return value < 0 ? -wide : wide;
}

std::uint16_t to_half_bits(int value, bool is_signed)
{
    if (!is_signed) return static_cast<std::uint16_t>((value * 31) >> 6);
    return static_cast<std::uint16_t>(value < 0 ? 0x8000 | ((-value * 31) >> 5)
                                                : (value * 31) >> 5);
}

}  // namespace

std::array<std::array<std::uint16_t, 3>, 16> decode_bc6h(const std::byte* block, bool is_signed)
{
    std::array<std::array<std::uint16_t, 3>, 16> texels{};
    BitReader bits(block);
    const int number = mode_number(bits);
    if (number < 0) return texels;  // reserved: black
    const Mode& mode = kModes[number];
    int endpoint[4][3] = {};
    const int partition = read_fields(bits, mode.fields, endpoint);
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
            endpoint[e][c] = unquantized(endpoint[e][c], mode.bits, is_signed);
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
