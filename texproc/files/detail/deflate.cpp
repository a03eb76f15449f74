#include "texproc/files/detail/deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "texproc/files/detail/huffman.h"

namespace petrichor::texproc::detail {

namespace {

constexpr std::size_t kSegment = 128 * 1024;  // bytes that share one set of codes
constexpr std::size_t kWindow = 32 * 1024;    // how far back a copy may reach
constexpr std::size_t kLongest = 258;         // bytes of a copy
constexpr std::size_t kWorthwhile =
    6;  // shorter copies cost more than the literals of filtered rows
constexpr int kHashBits = 13;
constexpr std::size_t kEnd = 256;  // the symbol that ends a block
constexpr std::size_t kLiterals = 286, kDistances = 30, kLengths = 19;

// So many bytes as they are, then a copy of earlier ones (length 0: none).
struct Step {
    std::uint32_t literals;
    std::uint16_t length;
    std::uint16_t distance;
};

// The symbol for a length or distance and the bits that follow it (RFC 1951, 3.2.5).
struct Symbol {
    std::uint8_t symbol;
    std::uint8_t extra_bits;
    std::uint16_t base;
};

// Two groups of `group` symbols without extra bits, then a bit more with every group.
template <std::size_t kMost>
std::array<Symbol, kMost + 1> symbols(std::size_t least, std::size_t group)
{
    std::array<Symbol, kMost + 1> all{};
    std::size_t value = least;
    for (std::size_t symbol = 0; value <= kMost; ++symbol) {
        const std::size_t extra = symbol < 2 * group ? 0 : symbol / group - 1;
        const std::size_t base = value;
        for (; value < base + (std::size_t{1} << extra) && value <= kMost; ++value) {
            all[value] = {static_cast<std::uint8_t>(symbol), static_cast<std::uint8_t>(extra),
                          static_cast<std::uint16_t>(base)};
        }
    }
    return all;
}

struct Tables {
    std::array<Symbol, kLongest + 1> length = symbols<kLongest>(3, 4);
    std::array<Symbol, kWindow + 1> distance = symbols<kWindow>(1, 2);
    Tables() { length[kLongest] = {28, 0, kLongest}; }  // the one length with a symbol of its own
};

const Tables& tables()
{
    static const Tables all;
    return all;
}

std::uint32_t load32(const std::uint8_t* p)
{
    std::uint32_t v;
    std::memcpy(&v, p, sizeof v);
    return v;
}

std::uint64_t load64(const std::uint8_t* p)
{
    std::uint64_t v;
    std::memcpy(&v, p, sizeof v);
    return v;
}

std::size_t common_length(const std::uint8_t* a, const std::uint8_t* b, std::size_t most)
{
    std::size_t n = 0;
    if constexpr (std::endian::native == std::endian::little) {
        for (; n + 8 <= most; n += 8) {
            const std::uint64_t differ = load64(a + n) ^ load64(b + n);
            if (differ) return n + static_cast<std::size_t>(std::countr_zero(differ)) / 8;
        }
    }
    while (n < most && a[n] == b[n]) ++n;
    return n;
}

// Looks for earlier places: the last one whose four bytes fell on the same entry.
class Matcher {
public:
    explicit Matcher(std::span<const std::uint8_t> data) : data_(data) {}

    // Steps for bytes [first, end).
    void steps(std::size_t first, std::size_t end, std::vector<Step>& out)
    {
        out.clear();
        std::size_t literal = first, at = first;
        while (at + 4 <= end) {
            const std::size_t before = exchanged(at);
            const std::size_t length = before ? common(at, before - 1, end) : 0;
            if (length < kWorthwhile) {
                at += 1 + (at - literal) / 128;  // where nothing repeats, look less often
                continue;
            }
            out.push_back({static_cast<std::uint32_t>(at - literal),
                           static_cast<std::uint16_t>(length),
                           static_cast<std::uint16_t>(at + 1 - before)});
            at += length;
            literal = at;
            if (at + 3 <= end) exchanged(at - 1);  // flat stretches go on at distance 1
        }
        if (literal < end) out.push_back({static_cast<std::uint32_t>(end - literal), 0, 0});
    }

private:
    // One more than the last place whose bytes fell on the entry of these, 0: none; now it is this.
    std::size_t exchanged(std::size_t at)
    {
        std::uint32_t& entry = last_[load32(&data_[at]) * 2654435761u >> (32 - kHashBits)];
        const std::size_t before = entry;
        entry = static_cast<std::uint32_t>(at + 1);
        return before && at + 1 - before <= kWindow ? before : 0;
    }

