#include "texproc/gltf/gltf_file.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "base/error.h"
#include "base/input_file.h"

namespace petrichor::texproc {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBin = 0x004e4942;
constexpr std::uint64_t kMostBytes = 4ull << 30;
constexpr const char* kFix = "Copy the file again, or export the scene again.";

std::uint32_t word_at(std::string_view bytes, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return value;
}

void put_word(std::vector<std::byte>& to, std::size_t value)
{
    for (int i = 0; i < 4; ++i) to.push_back(static_cast<std::byte>(value >> (8 * i)));
}

[[noreturn]] void fail(const fs::path& path, const std::string& what)
{
    throw Error("glTF " + path.string() + ": " + what, kFix);
}

std::vector<std::byte> bytes_of(std::string_view text)
{
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return {from, from + text.size()};
}

void read_chunks(const std::string& text, GltfFile& file)
{
    if (text.size() < 20) fail(file.path, "is cut short");
    if (word_at(text, 4) != 2) fail(file.path, "is not of version 2");
    const std::size_t length = word_at(text, 8);
    if (length > text.size()) {
        fail(file.path, "is cut short: it says " + std::to_string(length) + " bytes and has " +
                            std::to_string(text.size()));
    }
    const std::string_view body = std::string_view(text).substr(0, length);
    bool has_json = false, has_bin = false;
    for (std::size_t at = 12; at + 8 <= body.size();) {
        const std::size_t size = word_at(body, at);
        const std::uint32_t type = word_at(body, at + 4);
        at += 8;
        if (size > body.size() - at) fail(file.path, "has a chunk that is cut short");
        const std::string_view content = body.substr(at, size);
        at += (size + 3) / 4 * 4;
        if (type == kJson && !has_json) {
            file.json = JsonText::parse(std::string(content));
            has_json = true;
        } else if (type == kBin && !has_bin) {
            file.bin = bytes_of(content);
            has_bin = true;
        } else {
            file.others.push_back({type, bytes_of(content)});
        }
    }
    if (!has_json) fail(file.path, "has no JSON chunk");
}

std::vector<std::byte> base64(std::string_view text, const GltfFile& file)
{
    std::vector<std::byte> to;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') break;
        constexpr std::string_view kDigits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos) fail(file.path, "has a damaged data uri");
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) to.push_back(static_cast<std::byte>(bits >> (count -= 8)));
    }
    return to;
}

const JsonText& list(const JsonText& json, const char* key)
{
    static const JsonText none = JsonText::array();
    const JsonText* found = json.find(key);
    return found && found->kind() == JsonText::Kind::Array ? *found : none;
}

std::size_t index_or(const JsonText& object, const char* key, std::size_t otherwise)
{
    const JsonText* member = object.find(key);
    return member ? member->as_index().value_or(otherwise) : otherwise;
}

// True for what lies in the BIN chunk: views, and what extensions put beside them.
bool is_place(const JsonText& value)
{
    const JsonText* buffer = value.find("buffer");
    return buffer && value.find("byteLength") && buffer->as_index() == std::size_t{0};
}

// Bytes [at, end) of the BIN chunk.
struct Part {
    std::size_t at = 0, end = 0;
    bool operator==(const Part&) const = default;
};

Part part_of(const JsonText& place)
{
    const std::size_t at = index_or(place, "byteOffset", 0);
    return {at, at + index_or(place, "byteLength", 0)};
}

void collect_parts(const JsonText& value, std::vector<Part>& to)
{
    if (is_place(value)) to.push_back(part_of(value));
    for (std::size_t i = 0; i < value.size(); ++i) collect_parts(value.at(i), to);
}

