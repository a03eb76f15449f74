// The 14 modes of BC6H, read and written. Source: Khronos Data Format Specification 1.3, BPTC.
#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_BC6H_MODES_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_BC6H_MODES_H

namespace petrichor::texproc::detail {

/// Fields of a header: "r0:9-4" is red of the first endpoint, its bits 9 to 4, stored from 4 up; the
/// smaller number first means the other way round.
struct Bc6hMode {
    int bits;          // of the first endpoint
    int delta[3];      // of the others, for red, green, blue; 0 in direct modes: as the first
    bool transformed;  // the others are differences to the first
    int regions;
    const char* fields;  // "r0:9-0 ..." in storage order; d is the partition
};

// Endpoints: 0 = first of region 0, 1 = second of region 0, 2 and 3 of region 1 (w, x, y, z in the
// format's text).
inline constexpr Bc6hMode kBc6hModes[14] = {
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

/// The first bits of a block: two of them in the first two modes, else five.
inline constexpr int kBc6hModeCodes[14] = {0x00, 0x01, 0x02, 0x06, 0x0a, 0x0e, 0x12,
                                           0x16, 0x1a, 0x1e, 0x03, 0x07, 0x0b, 0x0f};

/// Calls `bit(endpoint, channel, number of the bit)` for every bit of a header in storage order;
/// endpoint -1 is the partition.
template <class Bit>
void each_bc6h_bit(const char* p, const Bit& bit)
{
    const auto number = [&] {
        int v = 0;
        while (*p >= '0' && *p <= '9') v = 10 * v + (*p++ - '0');
        return v;
    };
    while (*p) {
        const char name = *p++;
        const int endpoint = name == 'd' ? -1 : *p++ - '0';
        const int channel = name == 'g' ? 1 : name == 'b' ? 2 : 0;
        ++p;  // the colon
        const int first = number();
        int last = first;
        if (*p == '-') {
            ++p;
            last = number();
        }
        if (first >= last) {
            for (int k = last; k <= first; ++k) bit(endpoint, channel, k);
        } else {  // the high bits of the long modes are stored from the top down
            for (int k = last; k >= first; --k) bit(endpoint, channel, k);
        }
        if (*p == ' ') ++p;
    }
}

/// A stored number of an endpoint, in 16 bits (and a sign).
constexpr int bc6h_unquantized(int value, int bits, bool is_signed)
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

/// The half float, as an integer with a sign, of an interpolated number.
constexpr int bc6h_half(int value, bool is_signed)
{
    if (!is_signed) return (value * 31) >> 6;
    return value < 0 ? -((-value * 31) >> 5) : (value * 31) >> 5;
}

}  // namespace petrichor::texproc::detail

#endif
