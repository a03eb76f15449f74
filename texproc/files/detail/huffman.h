#ifndef PETRICHOR_TEXPROC_FILES_DETAIL_HUFFMAN_H
#define PETRICHOR_TEXPROC_FILES_DETAIL_HUFFMAN_H

#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::texproc::detail {

/// Code words of deflate (RFC 1951, 3.2.2): word s is `bits[s]`, lowest bit first, `length[s]`
/// long; length 0: the symbol does not occur.
struct PrefixCode {
    std::vector<std::uint16_t> bits;
    std::vector<std::uint8_t> length;
};

/// The code for symbols that occur `counts[s]` times, no word longer than `longest` bits. At least
/// two symbols get a word, whatever the counts: some decoders refuse less.
PrefixCode prefix_code(std::span<const std::uint32_t> counts, int longest);

}  // namespace petrichor::texproc::detail

#endif
