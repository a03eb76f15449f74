#include "texproc/files/detail/huffman.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

namespace petrichor::texproc::detail {

namespace {

constexpr int kMostBits = 15;

// Depth of every leaf of Huffman's tree over counts in rising order. Nodes are made in rising order
// too, so that two queues (leaves, nodes) stand for the heap.
std::vector<int> depths(const std::vector<std::uint64_t>& counts)
{
    const std::size_t leaves = counts.size();
    std::vector<std::uint64_t> weight(counts);
    std::vector<std::size_t> parent(2 * leaves - 1, 0);
    std::size_t leaf = 0, node = leaves;
    const auto lightest = [&] {
        const bool from_leaves =
            leaf < leaves && (node >= weight.size() || weight[leaf] <= weight[node]);
        return from_leaves ? leaf++ : node++;
    };
    while (weight.size() < 2 * leaves - 1) {
        const std::size_t a = lightest(), b = lightest();
        parent[a] = parent[b] = weight.size();
        weight.push_back(weight[a] + weight[b]);
    }
    std::vector<int> depth(2 * leaves - 1, 0);
    for (std::size_t i = 2 * leaves - 2; i-- > 0;) depth[i] = depth[parent[i]] + 1;
    depth.resize(leaves);
    return depth;
}

std::uint16_t reversed(std::uint32_t word, int length)
{
    std::uint32_t result = 0;
    for (int i = 0; i < length; ++i) result |= ((word >> i) & 1u) << (length - 1 - i);
    return static_cast<std::uint16_t>(result);
}

// Words in order of length, then of symbol.
void number_words(PrefixCode& code)
{
    std::array<std::uint32_t, kMostBits + 2> used{}, next{};
    for (const std::uint8_t length : code.length) ++used[length];
    used[0] = 0;
    for (std::size_t l = 1; l <= kMostBits; ++l) next[l] = (next[l - 1] + used[l - 1]) << 1;
    for (std::size_t s = 0; s < code.length.size(); ++s) {
        const int length = code.length[s];
        if (length) code.bits[s] = reversed(next[static_cast<std::size_t>(length)]++, length);
    }
}

}  // namespace

PrefixCode prefix_code(std::span<const std::uint32_t> counts, int longest)
{
    assert(counts.size() >= 2 && longest <= kMostBits);
    std::vector<std::size_t> symbols;
    for (std::size_t s = 0; s < counts.size(); ++s) {
        if (counts[s]) symbols.push_back(s);
    }
    for (std::size_t s = 0; symbols.size() < 2; ++s) {
        if (!counts[s]) symbols.push_back(s);
    }
    std::stable_sort(symbols.begin(), symbols.end(),
                     [&](std::size_t a, std::size_t b) { return counts[a] < counts[b]; });
    std::vector<std::uint64_t> sorted;
    for (const std::size_t s : symbols) sorted.push_back(std::max(1u, counts[s]));
    std::vector<int> depth = depths(sorted);
    while (depth.front() > longest) {  // rare: counts nearer to each other make a flatter tree
        for (std::uint64_t& count : sorted) count = (count + 1) / 2;
        depth = depths(sorted);
    }
    PrefixCode code{std::vector<std::uint16_t>(counts.size()),
                    std::vector<std::uint8_t>(counts.size())};
    for (std::size_t i = 0; i < symbols.size(); ++i) {
        code.length[symbols[i]] = static_cast<std::uint8_t>(depth[i]);
    }
    number_words(code);
    return code;
}

}  // namespace petrichor::texproc::detail
