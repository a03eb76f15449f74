#include "texproc/codecs/decoder/sgi.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace petrichor::texproc::decoder {

namespace {

using Bytes = std::span<const std::byte>;

std::uint32_t number(Bytes file, std::size_t at, std::size_t bytes)
{
    if (at > file.size() || bytes > file.size() - at) throw std::runtime_error("it is truncated");
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
        value = value << 8 | static_cast<std::uint32_t>(file[at + i]);
    return value;
}

// One row of one channel, its numbers `size` bytes each, to every `stride`-th place.
struct Row {
    std::byte* to;
    std::size_t width, stride, size;
    void set(std::size_t x, std::uint32_t value) const
    {
        std::byte* at = to + x * stride;
        if (size == 1) {
            *at = static_cast<std::byte>(value);
        } else {
            const auto both = static_cast<std::uint16_t>(value);
            std::memcpy(at, &both, 2);
        }
    }
};

void read_plain(Bytes file, std::size_t at, const Row& row)
{
    for (std::size_t x = 0; x < row.width; ++x)
        row.set(x, number(file, at + x * row.size, row.size));
}

// Counts of 7 bits; bit 7 set: that many numbers follow, else one that is repeated; 0 ends the row.
void read_runs(Bytes file, std::size_t at, std::size_t length, const Row& row)
{
    if (at > file.size() || length > file.size() - at) throw std::runtime_error("it is truncated");
    const Bytes runs = file.subspan(at, length);
    std::size_t from = 0, x = 0;
    while (x < row.width) {
        const std::uint32_t code = number(runs, from, row.size);
        from += row.size;
        const std::size_t count = code & 0x7fu;
        if (count == 0 || count > row.width - x)
            throw std::runtime_error("it is damaged: a run leaves its row");
        const bool literal = (code & 0x80u) != 0;
        for (std::size_t i = 0; i < count; ++i) {
            row.set(x++, number(runs, from, row.size));
            if (literal) from += row.size;
        }
        if (!literal) from += row.size;
    }
}

}  // namespace

void read_sgi(Bytes file, const Accept& accept)
{
    constexpr std::size_t kHead = 512;
    const bool runs = number(file, 2, 1) == 1;
    const std::uint32_t size = number(file, 3, 1);
    const std::uint32_t dimensions = number(file, 4, 2);
    const std::uint32_t width = number(file, 6, 2);
    const std::uint32_t height = dimensions > 1 ? number(file, 8, 2) : 1;
    const std::uint32_t channels = dimensions > 2 ? number(file, 10, 2) : 1;
    if (size < 1 || size > 2 || dimensions < 1 || dimensions > 3 || number(file, 104, 4) != 0)
        throw std::runtime_error("it is an SGI picture of a kind that nobody writes any more");
    if (width == 0 || height == 0 || channels == 0) throw std::runtime_error("it has no pixels");
    const std::size_t rows = std::size_t{height} * channels;
    // Before anything is made room for: every row has at least a byte, or an entry in the table.
    if (file.size() < kHead ||
        (file.size() - kHead) / (runs ? 8 : std::size_t{width} * size) < rows) {
        throw std::runtime_error("it is truncated");
    }
    Header header{static_cast<int>(width),
                  static_cast<int>(height),
                  static_cast<int>(channels),
                  size == 1 ? PixelType::U8 : PixelType::U16,
                  {}};
    static const char* const kNames[4] = {"R", "G", "B", "A"};
    for (std::uint32_t c = 0; c < channels; ++c) {
        header.channel_names.push_back(channels <= 2 ? (c == 0 ? "Y" : "A")
                                       : c < 4       ? kNames[c]
                                                     : "channel" + std::to_string(c));
    }
    std::byte* pixels = accept(header);
    const std::size_t stride = std::size_t{channels} * size;
    for (std::size_t i = 0; i < rows; ++i) {  // channel by channel, each from the bottom row up
        const std::size_t channel = i / height, y = height - 1 - i % height;
        const Row row{pixels + (y * width * channels + channel) * size, width, stride, size};
        if (runs) {
            read_runs(file, number(file, kHead + 4 * i, 4), number(file, kHead + 4 * (rows + i), 4),
                      row);
        } else {
            read_plain(file, kHead + i * width * size, row);
        }
    }
}

}  // namespace petrichor::texproc::decoder
