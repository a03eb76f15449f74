#include "texproc/codecs/blocks/detail/bc7_tables.h"
#include "texproc/codecs/blocks/detail/bit_reader.h"
#include "texproc/codecs/blocks/detail/decode_block.h"

#include <utility>

namespace petrichor::texproc::detail {

void decode_bc7(const std::byte* block, Rgba8Block& to)
{
    BitReader bits(block);
    int number = 0;
    while (number < 8 && bits.take(1) == 0) ++number;
    if (number == 8) {  // reserved: the format asks for zeros
        to = Rgba8Block{};
        return;
    }
    const Bc7Mode& mode = kBc7Modes[number];
    const int partition = bits.take(mode.partition_bits);
    const int rotation = bits.take(mode.rotation_bits);
    const bool swapped = bits.take(mode.selector_bits) != 0;

    int endpoint[6][4] = {};
    const int endpoints = 2 * mode.subsets;
    for (int c = 0; c < 4; ++c) {
        const int depth = c < 3 ? mode.color_bits : mode.alpha_bits;
        for (int e = 0; e < endpoints; ++e) endpoint[e][c] = bits.take(depth);
    }
    int low[6] = {};
    const bool has_low = mode.endpoint_p_bits || mode.shared_p_bits;
    for (int e = 0; e < endpoints; ++e) {
        low[e] = mode.endpoint_p_bits ? bits.take(1)
                 : mode.shared_p_bits ? (e & 1 ? low[e - 1] : bits.take(1))
                                      : 0;
    }
    for (int e = 0; e < endpoints; ++e) {
        for (int c = 0; c < 4; ++c) {
            const int depth = c < 3 ? mode.color_bits : mode.alpha_bits;
            if (depth == 0) {
                endpoint[e][c] = 255;
            } else if (has_low) {
                endpoint[e][c] = bc7_widen(2 * endpoint[e][c] + low[e], depth + 1);
            } else {
                endpoint[e][c] = bc7_widen(endpoint[e][c], depth);
            }
        }
    }

    int subset[16];
    int index[16], index2[16];
    for (int t = 0; t < 16; ++t) {
        subset[t] = bc7_subset(mode.subsets, partition, t);
        const bool anchor = t == bc7_anchor(mode.subsets, partition, subset[t]);
        index[t] = bits.take(mode.index_bits - (anchor ? 1 : 0));
    }
    for (int t = 0; t < 16; ++t) {
        index2[t] = mode.index2_bits ? bits.take(mode.index2_bits - (t == 0 ? 1 : 0)) : index[t];
    }
    const int* weights = bc7_weights(mode.index_bits);
    const int* weights2 = mode.index2_bits ? bc7_weights(mode.index2_bits) : weights;
    for (int t = 0; t < 16; ++t) {
        int color = weights[index[t]];
        int alpha = weights2[index2[t]];
        if (swapped) std::swap(color, alpha);
        const int* a = endpoint[2 * subset[t]];
        const int* b = endpoint[2 * subset[t] + 1];
        std::array<std::uint8_t, 4>& texel = to[static_cast<std::size_t>(t)];
        for (std::size_t c = 0; c < 4; ++c) {
            texel[c] = static_cast<std::uint8_t>(bc7_mix(a[c], b[c], c < 3 ? color : alpha));
        }
        if (rotation) std::swap(texel[3], texel[static_cast<std::size_t>(rotation - 1)]);
    }
}

}  // namespace petrichor::texproc::detail
