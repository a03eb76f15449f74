#include "texproc/codecs/decoder/psd.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace petrichor::texproc::decoder {

namespace {

using Bytes = std::span<const std::byte>;

// The file, from the front; numbers are big-endian.
class Cursor {
public:
    explicit Cursor(Bytes bytes) : rest_(bytes) {}
    Bytes take(std::uint64_t size)
    {
        if (size > rest_.size()) throw std::runtime_error("it is truncated");
        const Bytes taken = rest_.first(static_cast<std::size_t>(size));
        rest_ = rest_.subspan(static_cast<std::size_t>(size));
        return taken;
    }
    std::uint64_t number(int bytes)
    {
        std::uint64_t value = 0;
        for (const std::byte b : take(static_cast<std::uint64_t>(bytes))) {
            value = value << 8 | static_cast<std::uint64_t>(b);
        }
        return value;
    }
    Bytes rest() const { return rest_; }

private:
    Bytes rest_;
};

// Runs and literals of one row (PackBits) into exactly `to`.
void unpack_row(Bytes from, std::span<std::byte> to)
{
    std::size_t at = 0, done = 0;
    while (done < to.size()) {
        if (at >= from.size()) throw std::runtime_error("it is damaged: a row ends too early");
        const int code = static_cast<std::int8_t>(from[at++]);
        if (code == -128) continue;
        const std::size_t count = static_cast<std::size_t>(code < 0 ? 1 - code : 1 + code);
        const std::size_t needed = code < 0 ? 1 : count;
        if (count > to.size() - done || needed > from.size() - at) {
            throw std::runtime_error("it is damaged: a run leaves its row");
        }
        if (code < 0) {
            std::memset(&to[done], static_cast<int>(from[at]), count);
        } else {
            std::memcpy(&to[done], &from[at], count);
        }
        at += needed;
        done += count;
    }
}

// A negative number of layers says that the first channel after the colours is the transparency of
// the merged picture, whose colours are then stored as they look on white.
bool merged_on_white(Bytes layers, int wide)
{
    Cursor in(layers);
    if (layers.size() < static_cast<std::size_t>(wide) + 2) return false;
    in.take(static_cast<std::uint64_t>(wide));
    return static_cast<std::int16_t>(in.number(2)) < 0;
}

// Takes the white away again: colour = (seen - (1 - alpha)) / alpha.
template <class Code>
void remove_white(std::byte* pixels, std::size_t count, std::size_t channels, std::size_t own)
{
    constexpr std::uint32_t kTop = static_cast<Code>(~Code{0});
    std::vector<Code> texel(channels);
    for (std::size_t p = 0; p < count; ++p, pixels += channels * sizeof(Code)) {
        std::memcpy(texel.data(), pixels, channels * sizeof(Code));
        const std::uint32_t alpha = texel[own];
        if (alpha == 0 || alpha == kTop) continue;
        for (std::size_t c = 0; c < own; ++c) {
            const std::uint32_t white = kTop - alpha;
            const std::uint64_t above = texel[c] > white ? texel[c] - white : 0;
            texel[c] = static_cast<Code>(
                std::min<std::uint64_t>(kTop, (above * kTop + alpha / 2) / alpha));
        }
        std::memcpy(pixels, texel.data(), channels * sizeof(Code));
    }
}

// One row of one channel to its places among the interleaved numbers, in the byte order of here.
void scatter(std::span<const std::byte> row, std::size_t size, std::size_t channel,
             std::size_t channels, std::byte* to)
{
    for (std::size_t x = 0; x * size < row.size(); ++x) {
        for (std::size_t b = 0; b < size; ++b) {
            const std::size_t from = std::endian::native == std::endian::little ? size - 1 - b : b;
            to[(x * channels + channel) * size + b] = row[x * size + from];
        }
    }
}

}  // namespace

bool read_psd(std::span<const std::byte> file, const Accept& accept)
{
    Cursor in(file);
    if (in.number(4) != 0x38425053) throw std::runtime_error("its PSD header is damaged");
    const std::uint64_t version = in.number(2);
    in.take(6);
    const std::uint64_t channels = in.number(2), height = in.number(4), width = in.number(4);
    const std::uint64_t depth = in.number(2), mode = in.number(2);
    constexpr std::uint64_t kGrey = 1, kRgb = 3, kMost = 300'000;
    const std::uint64_t own = mode == kGrey ? 1 : 3;
    if ((version != 1 && version != 2) || (mode != kGrey && mode != kRgb) || channels < own ||
        (depth != 8 && depth != 16 && depth != 32)) {
        return false;
    }
    if (channels > 56 || width < 1 || height < 1 || width > kMost || height > kMost) {
        throw std::runtime_error("its PSD header is damaged: " + std::to_string(width) + " x " +
                                 std::to_string(height) + " x " + std::to_string(channels));
    }
    const int wide = version == 2 ? 8 : 4;
    in.take(in.number(4));  // palette
    in.take(in.number(4));  // resources
    const bool on_white = merged_on_white(in.take(in.number(wide)), wide) && channels > own;
    const std::uint64_t coding = in.number(2);
    if (coding > 1) return false;

    Header header{static_cast<int>(width),
                  static_cast<int>(height),
                  static_cast<int>(channels),
                  depth == 8    ? PixelType::U8
                  : depth == 16 ? PixelType::U16
                                : PixelType::F32,
                  {}};
    static const char* const kRgbNames[] = {"R", "G", "B", "A"};
    for (std::uint64_t c = 0; c < channels; ++c) {
        const bool alpha = c == own;
        header.channel_names.push_back(c < own ? (own == 1 ? "Y" : kRgbNames[c])
                                       : alpha ? "A"
                                               : "channel" + std::to_string(c));
    }
    const std::size_t size = size_of(header.type);
    const std::size_t row_bytes = static_cast<std::size_t>(width) * size;
    // What is stored is looked at before the pixels are asked for: every row has two bytes at
    // least.
    const std::uint64_t rows = height * channels;
    std::vector<std::uint64_t> lengths;
    if (coding == 1) {
        Cursor table(in.take(rows * (version == 2 ? 4 : 2)));
        lengths.reserve(static_cast<std::size_t>(rows));
        for (std::uint64_t r = 0; r < rows; ++r)
            lengths.push_back(table.number(version == 2 ? 4 : 2));
    } else if (rows * row_bytes > in.rest().size()) {
        throw std::runtime_error("it is truncated");
    }
    std::byte* pixels = accept(header);
    std::vector<std::byte> row(row_bytes);
    for (std::uint64_t c = 0; c < channels; ++c) {
        for (std::uint64_t y = 0; y < height; ++y) {
            Bytes from;
            if (coding == 1) {
                unpack_row(in.take(lengths[static_cast<std::size_t>(c * height + y)]), row);
                from = row;
            } else {
                from = in.take(row_bytes);
            }
            scatter(from, size, static_cast<std::size_t>(c), static_cast<std::size_t>(channels),
                    pixels + static_cast<std::size_t>(y * width * channels) * size);
        }
    }
    const std::size_t count = static_cast<std::size_t>(width * height);
    if (on_white && depth == 8) {
        remove_white<std::uint8_t>(pixels, count, static_cast<std::size_t>(channels),
                                   static_cast<std::size_t>(own));
    } else if (on_white && depth == 16) {
        remove_white<std::uint16_t>(pixels, count, static_cast<std::size_t>(channels),
                                    static_cast<std::size_t>(own));
    }
    return true;
}

}  // namespace petrichor::texproc::decoder
