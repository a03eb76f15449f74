#include "cli/texture/build/sha256.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "base/input_file.h"

namespace petrichor::cli {

namespace {

// The first 32 bits of the fractional parts of the square or cube roots of the first primes. Both
// fit a double with room to spare: 53 bits hold the integer part (at most 6 bits) and 32 bits
// behind it.
template <std::size_t Count>
std::array<std::uint32_t, Count> root_fractions(double (*root)(double))
{
    std::array<std::uint32_t, Count> values{};
    std::size_t found = 0;
    for (int n = 2; found < Count; ++n) {
        bool prime = true;
        for (int d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
        if (!prime) continue;
        const double r = root(static_cast<double>(n));
        values[found++] = static_cast<std::uint32_t>((r - std::floor(r)) * 4294967296.0);
    }
    return values;
}

class Sha256 {
public:
    void add(std::string_view bytes)
    {
        length_ += bytes.size();
        while (!bytes.empty()) {
            const std::size_t take = std::min(bytes.size(), block_.size() - filled_);
            std::memcpy(block_.data() + filled_, bytes.data(), take);
            filled_ += take;
            bytes.remove_prefix(take);
            if (filled_ == block_.size()) mix();
        }
    }

    std::string digest()
    {
        const std::uint64_t bits = 8 * length_;
        add(std::string_view("\x80", 1));
        while (filled_ != 56) add(std::string_view("\0", 1));
        for (int shift = 56; shift >= 0; shift -= 8) {
            const char byte = static_cast<char>(bits >> shift);
            add({&byte, 1});
        }
        static constexpr char kDigits[] = "0123456789abcdef";
        std::string text;
        for (const std::uint32_t word : state_) {
            for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[word >> shift & 15u];
        }
        return text;
    }

private:
    void mix()
    {
        static const std::array<std::uint32_t, 64> kRound =
            root_fractions<64>([](double x) { return std::cbrt(x); });
        std::uint32_t w[64];
        for (std::size_t i = 0; i < 16; ++i) {
            w[i] = static_cast<std::uint32_t>(block_[4 * i]) << 24 |
                   static_cast<std::uint32_t>(block_[4 * i + 1]) << 16 |
                   static_cast<std::uint32_t>(block_[4 * i + 2]) << 8 | block_[4 * i + 3];
        }
        for (std::size_t i = 16; i < 64; ++i) {
            const std::uint32_t a = w[i - 15], b = w[i - 2];
            w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + w[i - 7] +
                   (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
        }
        auto [a, b, c, d, e, f, g, h] = state_;
        for (std::size_t i = 0; i < 64; ++i) {
            const std::uint32_t t1 = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                     ((e & f) ^ (~e & g)) + kRound[i] + w[i];
            const std::uint32_t t2 = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) +
                                     ((a & b) ^ (a & c) ^ (b & c));
            h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
        }
        const std::uint32_t added[8] = {a, b, c, d, e, f, g, h};
        for (std::size_t i = 0; i < 8; ++i) state_[i] += added[i];
        filled_ = 0;
    }

    std::array<std::uint32_t, 8> state_ = root_fractions<8>([](double x) { return std::sqrt(x); });
    std::array<std::uint8_t, 64> block_{};
    std::size_t filled_ = 0;
    std::uint64_t length_ = 0;
};

}  // namespace

std::string sha256(std::string_view bytes)
{
    Sha256 hash;
    hash.add(bytes);
    return hash.digest();
}

std::string sha256_of_file(const std::filesystem::path& path)
{
    const InputFile in = open_regular_file(path, "texture build: source");
    Sha256 hash;
    std::vector<std::byte> chunk(1 << 18);
    while (const std::size_t got = in.read(chunk))
        hash.add({reinterpret_cast<const char*>(chunk.data()), got});
    return hash.digest();
}

}  // namespace petrichor::cli
