#include "scene/gltf/detail/gltf_uri.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace petrichor::scene {
namespace {

constexpr const char* kFixUri =
    "Put the file beside the scene and name it by a relative path, such as textures/stone.png.";

int hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

constexpr std::array<std::int8_t, 256> base64_values()
{
    std::array<std::int8_t, 256> values{};
    for (auto& value : values) value = -1;
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
        values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
    }
    return values;
}

}  // namespace

bool is_data_uri(std::string_view uri)
{
    if (uri.size() < 5) return false;
    for (std::size_t i = 0; i < 4; ++i) {
        if ((uri[i] | 0x20) != "data"[i]) return false;
    }
    return uri[4] == ':';
}

std::vector<std::byte> decode_data_uri(std::string_view uri, const std::string& where,
                                       const GltfLog& log)
{
    constexpr const char* kFix = "Export the scene again, or keep the data in a file of its own.";
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
        log.fail(where, "a data: URI must carry ;base64, data, got " + in_quotes(uri.substr(0, 40)),
                 kFix);
    }
    std::string_view text = uri.substr(comma + 1);
    for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
    static constexpr auto kValues = base64_values();
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int value = kValues[static_cast<unsigned char>(text[i])];
        if (value < 0) {
            log.fail(where, "character " + std::to_string(i) + " of the base64 data is not base64",
                     kFix);
        }
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> bit_count & 0xffu));
        }
    }
    if (text.size() % 4 == 1) log.fail(where, "the base64 data is cut short", kFix);
    return bytes;
}

std::string decode_relative_uri(std::string_view uri, const std::string& where, const GltfLog& log)
{
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        char c = uri[i];
        if (c == '%') {
            const int high = i + 1 < uri.size() ? hex_digit(uri[i + 1]) : -1;
            const int low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : -1;
            if (high < 0 || low < 0) {
                log.fail(where, "% must be followed by two hexadecimal digits in " + in_quotes(uri),
                         "Write %25 for a percent sign in a file name.");
            }
            c = static_cast<char>(high * 16 + low);
            i += 2;
        }
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            log.fail(where, "holds a control character: " + in_quotes(uri), kFixUri);
        }
        path += c == '\\' ? '/' : c;
    }
    if (path.starts_with('/')) {
        log.fail(where, "must be relative, got the absolute path " + in_quotes(path), kFixUri);
    }
    if (path.substr(0, path.find('/')).find(':') != std::string::npos) {
        log.fail(where, "must be a relative path or data:, got " + in_quotes(path), kFixUri);
    }
    std::string tidy;  // one spelling for one file: no empty or "." steps
    for (std::size_t start = 0; start < path.size();) {
        const std::size_t end = std::min(path.find('/', start), path.size());
        const auto step = std::string_view(path).substr(start, end - start);
        start = end + 1;
        if (step.empty() || step == ".") continue;
        if (step == "..") {
            log.fail(where,
                     "may not leave the folder of the scene with \"..\", got " + in_quotes(path),
                     kFixUri);
        }
        if (!tidy.empty()) tidy += '/';
        tidy += step;
    }
    if (tidy.empty()) log.fail(where, "names no file", kFixUri);
    return tidy;
}

}  // namespace petrichor::scene
