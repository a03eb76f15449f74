#ifndef PETRICHOR_BASE_HASH_H
#define PETRICHOR_BASE_HASH_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace petrichor {

/// A 128-bit fingerprint of content, to tell whether two things are the same; not for secrets. The
/// same on every little-endian machine. About 10 GB/s.
class Hasher {
public:
    void add_bytes(std::span<const std::byte> bytes)
    {
        add_word(bytes.size());
        std::size_t i = 0;
        if (bytes.size() >= kManyBytes) {
            // Four words at a time, each into a lane of its own: they do not wait for each other.
            std::uint64_t lanes[4] = {a_, b_, ~a_, ~b_};
            for (; i + 32 <= bytes.size(); i += 32) {
                std::uint64_t words[4];
                std::memcpy(words, bytes.data() + i, 32);
                for (int k = 0; k < 4; ++k) {
                    lanes[k] = (lanes[k] ^ words[k]) * 0x9fb21c651e98df25ull;
                    lanes[k] ^= lanes[k] >> 28;
                }
            }
            for (const std::uint64_t lane : lanes) add_word(lane);
        }
        for (; i + 8 <= bytes.size(); i += 8) {
            std::uint64_t word;
            std::memcpy(&word, bytes.data() + i, 8);
            add_word(word);
        }
        std::uint64_t tail = 0;
        if (i < bytes.size()) std::memcpy(&tail, bytes.data() + i, bytes.size() - i);
        add_word(tail);
    }
    void add(std::string_view text) { add_bytes(std::as_bytes(std::span(text))); }
    void add(const std::string& text) { add(std::string_view(text)); }
    void add(const char* text) { add(std::string_view(text)); }

    /// Numbers and flags, by their bits (so -0 and 0 differ, and a float differs from a double).
    template <class Number>
    requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) void add(Number value)
    {
        std::uint64_t word = 0;
        std::memcpy(&word, &value, sizeof value);
        add_word(word);
    }

    /// A vector of numbers whose memory holds nothing else.
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void add_numbers(std::span<const Number> values) { add_bytes(std::as_bytes(values)); }

    /// 32 hexadecimal digits.
    std::string text() const
    {
        constexpr char kDigits[] = "0123456789abcdef";
        std::string digits;
        for (const std::uint64_t lane : {mixed(a_ ^ (b_ << 1)), mixed(b_ ^ (a_ >> 1))}) {
            for (int shift = 60; shift >= 0; shift -= 4) digits += kDigits[(lane >> shift) & 15u];
        }
        return digits;
    }

private:
    friend class PiecewiseHasher;
    static std::uint64_t mixed(std::uint64_t x)
    {
        x ^= x >> 31;
        x *= 0x9e3779b97f4a7c15ull;
        x ^= x >> 29;
        x *= 0xd6e8feb86659fd93ull;
        return x ^ (x >> 32);
    }
    static constexpr std::size_t kManyBytes = 1024;

    // Both lanes are bijections of their state for a given word, so a single difference never
    // vanishes.
    void add_word(std::uint64_t word)
    {
        a_ = (a_ ^ word) * 0x9fb21c651e98df25ull;
        a_ ^= a_ >> 28;
        b_ = (b_ + word) * 0xff51afd7ed558ccdull;
        b_ ^= b_ >> 33;
    }

    std::uint64_t a_ = 0x243f6a8885a308d3ull;
    std::uint64_t b_ = 0x13198a2e03707344ull;
};

/// The same fingerprint as of a Hasher that was given all bytes at once, from pieces of them.
class PiecewiseHasher {
public:
    /// total: bytes of all pieces
    explicit PiecewiseHasher(std::size_t total) : many_(total >= Hasher::kManyBytes), left_(total)
    {
        hasher_.add_word(total);
        lanes_[0] = hasher_.a_;
        lanes_[1] = hasher_.b_;
        lanes_[2] = ~hasher_.a_;
        lanes_[3] = ~hasher_.b_;
    }
    void add(std::span<const std::byte> bytes)
    {
        while (!bytes.empty()) {
            const std::size_t taken = bytes.size() < 32 - held_ ? bytes.size() : 32 - held_;
            std::memcpy(block_ + held_, bytes.data(), taken);
            bytes = bytes.subspan(taken);
            held_ += taken;
            left_ -= taken;
            if (held_ == 32) flush();
        }
        if (left_ == 0) end();
    }
    /// Once all are there.
    std::string text() const { return hasher_.text(); }

private:
    void flush()
    {
        std::uint64_t words[4];
        std::memcpy(words, block_, 32);
        for (int k = 0; k < 4; ++k) {
            if (many_) {
                lanes_[k] = (lanes_[k] ^ words[k]) * 0x9fb21c651e98df25ull;
                lanes_[k] ^= lanes_[k] >> 28;
            } else {
                hasher_.add_word(words[k]);
            }
        }
        held_ = 0;
    }
    void end()
    {
        if (many_)
            for (const std::uint64_t lane : lanes_) hasher_.add_word(lane);
        std::size_t i = 0;
        std::uint64_t word = 0;
        for (; i + 8 <= held_; i += 8) {
            std::memcpy(&word, block_ + i, 8);
            hasher_.add_word(word);
        }
        word = 0;
        std::memcpy(&word, block_ + i, held_ - i);
        hasher_.add_word(word);
        held_ = 0;
    }

    Hasher hasher_;
    std::uint64_t lanes_[4];
    std::byte block_[32];
    std::size_t held_ = 0;
    bool many_;
    std::size_t left_;
};

}  // namespace petrichor

#endif
