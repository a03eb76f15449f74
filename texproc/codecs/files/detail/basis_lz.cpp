#include "texproc/codecs/files/detail/basis_lz.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "texproc/codecs/files/detail/little_endian.h"

namespace petrichor::texproc::detail {

namespace {

using Bytes = std::span<const std::byte>;

[[noreturn]] void damaged(const char* what)
{
    throw std::runtime_error(std::string("its BasisLZ data is damaged: ") + what);
}

// Bits of a stream, the lowest of each byte first.
class Bits {
public:
    explicit Bits(Bytes bytes) : bytes_(bytes) {}

    std::uint32_t bit()
    {
        if (at_ >= bytes_.size() * 8) damaged("it ends too early");
        const std::uint32_t bit = std::to_integer<std::uint32_t>(bytes_[at_ >> 3]) >> (at_ & 7);
        ++at_;
        return bit & 1;
    }
    std::uint32_t take(int count)
    {
        std::uint32_t value = 0;
        for (int i = 0; i < count; ++i) value |= bit() << i;
        return value;
    }
    // A number in chunks, of which each says whether another one follows.
    std::uint32_t chunks(int size)
    {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 32; shift += size) {
            const std::uint32_t chunk = take(size + 1);
            value |= static_cast<std::uint64_t>(chunk & ((1u << size) - 1)) << shift;
            if (chunk >> size == 0) return static_cast<std::uint32_t>(value);
        }
        damaged("a number has too many digits");
    }
    // Words of one length are consecutive numbers, and those of the next length go on after twice
    // the last (RFC 1951, 3.2.2).
    std::uint32_t symbol(const BasisLzCode& code)
    {
        std::int32_t word = 0, first = 0;
        std::size_t before = 0;
        for (std::size_t length = 1; length <= BasisLzCode::kLongest; ++length) {
            word |= static_cast<std::int32_t>(bit());
            const std::int32_t here = word - first, count = code.count[length];
            if (here < count) return code.symbols[before + static_cast<std::size_t>(here)];
            before += static_cast<std::size_t>(count);
            first = (first + count) << 1;
            word <<= 1;
        }
        damaged("a word is not in its Huffman code");
    }

private:
    Bytes bytes_;
    std::size_t at_ = 0;
};

// The lengths of a code's words are coded themselves; symbols from 17 on are runs.
BasisLzCode read_code(Bits& bits)
{
    constexpr std::array<std::uint8_t, 21> kOrder = {17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                     11, 4,  12, 3,  13, 2, 14, 1, 15, 16};
    const std::size_t total = bits.take(14);
    if (total == 0) return {};
    const std::size_t written = bits.take(5);
    if (written < 1 || written > kOrder.size()) damaged("a Huffman code of code lengths");
    std::array<std::uint8_t, kOrder.size()> sizes{};
    for (std::size_t i = 0; i < written; ++i)
        sizes[kOrder[i]] = static_cast<std::uint8_t>(bits.take(3));
    const BasisLzCode code(sizes);
    std::vector<std::uint8_t> lengths;
    while (lengths.size() < total) {
        const std::uint32_t symbol = bits.symbol(code);
        std::size_t run = 1;
        std::uint8_t length = 0;
        if (symbol < 17) {
            length = static_cast<std::uint8_t>(symbol);
        } else if (symbol < 19) {
            run = symbol == 17 ? 3 + bits.take(3) : 11 + bits.take(7);
        } else {
            run = symbol == 19 ? 3 + bits.take(2) : 7 + bits.take(7);
            if (lengths.empty() || lengths.back() == 0) damaged("a run of nothing");
            length = lengths.back();
        }
        if (run > total - lengths.size()) damaged("a run of code lengths is too long");
        lengths.insert(lengths.end(), run, length);
    }
    return BasisLzCode(lengths);
}

std::uint8_t widened(std::uint32_t five_bits)
{
    return static_cast<std::uint8_t>(five_bits << 3 | five_bits >> 2);
}

// The symbols chosen last: those that are chosen again move to the front by halves.
class History {
public:
    explicit History(std::size_t size) : values_(size), next_(size / 2) {}