// What can be taken out of the BIN chunk: the listed parts where no other view lies over them. A
// cut is a multiple of 16 long, so that the rest keeps its alignment.
std::vector<Part> cuts_for(const GltfFile& file, std::vector<Part> listed)
{
    std::vector<Part> all;
    collect_parts(file.json, all);
    std::erase_if(listed, [&](const Part& part) {
        if (part.end > file.bin.size()) return true;
        return std::any_of(all.begin(), all.end(), [&](const Part& other) {
            return std::find(listed.begin(), listed.end(), other) == listed.end() &&
                   other.at < part.end && part.at < other.end;
        });
    });
    std::sort(listed.begin(), listed.end(),
              [](const Part& a, const Part& b) { return a.at < b.at; });
    std::vector<Part> cuts;
    for (const Part& part : listed) {
        const std::size_t from = cuts.empty() ? part.at : std::max(part.at, cuts.back().end);
        if (part.end < from + 16) continue;
        cuts.push_back({from, from + (part.end - from) / 16 * 16});
    }
    return cuts;
}

std::size_t moved(std::size_t at, const std::vector<Part>& cuts)
{
    std::size_t gone = 0;
    for (const Part& cut : cuts) {
        if (cut.at < at) gone += std::min(cut.end, at) - cut.at;
    }
    return at - gone;
}

bool moves(const JsonText& value, const std::vector<Part>& cuts)
{
    if (is_place(value) && moved(part_of(value).at, cuts) != part_of(value).at) return true;
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (moves(value.at(i), cuts)) return true;
    }
    return false;
}

// Only objects whose place changes are written anew.
void move_places(JsonText& value, const std::vector<Part>& cuts)
{
    if (is_place(value)) value.set("byteOffset", JsonText::number(moved(part_of(value).at, cuts)));
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (moves(value.at(i), cuts)) move_places(value.edit(i), cuts);
    }
}

}  // namespace

GltfFile read_gltf_file(const fs::path& path)
{
    const std::string text = read_file(path, "glTF", kMostBytes);
    GltfFile file;
    file.path = path;
    file.binary = text.size() >= 4 && word_at(text, 0) == kMagic;
    if (file.binary) {
        read_chunks(text, file);
    } else {
        file.json = JsonText::parse(text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text);
    }
    if (file.json.kind() != JsonText::Kind::Object || !file.json.find("asset"))
        fail(path, "is not glTF: there is no asset");
    return file;
}

std::vector<std::byte> to_bytes(const GltfFile& file)
{
    std::string json = file.json.dump();
    if (!file.binary) return bytes_of(json);
    while (json.size() % 4) json += ' ';
    std::vector<std::byte> chunks;
    const auto put = [&](std::uint32_t type, std::span<const std::byte> content, bool pad) {
        const std::size_t size = pad ? (content.size() + 3) / 4 * 4 : content.size();
        put_word(chunks, size);
        put_word(chunks, type);
        chunks.insert(chunks.end(), content.begin(), content.end());
        chunks.resize(chunks.size() + (4 - chunks.size() % 4) % 4);
    };
    put(kJson, bytes_of(json), true);
    if (!file.bin.empty()) put(kBin, file.bin, true);
    for (const GltfFile::Chunk& chunk : file.others) put(chunk.type, chunk.bytes, false);
    std::vector<std::byte> to;
    put_word(to, kMagic);
    put_word(to, 2);
    put_word(to, 12 + chunks.size());
    to.insert(to.end(), chunks.begin(), chunks.end());
    return to;
}

std::optional<fs::path> resource_path(const std::string& uri)
{
    if (uri.find(':') != std::string::npos) return {};
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
        if (escaped) {
            name += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            name += uri[i];
        }
    }
    return fs::path(name);
}

std::string to_uri(const fs::path& path)
{
    std::string to;
    for (const char c : path.generic_string()) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        if (plain) {
            to += c;
            continue;
        }
        constexpr char kHex[] = "0123456789ABCDEF";
        to += '%';
        to += kHex[(static_cast<unsigned char>(c) >> 4) & 15];
        to += kHex[static_cast<unsigned char>(c) & 15];
    }
    return to;
}