    std::size_t common(std::size_t at, std::size_t before, std::size_t end) const
    {
        if (load32(&data_[at]) != load32(&data_[before])) return 0;
        return common_length(&data_[at], &data_[before], std::min(kLongest, end - at));
    }

    std::span<const std::uint8_t> data_;
    std::vector<std::uint32_t> last_ = std::vector<std::uint32_t>(std::size_t{1} << kHashBits);
};

struct Counts {
    std::array<std::uint32_t, kLiterals> literal{};
    std::array<std::uint32_t, kDistances> distance{};
};

Counts count_symbols(const std::uint8_t* data, const std::vector<Step>& steps)
{
    std::array<std::array<std::uint32_t, 256>, 4> parts{};  // one counter would wait for itself
    Counts counts;
    for (const Step& step : steps) {
        std::size_t i = 0;
        for (; i + 4 <= step.literals; i += 4) {
            for (std::size_t p = 0; p < 4; ++p) ++parts[p][data[i + p]];
        }
        for (; i < step.literals; ++i) ++parts[0][data[i]];
        data += step.literals + step.length;
        if (step.length == 0) continue;
        ++counts.literal[257u + tables().length[step.length].symbol];
        ++counts.distance[tables().distance[step.distance].symbol];
    }
    for (const auto& part : parts) {
        for (std::size_t s = 0; s < 256; ++s) counts.literal[s] += part[s];
    }
    counts.literal[kEnd] = 1;
    return counts;
}

class BitWriter {
public:
    // Room for so many bits more; put() does not look.
    void reserve(std::size_t bits) { bytes_.resize(size_ + bits / 8 + 16); }
    void put(std::uint64_t value, int bits)
    {
        held_ |= value << count_;
        count_ += bits;
    }
    // After at most 56 bits.
    void flush()
    {
        if constexpr (std::endian::native == std::endian::little) {
            std::memcpy(&bytes_[size_], &held_, 8);
        } else {
            for (int i = 0; i < 8; ++i) {
                bytes_[size_ + static_cast<std::size_t>(i)] =
                    static_cast<std::byte>((held_ >> (8 * i)) & 255u);
            }
        }
        const int whole = count_ / 8;
        size_ += static_cast<std::size_t>(whole);
        held_ >>= 8 * whole;
        count_ -= 8 * whole;
    }
    void pad()
    {
        count_ = (count_ + 7) / 8 * 8;
        flush();
    }
    std::vector<std::byte> take()
    {
        bytes_.resize(size_);
        return std::move(bytes_);
    }

private:
    std::vector<std::byte> bytes_;
    std::size_t size_ = 0;
    std::uint64_t held_ = 0;
    int count_ = 0;
};

// Lengths of code words, repeats shortened (RFC 1951, 3.2.7): symbol, value of its extra bits.
struct Repeat {
    std::uint8_t symbol, extra;
};

std::vector<Repeat> shortened(const std::vector<std::uint8_t>& lengths)
{
    std::vector<Repeat> out;
    for (std::size_t i = 0; i < lengths.size();) {
        const std::uint8_t value = lengths[i];
        std::size_t run = 1;
        while (i + run < lengths.size() && lengths[i + run] == value) ++run;
        i += run;
        if (value) {
            out.push_back({value, 0});
            --run;
        }
        const std::size_t most = value ? 6 : 138;
        while (run >= 3) {
            const std::size_t now = std::min(run, most);
            const std::size_t symbol = value ? 16u : now < 11 ? 17u : 18u;
            out.push_back({static_cast<std::uint8_t>(symbol),
                           static_cast<std::uint8_t>(now - (symbol == 18 ? 11 : 3))});
            run -= now;
        }
        out.insert(out.end(), run, {value, 0});
    }
    return out;
}

int extra_bits(std::uint8_t symbol)
{
    return symbol == 16 ? 2 : symbol == 17 ? 3 : symbol == 18 ? 7 : 0;
}

void put_codes(const PrefixCode& literal, const PrefixCode& distance, BitWriter& out)
{
    static constexpr std::uint8_t kOrder[kLengths] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                      11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::vector<std::uint8_t> lengths = literal.length;
    lengths.insert(lengths.end(), distance.length.begin(), distance.length.end());
    const std::vector<Repeat> repeats = shortened(lengths);
    std::array<std::uint32_t, kLengths> counts{};
    for (const Repeat& r : repeats) ++counts[r.symbol];
    const PrefixCode code = prefix_code(counts, 7);
    out.reserve(17 + 3 * kLengths + 14 * repeats.size());
    out.put(kLiterals - 257, 5);
    out.put(kDistances - 1, 5);
    out.put(kLengths - 4, 4);
    out.flush();
    for (const std::uint8_t s : kOrder) {
        out.put(code.length[s], 3);
        out.flush();
    }
    for (const Repeat& r : repeats) {
        out.put(code.bits[r.symbol], code.length[r.symbol]);
        out.put(r.extra, extra_bits(r.symbol));
        out.flush();
    }
}

void put_steps(const std::uint8_t* data, const std::vector<Step>& steps, const PrefixCode& literal,
               const PrefixCode& distance, BitWriter& out)
{
    std::array<std::uint32_t, 256>
        words;  // a literal in one load: its bits and, above, their number
    for (std::size_t s = 0; s < 256; ++s) {
        words[s] = literal.bits[s] | static_cast<std::uint32_t>(literal.length[s]) << 16;
    }
    const auto put_literal = [&](std::uint8_t byte) {
        out.put(words[byte] & 0xffffu, static_cast<int>(words[byte] >> 16));
    };
    for (const Step& step : steps) {
        std::size_t i = 0;
        for (; i + 3 <= step.literals; i += 3) {
            for (std::size_t p = 0; p < 3; ++p) put_literal(data[i + p]);
            out.flush();
        }
        for (; i < step.literals; ++i) put_literal(data[i]);
        out.flush();
        data += step.literals + step.length;
        if (step.length == 0) continue;
        const Symbol l = tables().length[step.length], d = tables().distance[step.distance];
        out.put(literal.bits[257u + l.symbol], literal.length[257u + l.symbol]);
        out.put(step.length - l.base, l.extra_bits);
        out.put(distance.bits[d.symbol], distance.length[d.symbol]);
        out.put(static_cast<std::uint64_t>(step.distance - d.base), d.extra_bits);
        out.flush();
    }
}

std::size_t bits_needed(const Counts& counts, const PrefixCode& literal, const PrefixCode& distance)
{
    constexpr std::size_t kMostExtra = 5 + 13;
    std::size_t bits = 0;
    for (std::size_t s = 0; s < kLiterals; ++s) bits += counts.literal[s] * literal.length[s];
    for (std::size_t s = 0; s < kDistances; ++s) {
        bits += counts.distance[s] * (distance.length[s] + kMostExtra);
    }
    return bits;
}

}  // namespace

std::vector<std::byte> deflated(std::span<const std::uint8_t> data, bool last)
{
    constexpr std::uint64_t kDynamic = 2;
    Matcher matcher(data);
    BitWriter out;
    std::vector<Step> steps;
    std::size_t first = 0;
    do {
        const std::size_t end = std::min(data.size(), first + kSegment);
        matcher.steps(first, end, steps);
        const std::uint8_t* from = data.data() + first;
        const Counts counts = count_symbols(from, steps);
        const PrefixCode literal = prefix_code(counts.literal, 15);
        const PrefixCode distance = prefix_code(counts.distance, 15);
        out.reserve(3);
        out.put(last && end == data.size() ? 1 : 0, 1);
        out.put(kDynamic, 2);
        put_codes(literal, distance, out);
        out.reserve(bits_needed(counts, literal, distance) + 64);
        put_steps(from, steps, literal, distance, out);
        out.put(literal.bits[kEnd], literal.length[kEnd]);
        out.flush();
        first = end;
    } while (first < data.size());
    out.reserve(64);
    if (last) {
        out.pad();
    } else {  // an empty stored block: its header ends on a byte
        out.put(0, 3);
        out.pad();
        out.put(0xffff0000u, 32);
        out.flush();
    }
    return out.take();
}

}  // namespace petrichor::texproc::detail
