#ifndef PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_BIT_READER_H
#define PETRICHOR_TEXPROC_CODECS_BLOCKS_DETAIL_BIT_READER_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace petrichor::texproc::detail {

/// Reads fields of a 16-byte block from its lowest bit up.
class BitReader {
public:
    explicit BitReader(const std::byte* block)
    {
        if constexpr (std::endian::native == std::endian::little) {
            std::memcpy(&low_, block, 8);
            std::memcpy(&high_, block + 8, 8);
        } else {
            for (int i = 0; i < 8; ++i) {
                low_ |= static_cast<std::uint64_t>(block[i]) << (8 * i);
                high_ |= static_cast<std::uint64_t>(block[8 + i]) << (8 * i);
            }
        }
    }
    int take(int bits) { return bits == 0 ? 0 : take_some(bits); }
    /// The same for at least one bit.
    int take_some(int bits)
    {
        const int value = static_cast<int>(low_ & ((1ull << bits) - 1));
        low_ = (low_ >> bits) | (high_ << (64 - bits));
        high_ >>= bits;
        return value;
    }
    /// The next 64 bits; behind the block zeros.
    std::uint64_t rest() const { return low_; }

private:
    std::uint64_t low_ = 0, high_ = 0;
};

/// Writes fields of a 16-byte block from its lowest bit up.
class BitWriter {
public:
    void put(int value, int bits)
    {
        for (int i = 0; i < bits; ++i, ++at_) {
            const std::uint64_t bit = static_cast<std::uint64_t>((value >> i) & 1);
            (at_ < 64 ? low_ : high_) |= bit << (at_ & 63);
        }
    }
    void store(std::byte* block) const
    {
        for (int i = 0; i < 8; ++i) {
            block[i] = static_cast<std::byte>(low_ >> (8 * i));
            block[8 + i] = static_cast<std::byte>(high_ >> (8 * i));
        }
    }

private:
    std::uint64_t low_ = 0, high_ = 0;
    int at_ = 0;
};

}  // namespace petrichor::texproc::detail

#endif