std::vector<std::byte> resource_bytes(const GltfFile& file, const std::string& uri)
{
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos || uri.rfind(";base64", comma) == std::string::npos)
            fail(file.path, "has a data uri that is not base64");
        return base64(std::string_view(uri).substr(comma + 1), file);
    }
    const std::optional<fs::path> relative = resource_path(uri);
    const bool outside =
        !relative || relative->is_absolute() ||
        std::find(relative->begin(), relative->end(), fs::path("..")) != relative->end();
    if (outside) {
        throw Error(
            "glTF " + file.path.string() + ": " + uri + " does not lie in the folder of the scene",
            "Put the file beside the scene and name it by a relative path.");
    }
    return bytes_of(read_file(file.path.parent_path() / *relative, "glTF resource", kMostBytes));
}

std::vector<std::byte> view_bytes(const GltfFile& file, std::size_t view)
{
    const JsonText& views = list(file.json, "bufferViews");
    const JsonText& buffers = list(file.json, "buffers");
    if (view >= views.size()) fail(file.path, "names a buffer view that it does not have");
    const JsonText& json = views.at(view);
    const std::size_t buffer = index_or(json, "buffer", ~std::size_t{0});
    const std::size_t at = index_or(json, "byteOffset", 0), size = index_or(json, "byteLength", 0);
    if (buffer >= buffers.size()) fail(file.path, "names a buffer that it does not have");
    const JsonText* uri = buffers.at(buffer).find("uri");
    std::vector<std::byte> other;
    if (uri) other = resource_bytes(file, uri->as_string().value_or(""));
    const std::vector<std::byte>& bytes = uri ? other : file.bin;
    if (at > bytes.size() || size > bytes.size() - at)
        fail(file.path, "is cut short: buffer view " + std::to_string(view) + " lies past the end");
    return {bytes.begin() + static_cast<std::ptrdiff_t>(at),
            bytes.begin() + static_cast<std::ptrdiff_t>(at + size)};
}

void remove_from_bin(GltfFile& file, const std::vector<std::size_t>& views)
{
    std::vector<Part> listed;
    for (const std::size_t v : views) {
        const JsonText& view = list(file.json, "bufferViews").at(v);
        if (is_place(view)) listed.push_back(part_of(view));
    }
    const std::vector<Part> cuts = cuts_for(file, std::move(listed));
    if (cuts.empty()) return;
    std::vector<std::byte> bin;
    std::size_t from = 0;
    const auto keep = [&](std::size_t until) {
        bin.insert(bin.end(), file.bin.begin() + static_cast<std::ptrdiff_t>(from),
                   file.bin.begin() + static_cast<std::ptrdiff_t>(until));
    };
    for (const Part& cut : cuts) {
        keep(cut.at);
        from = cut.end;
    }
    keep(file.bin.size());
    file.bin = std::move(bin);
    if (moves(file.json, cuts)) move_places(file.json, cuts);
    file.json.edit("buffers")
        .edit(std::size_t{0})
        .set("byteLength", JsonText::number(file.bin.size()));
}

std::size_t add_to_bin(GltfFile& file, std::span<const std::byte> bytes,
                       std::optional<std::size_t> reuse)
{
    if (!file.json.find("buffers")) file.json.set("buffers", JsonText::array());
    if (!file.json.find("bufferViews")) file.json.set("bufferViews", JsonText::array());
    JsonText& buffers = file.json.edit("buffers");
    if (buffers.size() == 0) buffers.append(JsonText::object());
    file.bin.resize((file.bin.size() + 15) / 16 * 16);
    const std::size_t at = file.bin.size();
    file.bin.insert(file.bin.end(), bytes.begin(), bytes.end());
    buffers.edit(std::size_t{0}).set("byteLength", JsonText::number(file.bin.size()));
    JsonText& views = file.json.edit("bufferViews");
    const std::size_t view = reuse.value_or(views.size());
    if (!reuse) views.append(JsonText::object());
    JsonText& json = views.edit(view);
    json.set("buffer", JsonText::number(0));
    json.set("byteOffset", JsonText::number(at));
    json.set("byteLength", JsonText::number(bytes.size()));
    return view;
}

}  // namespace petrichor::texproc