    void add(std::uint32_t value)
    {
        if (values_.empty()) return;
        values_[next_++] = value;
        if (next_ == values_.size()) next_ = values_.size() / 2;
    }
    std::uint32_t use(std::size_t index)
    {
        if (index >= values_.size()) damaged("an entry of the history that is not there");
        const std::uint32_t value = values_[index];
        if (index != 0) std::swap(values_[index / 2], values_[index]);
        return value;
    }

private:
    std::vector<std::uint32_t> values_;
    std::size_t next_;
};

// Where blocks take their colours from: two bits a block, four blocks at a time.
class Neighbours {
public:
    Neighbours(const BasisLzCode& code, std::size_t blocks_across)
        : code_(code), below_((blocks_across + 1) / 2)
    {
    }

    std::uint32_t next(Bits& bits, std::size_t x, std::size_t y)
    {
        if (x % 2 == 0) {
            if (y % 2 == 0) {
                now_ = four(bits);
                below_[x / 2] = static_cast<std::uint8_t>(now_ >> 4);
            } else {
                now_ = below_[x / 2];
            }
        }
        const std::uint32_t from = now_ & 3;
        now_ >>= 2;
        return from;
    }

private:
    std::uint32_t four(Bits& bits)
    {
        constexpr std::uint32_t kRepeat = 256, kFewest = 3;
        if (repeats_ > 0) {
            --repeats_;
            return last_;
        }
        const std::uint32_t symbol = bits.symbol(code_);
        if (symbol > kRepeat) damaged("a neighbour that is not there");
        if (symbol == kRepeat) {
            repeats_ = static_cast<std::uint64_t>(bits.chunks(4)) + kFewest - 1;
        } else {
            last_ = symbol;
        }
        return last_;
    }

    const BasisLzCode& code_;
    std::vector<std::uint8_t> below_;
    std::uint32_t now_ = 0, last_ = 0;
    std::uint64_t repeats_ = 0;
};

}  // namespace

BasisLzCode::BasisLzCode(std::span<const std::uint8_t> lengths)
{
    for (const std::uint8_t length : lengths) ++count[length];
    count[0] = 0;
    std::int64_t left = 1;
    std::array<std::size_t, kLongest + 2> start{};
    for (std::size_t length = 1; length <= kLongest; ++length) {
        left = 2 * left - count[length];
        if (left < 0) damaged("a Huffman code has too many words");
        start[length + 1] = start[length] + count[length];
    }
    symbols.resize(start[kLongest + 1]);
    for (std::size_t i = 0; i < lengths.size(); ++i)
        if (lengths[i] != 0) symbols[start[lengths[i]]++] = static_cast<std::uint16_t>(i);
}

BasisLz::BasisLz(Bytes global, std::uint64_t images) : global_(global)
{
    constexpr std::uint64_t kHeader = 20, kImage = 20;
    const std::size_t palettes = static_cast<std::size_t>(read_little(global, 0, 2));
    const std::size_t patterns = static_cast<std::size_t>(read_little(global, 2, 2));
    if (palettes == 0 || patterns == 0) damaged("it has no colours or no patterns");
    if (images > global.size() / kImage) damaged("it does not list all images");
    std::uint64_t at = kHeader + kImage * images;
    const auto next = [&](std::size_t field, const char* name) {
        const std::uint64_t size = read_u32(global, field);
        const Bytes bytes = part(global, at, size, name);
        at += size;
        return bytes;
    };
    read_palettes(next(4, "the colours"), palettes);
    read_patterns(next(8, "the patterns"), patterns);
    Bits bits(next(12, "the Huffman codes"));
    neighbours_ = read_code(bits);
    steps_ = read_code(bits);
    choices_ = read_code(bits);
    runs_ = read_code(bits);
    history_ = bits.take(13);
}

void BasisLz::read_palettes(Bytes bytes, std::size_t count)
{
    // ETC1's table of steps: the smaller and the larger of each number.
    constexpr int kSteps[8][2] = {{2, 8},   {5, 17},  {9, 29},   {13, 42},
                                  {18, 60}, {24, 80}, {33, 106}, {47, 183}};
    Bits bits(bytes);
    std::array<BasisLzCode, 3> codes;
    for (auto& code : codes) code = read_code(bits);
    const BasisLzCode table_code = read_code(bits);
    const std::size_t channels = bits.bit() != 0 ? 1 : 3;
    std::uint32_t table = 0;
    std::array<std::uint32_t, 3> color{16, 16, 16};
    palettes_.reserve(std::min<std::size_t>(count, 8 * bytes.size()));
    for (std::size_t i = 0; i < count; ++i) {
        table = (table + bits.symbol(table_code)) & 7;
        for (std::size_t c = 0; c < channels; ++c) {
            const std::size_t range = color[c] < 10 ? 0 : color[c] < 22 ? 1 : 2;
            color[c] = (color[c] + bits.symbol(codes[range])) & 31;
        }
        Palette palette;
        for (std::size_t k = 0; k < 4; ++k) {
            const int* row = kSteps[table];
            const int step = k == 0 ? -row[1] : k == 1 ? -row[0] : k == 2 ? row[0] : row[1];
            for (std::size_t c = 0; c < 3; ++c) {
                const int base = widened(color[channels == 1 ? 0 : c]);
                palette[k][c] = static_cast<std::uint8_t>(std::clamp(base + step, 0, 255));
            }
        }
        palettes_.push_back(palette);
    }
}

