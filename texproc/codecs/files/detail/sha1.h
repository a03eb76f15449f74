#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_SHA1_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_SHA1_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace petrichor::texproc::detail {

/// SHA-1 (FIPS 180-4) in hexadecimal digits: a name for content, no protection of anything.
inline std::string sha1(std::span<const std::byte> bytes)
{
    std::array<std::uint32_t, 5> h{0x67452301u, 0xefcdab89u, 0x98badcfeu, 0x10325476u, 0xc3d2e1f0u};
    const auto turned = [](std::uint32_t v, int by) { return (v << by) | (v >> (32 - by)); };
    const auto block = [&](const std::byte* from) {
        std::uint32_t w[80];
        for (int t = 0; t < 16; ++t) {
            w[t] = 0;
            for (int i = 0; i < 4; ++i)
                w[t] = (w[t] << 8) | std::to_integer<std::uint32_t>(from[4 * t + i]);
        }
        for (int t = 16; t < 80; ++t) w[t] = turned(w[t - 3] ^ w[t - 8] ^ w[t - 14] ^ w[t - 16], 1);
        auto [a, b, c, d, e] = h;
        for (int t = 0; t < 80; ++t) {
            const std::uint32_t f = t < 20   ? (b & c) | (~b & d)
                                    : t < 40 ? b ^ c ^ d
                                    : t < 60 ? (b & c) | (b & d) | (c & d)
                                             : b ^ c ^ d;
            const std::uint32_t k = t < 20   ? 0x5a827999u
                                    : t < 40 ? 0x6ed9eba1u
                                    : t < 60 ? 0x8f1bbcdcu
                                             : 0xca62c1d6u;
            const std::uint32_t next = turned(a, 5) + f + e + k + w[t];
            e = d, d = c, c = turned(b, 30), b = a, a = next;
        }
        h[0] += a, h[1] += b, h[2] += c, h[3] += d, h[4] += e;
    };
    const std::size_t whole = bytes.size() / 64 * 64;
    for (std::size_t at = 0; at < whole; at += 64) block(bytes.data() + at);
    std::vector<std::byte> rest(bytes.begin() + static_cast<std::ptrdiff_t>(whole), bytes.end());
    rest.push_back(std::byte{0x80});
    while (rest.size() % 64 != 56) rest.push_back(std::byte{0});
    const std::uint64_t bits = 8 * static_cast<std::uint64_t>(bytes.size());
    for (int i = 7; i >= 0; --i) rest.push_back(static_cast<std::byte>(bits >> (8 * i)));
    for (std::size_t at = 0; at < rest.size(); at += 64) block(rest.data() + at);
    std::string digits;
    for (const std::uint32_t word : h)
        for (int i = 28; i >= 0; i -= 4) digits += "0123456789ABCDEF"[(word >> i) & 15u];
    return digits;
}

}  // namespace petrichor::texproc::detail

#endif
