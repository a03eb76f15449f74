#include "scene/gltf/detail/gltf_container.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace petrichor::scene {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kChunkJson = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kChunkBin = 0x004E4942;   // "BIN\0"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr const char* kFixCopy = "Copy or download the file again, or export the scene again.";

std::uint32_t little_endian(std::span<const std::byte> bytes, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
    }
    return value;
}

std::string bytes_text(std::size_t count)
{
    return std::to_string(count) + " bytes";
}

GltfContainer split_glb(std::span<const std::byte> asset, GltfLog& log)
{
    if (asset.size() < kHeaderBytes) {
        log.fail("GLB header", "needs 12 bytes, the file has " + std::to_string(asset.size()),
                 kFixCopy);
    }
    const std::uint32_t version = little_endian(asset, 4);
    if (version != 2) {
        log.fail("GLB header", "version must be 2, got " + std::to_string(version),
                 "Convert the scene to glTF 2.0.");
    }
    const std::size_t length = little_endian(asset, 8);
    if (length > asset.size()) {
        log.fail("GLB header",
                 "says " + bytes_text(length) + ", the file has " + std::to_string(asset.size()) +
                     ": it is cut short",
                 kFixCopy);
    }
    if (length < asset.size()) {
        log.warnings.add("GLB header", "bytes after the end of the asset were ignored");
    }
    const auto body = asset.first(length);
    if (length < kHeaderBytes + kChunkHeaderBytes) {
        log.fail("GLB header", "says " + bytes_text(length) + ", too few for a JSON chunk",
                 kFixCopy);
    }

    GltfContainer parts;
    bool has_json = false;
    std::size_t at = kHeaderBytes;
    for (std::size_t chunk = 0; at < body.size(); ++chunk) {
        const std::string where = "GLB chunk " + std::to_string(chunk);
        if (body.size() - at < kChunkHeaderBytes) {
            log.fail(where, "its header is cut short", kFixCopy);
        }
        const std::size_t size = little_endian(body, at);
        const std::uint32_t type = little_endian(body, at + 4);
        at += kChunkHeaderBytes;
        if (size > body.size() - at) {
            log.fail(where,
                     "says " + bytes_text(size) + ", only " + std::to_string(body.size() - at) +
                         " are left",
                     kFixCopy);
        }
        if (size % 4 != 0) log.warnings.add(where, "its length is not a multiple of 4");
        const auto content = body.subspan(at, size);
        at += size;
        if (chunk == 0 && type != kChunkJson) {
            log.fail(where, "must be the JSON chunk, got type " + std::to_string(type), kFixCopy);
        }
        if (type == kChunkJson) {
            if (has_json) log.fail(where, "is a second JSON chunk", kFixCopy);
            has_json = true;
            parts.json = {reinterpret_cast<const char*>(content.data()), content.size()};
        } else if (type == kChunkBin) {
            if (chunk != 1) log.fail(where, "a BIN chunk must be the second chunk", kFixCopy);
            parts.bin = content;
            parts.has_bin = true;
        } else {
            log.warnings.add(where, "a chunk of unknown type was ignored");
        }
    }
    return parts;
}

// The parser builds one node a bracket; a file of nothing but brackets should not get that far.
void check_nesting(std::string_view text, const GltfLog& log)
{
    constexpr int kDeepest = 64;
    int depth = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_text) {
            if (c == '\\') ++i;
            if (c == '"') in_text = false;
        } else if (c == '"') {
            in_text = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kDeepest) {
                log.fail("JSON", "nested deeper than 64 at byte " + std::to_string(i),
                         "Remove the nested data (often under extras), or export the scene again.");
            }
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

}  // namespace

GltfContainer split_container(std::span<const std::byte> asset, GltfLog& log)
{
    if (asset.size() >= 4 && little_endian(asset, 0) == kMagic) return split_glb(asset, log);
    GltfContainer parts;
    parts.json = {reinterpret_cast<const char*>(asset.data()), asset.size()};
    const std::size_t start = parts.json.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (start == std::string_view::npos || parts.json[start] != '{') {
        log.fail("", "is neither a GLB (it does not begin with \"glTF\") nor glTF text (no \"{\")",
                 "Give a .glb or .gltf file; other formats must be converted to glTF 2.0 first.");
    }
    return parts;
}

nlohmann::json parse_gltf_json(std::string_view text, const GltfLog& log)
{
    check_nesting(text, log);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& problem) {
        const std::size_t at = std::min(problem.byte > 0 ? problem.byte - 1 : 0, text.size());
        const auto before = text.substr(0, at);
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t line_start = before.rfind('\n');
        const std::size_t column = line_start == std::string_view::npos ? at + 1 : at - line_start;
        log.fail("JSON",
                 "not valid at line " + std::to_string(line) + ", column " + std::to_string(column),
                 "Correct the text there; if a program wrote the file, copy or export it again.");
    } catch (const nlohmann::json::exception&) {
        log.fail("JSON", "holds a number that is too large for a double",
                 "Correct the number, or export the scene again.");
    }
}

}  // namespace petrichor::scene
