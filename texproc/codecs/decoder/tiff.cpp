#include "texproc/codecs/decoder/tiff.h"

#include <zlib.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace petrichor::texproc::decoder {

namespace {

// TIFF 6.0: numbers in the order of bytes that the file starts with; 0 past its end.
class Tiff {
public:
    explicit Tiff(std::span<const std::byte> file)
        : file_(file), big_(!file.empty() && file[0] == std::byte{'M'})
    {
    }
    std::uint32_t number(std::size_t at, std::size_t bytes) const
    {
        std::uint32_t value = 0;
        if (at > file_.size() || bytes > file_.size() - at) return 0;
        for (std::size_t i = 0; i < bytes; ++i) {
            const std::size_t shift = 8 * (big_ ? bytes - 1 - i : i);
            value |= std::to_integer<std::uint32_t>(file_[at + i]) << shift;
        }
        return value;
    }
    // The numbers of a tag of the first directory; empty: it is not there.
    std::vector<std::uint32_t> tag(std::uint32_t wanted) const
    {
        const std::size_t directory = number(4, 4), entries = number(directory, 2);
        for (std::size_t i = 0; i < entries; ++i) {
            const std::size_t entry = directory + 2 + 12 * i;
            if (number(entry, 2) != wanted) continue;
            const std::size_t size = number(entry + 2, 2) == 3 ? 2 : 4;  // SHORT or LONG
            const std::size_t count = number(entry + 4, 4);
            if (count > file_.size() / size) return {};
            const std::size_t from = count * size <= 4 ? entry + 8 : number(entry + 8, 4);
            std::vector<std::uint32_t> numbers(count);
            for (std::size_t k = 0; k < count; ++k) numbers[k] = number(from + size * k, size);
            return numbers;
        }
        return {};
    }

private:
    std::span<const std::byte> file_;
    bool big_;
};

// False when the data contradicts itself or its checksum. A checksum that is missing is let
// through, as readers do.
bool inflates(std::span<const std::byte> data)
{
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(data.data()));
    stream.avail_in = static_cast<uInt>(data.size());
    std::array<Bytef, 65536> out;
    int state = Z_OK;
    while (state == Z_OK) {
        stream.next_out = out.data();
        stream.avail_out = static_cast<uInt>(out.size());
        state = inflate(&stream, Z_NO_FLUSH);
    }
    inflateEnd(&stream);
    return state == Z_STREAM_END || state == Z_BUF_ERROR;
}

}  // namespace

void check_tiff(std::span<const std::byte> file)
{
    constexpr std::uint32_t kCompression = 259, kStripAt = 273, kStripBytes = 279, kTileAt = 324,
                            kTileBytes = 325, kDeflate = 8, kOldDeflate = 32946;
    const Tiff tiff(file);
    if (tiff.number(2, 2) != 42) return;
    const std::vector<std::uint32_t> compression = tiff.tag(kCompression);
    if (compression.empty() || (compression[0] != kDeflate && compression[0] != kOldDeflate))
        return;
    const bool tiled = !tiff.tag(kTileAt).empty();
    const std::vector<std::uint32_t> at = tiff.tag(tiled ? kTileAt : kStripAt);
    const std::vector<std::uint32_t> bytes = tiff.tag(tiled ? kTileBytes : kStripBytes);
    for (std::size_t i = 0; i < at.size() && i < bytes.size(); ++i) {
        if (at[i] > file.size() || bytes[i] > file.size() - at[i] || bytes[i] == 0) continue;
        if (inflates(file.subspan(at[i], bytes[i]))) continue;
        throw std::runtime_error(std::string("its pixels are damaged: ") +
                                 (tiled ? "tile " : "strip ") + std::to_string(i) + " of " +
                                 std::to_string(at.size()) + " does not inflate");
    }
}

}  // namespace petrichor::texproc::decoder
