#include "weather/text/utf16.h"

#include <cstddef>
#include <cstdint>

#include "base/error.h"

namespace petrichor::weather {

namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;

void append(std::string& out, std::uint32_t c)
{
    const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
    const auto follow = [&](std::uint32_t bits) { put(0x80u | (bits & 0x3Fu)); };
    if (c < 0x80u) {
        put(c);
    } else if (c < 0x800u) {
        put(0xC0u | (c >> 6));
        follow(c);
    } else if (c < 0x10000u) {
        put(0xE0u | (c >> 12));
        follow(c >> 6);
        follow(c);
    } else {
        put(0xF0u | (c >> 18));
        follow(c >> 12);
        follow(c >> 6);
        follow(c);
    }
}

}  // namespace

bool is_utf16(std::string_view bytes)
{
    const auto mark = bytes.substr(0, 2);
    return mark == "\xFF\xFE" || mark == "\xFE\xFF";
}

std::string utf8_of_utf16(std::string_view bytes)
{
    if (bytes.size() % 2 != 0) {
        throw Error("weather: this UTF-16 text ends in the middle of a character (byte " +
                        std::to_string(bytes.size()) + ")",
                    "Save it again, or get the whole file.");
    }
    const bool big = bytes.front() == '\xFE';
    const auto unit = [&](std::size_t at) {
        const auto first = static_cast<unsigned char>(bytes[at]),
                   second = static_cast<unsigned char>(bytes[at + 1]);
        return static_cast<std::uint32_t>(big ? first << 8 | second : second << 8 | first);
    };
    std::string out;
    out.reserve(bytes.size() / 2 + bytes.size() / 16);
    for (std::size_t at = 2; at < bytes.size(); at += 2) {
        const std::uint32_t c = unit(at);
        if (c < 0xD800u || c > 0xDFFFu) {
            append(out, c);
            continue;
        }
        const std::uint32_t low = c < 0xDC00u && at + 2 < bytes.size() ? unit(at + 2) : 0u;
        if (low < 0xDC00u || low > 0xDFFFu) {
            append(out, kReplacement);
            continue;
        }
        append(out, 0x10000u + ((c - 0xD800u) << 10) + (low - 0xDC00u));
        at += 2;
    }
    return out;
}

}  // namespace petrichor::weather
