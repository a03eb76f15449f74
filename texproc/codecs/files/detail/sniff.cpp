#include "texproc/codecs/files/detail/sniff.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace petrichor::texproc::detail {

namespace {

struct Signature {
    std::string_view bytes;
    std::string_view format;
};

using namespace std::string_view_literals;
constexpr Signature kSignatures[] = {
    {"\x89PNG\r\n\x1a\n"sv, "png"},
    {"\xff\xd8\xff"sv, "jpeg"},
    {"BM"sv, "bmp"},
    {"II*\0"sv, "tiff"},
    {"MM\0*"sv, "tiff"},
    {"II+\0"sv, "tiff"},
    {"MM\0+"sv, "tiff"},
    {"\x76\x2f\x31\x01"sv, "openexr"},
    {"#?"sv, "hdr"},
    {"8BPS"sv, "psd"},
    {"DDS "sv, "dds"},
    {"\xabKTX 20\xbb\r\n\x1a\n"sv, "ktx2"},
    {"GIF8"sv, "gif"},
    {"\x01\xda"sv, "sgi"},
    {"P1"sv, "pnm"},
    {"P2"sv, "pnm"},
    {"P3"sv, "pnm"},
    {"P4"sv, "pnm"},
    {"P5"sv, "pnm"},
    {"P6"sv, "pnm"},
    {"Pf"sv, "pnm"},
    {"PF"sv, "pnm"},
};

// Image type, colour map type and depth that the format defines, and a size that is not zero.
bool plausible_targa(std::string_view h)
{
    if (h.size() < 18) return false;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(h[i]); };
    const unsigned kind = byte(2) & ~8u;
    const unsigned depth = byte(16);
    return byte(1) <= 1 && (kind >= 1 && kind <= 3) &&
           (depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32) &&
           (byte(12) | byte(13)) != 0 && (byte(14) | byte(15)) != 0;
}

}  // namespace

std::string sniff(std::span<const std::byte> head, const std::string& name)
{
    const std::string_view h(reinterpret_cast<const char*>(head.data()), head.size());
    for (const Signature& s : kSignatures) {
        if (h.substr(0, s.bytes.size()) == s.bytes) return std::string(s.format);
    }
    if (h.substr(0, 4) == "RIFF" && h.size() >= 12 && h.substr(8, 4) == "WEBP") return "webp";
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (plausible_targa(h)) return "targa";
    return lower.size() > 4 && lower.substr(lower.size() - 4) == ".tga" ? "targa" : "";
}

}  // namespace petrichor::texproc::detail
