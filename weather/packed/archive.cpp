#include "weather/packed/archive.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather::packed {

namespace {

[[noreturn]] void damaged(const char* kind, const std::string& how)
{
    throw Error(std::string("weather: this ") + kind + " archive " + how,
                "Download it again, or unpack it first.");
}

enum class Wrapping { Gzip, Raw };

// Inflates one stream; returns how many bytes of the input it took.
std::size_t inflate_into(std::span<const std::byte> in, Wrapping wrapping, std::size_t most,
                         std::vector<std::byte>& out)
{
    const char* kind = wrapping == Wrapping::Gzip ? "gzip" : "zip";
    z_stream stream{};
    if (inflateInit2(&stream, wrapping == Wrapping::Gzip ? 15 + 16 : -15) != Z_OK)
        damaged(kind, "cannot be unpacked: no memory");
    struct Guard {
        z_stream* s;
        ~Guard() { inflateEnd(s); }
    } guard{&stream};
    std::size_t taken = 0;
    std::byte piece[1 << 16];
    for (;;) {
        if (stream.avail_in == 0 && taken < in.size()) {
            const std::size_t n = std::min<std::size_t>(in.size() - taken, 1u << 30);
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(in.data() + taken));
            stream.avail_in = static_cast<uInt>(n);
            taken += n;
        }
        stream.next_out = reinterpret_cast<Bytef*>(piece);
        stream.avail_out = sizeof piece;
        const int status = inflate(&stream, Z_NO_FLUSH);
        const std::size_t made = sizeof piece - stream.avail_out;
        if (made > most - std::min(most, out.size()))
            damaged(kind, "holds more than " + std::to_string(most) + " bytes");
        out.insert(out.end(), piece, piece + made);
        if (status == Z_STREAM_END) return taken - stream.avail_in;
        if (status != Z_OK || (made == 0 && stream.avail_in == 0 && taken == in.size()))
            damaged(kind, "is damaged or cut short");
    }
}

std::uint32_t little(std::span<const std::byte> bytes, std::size_t at, std::size_t count)
{
    if (at > bytes.size() || count > bytes.size() - at) damaged("zip", "is cut short");
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    return value;
}

// Where the directory at the end begins, and its number of entries.
struct Directory {
    std::size_t at, entries;
};
Directory find_directory(std::span<const std::byte> bytes)
{
    // The record is 22 bytes and a comment of at most 65535.
    for (std::size_t back = 22; back <= std::min<std::size_t>(bytes.size(), 22 + 65535); ++back) {
        const std::size_t at = bytes.size() - back;
        if (little(bytes, at, 4) != 0x06054b50u) continue;
        const std::uint32_t entries = little(bytes, at + 10, 2), start = little(bytes, at + 16, 4);
        if (start == 0xffffffffu || entries == 0xffffu) damaged("zip", "is of the 64-bit kind");
        return {start, entries};
    }
    damaged("zip", "has no directory at its end: it is cut short");
}

}  // namespace

bool is_gzip(std::span<const std::byte> bytes)
{
    return bytes.size() > 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b};
}

bool is_zip(std::span<const std::byte> bytes)
{
    // The second is that of an archive without entries.
    return bytes.size() > 4 && (std::memcmp(bytes.data(), "PK\x03\x04", 4) == 0 ||
                                std::memcmp(bytes.data(), "PK\x05\x06", 4) == 0);
}

std::vector<std::byte> gunzipped(std::span<const std::byte> bytes, std::size_t most)
{
    std::vector<std::byte> out;
    while (is_gzip(bytes)) {
        const std::size_t taken = inflate_into(bytes, Wrapping::Gzip, most, out);
        bytes = bytes.subspan(std::min(taken, bytes.size()));
    }
    return out;
}

std::vector<Entry> unzipped(std::span<const std::byte> bytes, std::size_t most)
{
    const Directory directory = find_directory(bytes);
    if (directory.entries == 0) damaged("zip", "is empty");
    if (directory.entries > 1000) damaged("zip", "has more than 1000 entries");
    std::vector<Entry> out;
    std::size_t at = directory.at, total = 0;
    for (std::size_t i = 0; i < directory.entries; ++i) {
        if (little(bytes, at, 4) != 0x02014b50u) damaged("zip", "has a damaged directory");
        const std::uint32_t flags = little(bytes, at + 8, 2), method = little(bytes, at + 10, 2),
                            checksum = little(bytes, at + 16, 4),
                            packed = little(bytes, at + 20, 4),
                            name_length = little(bytes, at + 28, 2),
                            extra_length = little(bytes, at + 30, 2),
                            comment_length = little(bytes, at + 32, 2),
                            local = little(bytes, at + 42, 4);
        if (packed == 0xffffffffu || local == 0xffffffffu) damaged("zip", "is of the 64-bit kind");
        if (at + 46 + name_length > bytes.size()) damaged("zip", "is cut short");
        std::string name(reinterpret_cast<const char*>(bytes.data() + at + 46), name_length);
        at += 46 + name_length + extra_length + comment_length;
        if (name.empty() || name.back() == '/') continue;
        if (flags & 1u) damaged("zip", "is encrypted");
        if (method != 0 && method != 8)
            damaged("zip",
                    "is packed by a method that is not known (" + std::to_string(method) + ")");
        // The local header repeats name and extra field, with lengths of its own.
        if (little(bytes, local, 4) != 0x04034b50u) damaged("zip", "has a damaged entry");
        const std::size_t data =
            std::size_t{local} + 30 + little(bytes, local + 26, 2) + little(bytes, local + 28, 2);
        if (data > bytes.size() || packed > bytes.size() - data) damaged("zip", "is cut short");
        Entry entry{shown(name), {}};
        const auto body = bytes.subspan(data, packed);
        if (method == 0) {
            if (packed > most - total)
                damaged("zip", "holds more than " + std::to_string(most) + " bytes");
            entry.bytes.assign(body.begin(), body.end());
        } else {
            inflate_into(body, Wrapping::Raw, most - total, entry.bytes);
        }
        const auto sum =
            crc32_z(0, reinterpret_cast<const Bytef*>(entry.bytes.data()), entry.bytes.size());
        if (sum != checksum)
            damaged("zip", "is damaged: the checksum of " + entry.name + " differs");
        total += entry.bytes.size();
        out.push_back(std::move(entry));
    }
    if (out.empty()) damaged("zip", "is empty");
    return out;
}

}  // namespace petrichor::weather::packed