void BasisLz::read_patterns(Bytes bytes, std::size_t count)
{
    Bits bits(bytes);
    if (bits.take(2) != 0) damaged("patterns of an unknown kind");
    const bool plain = bits.bit() != 0;
    BasisLzCode code;
    if (!plain) code = read_code(bits);
    Pattern last = 0;
    patterns_.reserve(std::min<std::size_t>(count, 8 * bytes.size()));
    for (std::size_t i = 0; i < count; ++i) {
        Pattern pattern = 0;
        for (int row = 0; row < 4; ++row) {
            const std::uint32_t read = plain || i == 0 ? bits.take(8) : bits.symbol(code);
            if (read > 255) damaged("a row of a pattern");
            pattern |= read << (8 * row);
        }
        last = plain ? pattern : pattern ^ last;
        patterns_.push_back(last);
    }
}

BasisLzImage BasisLz::image(std::uint64_t index) const
{
    const std::size_t at = static_cast<std::size_t>(20 + 20 * index);
    return {(read_u32(global_, at) & 2) != 0, read_u32(global_, at + 4),
            read_u32(global_, at + 8), read_u32(global_, at + 12), read_u32(global_, at + 16)};
}

std::vector<std::array<std::uint8_t, 3>> BasisLz::slice(Bytes bytes, int width, int height) const
{
    enum From : std::uint32_t { Left, Above, AboveLeft, Step };
    constexpr std::uint32_t kFewest = 3, kLongRun = 63;
    const std::size_t w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    const std::size_t across = (w + 3) / 4, down = (h + 3) / 4;
    const std::size_t palettes = palettes_.size(), patterns = patterns_.size();
    Bits bits(bytes);
    Neighbours neighbours(neighbours_, across);
    History history(history_);
    std::vector<std::uint32_t> above(across), row(across);
    std::vector<std::array<std::uint8_t, 3>> texels(w * h);
    std::size_t color = 0;
    std::uint64_t run = 0;
    for (std::size_t y = 0; y < down; ++y) {
        for (std::size_t x = 0; x < across; ++x) {
            const std::uint32_t from = neighbours.next(bits, x, y);
            if ((from == Left || from == AboveLeft) && x == 0) damaged("a block left of the first");
            if ((from == Above || from == AboveLeft) && y == 0) damaged("a block above the first");
            if (from == Above) color = above[x];
            if (from == AboveLeft) color = above[x - 1];
            if (from == Step) {
                color += bits.symbol(steps_);
                if (color >= palettes) color -= palettes;
                if (color >= palettes) damaged("a colour that is not there");
            }
            row[x] = static_cast<std::uint32_t>(color);

            std::size_t choice = patterns;
            if (run > 0) {
                --run;
            } else {
                choice = bits.symbol(choices_);
                if (choice == patterns + history_) {
                    const std::uint32_t symbol = bits.symbol(runs_);
                    run = (symbol == kLongRun ? std::uint64_t{bits.chunks(7)} : symbol) + kFewest - 1;
                    choice = patterns;
                }
            }
            if (choice >= patterns) {
                choice = history.use(choice - patterns);
            } else {
                history.add(static_cast<std::uint32_t>(choice));
            }
            const Palette& palette = palettes_[color];
            const Pattern pattern = patterns_[choice];
            for (std::size_t j = 0; j < std::min<std::size_t>(4, h - 4 * y); ++j)
                for (std::size_t i = 0; i < std::min<std::size_t>(4, w - 4 * x); ++i)
                    texels[(4 * y + j) * w + 4 * x + i] =
                        palette[(pattern >> (8 * j + 2 * i)) & 3];
        }
        above.swap(row);
    }
    return texels;
}

}  // namespace petrichor::texproc::detail
