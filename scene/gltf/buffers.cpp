#include "scene/gltf/detail/gltf_buffers.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "scene/gltf/detail/gltf_uri.h"
#include "scene/gltf/detail/meshopt_views.h"

namespace petrichor::scene {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";
constexpr const char* kFixDamaged = "Export the scene again: the file is damaged or incomplete.";

std::size_t component_bytes(ComponentType type)
{
    switch (type) {
        case ComponentType::Int8:
        case ComponentType::Uint8:
            return 1;
        case ComponentType::Int16:
        case ComponentType::Uint16:
            return 2;
        case ComponentType::Uint32:
        case ComponentType::Float:
            return 4;
    }
    return 4;
}

ComponentType component_type(const JsonObject& json, std::string_view key)
{
    const std::uint64_t code = json.require_whole(key);
    if (code < 5120 || code > 5126 || code == 5124) {
        json.fail(key,
                  "must be 5120 (byte), 5121 (unsigned byte), 5122 (short), 5123 (unsigned short), "
                  "5125 (unsigned int) or 5126 (float), got " +
                      std::to_string(code),
                  kFixDamaged);
    }
    return static_cast<ComponentType>(code);
}

int component_count(const JsonObject& json)
{
    const std::string type = json.text("type");
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    if (type == "MAT4") return 16;
    json.fail("type", "must be SCALAR, VEC2, VEC3, VEC4 or MAT4 here, got " + in_quotes(type),
              kFixDamaged);
}

template <class T>
T load(const std::byte* from)
{
    T value;
    std::memcpy(&value, from, sizeof value);  // the file promises no alignment
    return value;
}

// Whether count elements of `bytes` each, `stride` apart, fit in `available` bytes from `offset`
// on. count, offset < 2^53.
bool fits(std::uint64_t offset, std::uint64_t count, std::uint64_t stride, std::uint64_t bytes,
          std::uint64_t available)
{
    if (count == 0) return offset <= available;
    if (offset > available || available - offset < bytes) return false;
    return count - 1 <= (available - offset - bytes) / stride;
}

}  // namespace

void Budget::grow(std::size_t file_bytes)
{
    left_ += std::uint64_t{256} * file_bytes;
}

void Budget::take(std::uint64_t count, std::uint64_t bytes_each, const std::string& where,
                  const GltfLog& log)
{
    if (bytes_each != 0 && count > left_ / bytes_each) {
        log.fail(where,
                 "asks for " + std::to_string(count) + " x " + std::to_string(bytes_each) +
                     " bytes, far more than a file of this size can mean",
                 "Correct the count, or export the scene again: the file is damaged.");
    }
    left_ -= count * bytes_each;
}

const std::byte* Accessor::element(std::size_t i) const
{
    if (!sparse_indices.empty()) {
        const auto found = std::lower_bound(sparse_indices.begin(), sparse_indices.end(),
                                            static_cast<std::uint32_t>(i));
        if (found != sparse_indices.end() && *found == i) {
            const auto nth = static_cast<std::size_t>(found - sparse_indices.begin());
            return sparse_values +
                   nth * static_cast<std::size_t>(components) * component_bytes(type);
        }
    }
    return base ? base + i * stride : nullptr;
}

float Accessor::value(std::size_t i, int c) const
{
    const std::byte* at = element(i);
    if (!at) return 0.0f;
    at += static_cast<std::size_t>(c) * component_bytes(type);
    float number = 0.0f;
    float largest = 1.0f;
    switch (type) {
        case ComponentType::Float:
            return load<float>(at);
        case ComponentType::Int8:
            number = load<std::int8_t>(at), largest = 127.0f;
            break;
        case ComponentType::Uint8:
            number = load<std::uint8_t>(at), largest = 255.0f;
            break;
        case ComponentType::Int16:
            number = load<std::int16_t>(at), largest = 32767.0f;
            break;
        case ComponentType::Uint16:
            number = load<std::uint16_t>(at), largest = 65535.0f;
            break;
        case ComponentType::Uint32:
            return static_cast<float>(load<std::uint32_t>(at));
    }
    return normalized ? std::max(number / largest, -1.0f) : number;
}

std::uint32_t Accessor::whole(std::size_t i) const
{
    const std::byte* at = element(i);
    if (!at) return 0;
    if (type == ComponentType::Uint8) return load<std::uint8_t>(at);
    if (type == ComponentType::Uint16) return load<std::uint16_t>(at);
    return load<std::uint32_t>(at);
}

std::uint32_t Accessor::part(std::size_t i, int c) const
{
    const std::byte* at = element(i);
    if (!at) return 0;
    at += static_cast<std::size_t>(c) * component_bytes(type);
    return type == ComponentType::Uint8 ? load<std::uint8_t>(at) : load<std::uint16_t>(at);
}

GltfBuffers::GltfBuffers(const JsonObject& root, std::span<const std::byte> bin, bool has_bin,
                         const ResourceReader& read_resource, std::size_t asset_bytes)
    : log_(&root.log()),
      buffers_json_(root.array("buffers")),
      views_json_(root.array("bufferViews")),
      accessors_json_(root.array("accessors")),
      bin_(bin),
      has_bin_(has_bin),
      read_resource_(&read_resource)
{
    budget.grow(asset_bytes);
}

std::vector<std::byte> GltfBuffers::read_resource(const std::string& uri, const std::string& where)
{
    if (is_data_uri(uri)) return decode_data_uri(uri, where, *log_);
    const std::string file = decode_relative_uri(uri, where, *log_);
    if (!*read_resource_) {
        log_->fail(where, "the file " + in_quotes(file) + " is not at hand",
                   "Give a scene that holds its data in the file itself (.glb).");
    }
    try {
        std::vector<std::byte> bytes = (*read_resource_)(file);
        if (files_read_.insert(file).second) budget.grow(bytes.size());
        return bytes;
    } catch (const Error& problem) {
        log_->fail(where, problem.what(), problem.fix());
    }
}

std::span<const std::byte> GltfBuffers::buffer(std::uint32_t index)
{
    const auto found = buffers_.find(index);
    if (found != buffers_.end()) return found->second;

    const JsonObject json = buffers_json_.object(index);
    const std::uint64_t length = json.require_whole("byteLength");
    std::span<const std::byte> bytes;
    std::string source;
    if (json.has("uri")) {
        const std::string uri = json.text("uri");
        const std::string where = json.path_to("uri");
        const std::string key =
            is_data_uri(uri) ? "data:" + where : decode_relative_uri(uri, where, *log_);
        const auto cached = resources_.find(key);
        bytes = cached != resources_.end()
                    ? cached->second
                    : resources_.emplace(key, read_resource(uri, where)).first->second;
        source = "its URI gives ";
    } else {
        if (index != 0 || !has_bin_) {
            json.fail("uri", "is missing, and there is no BIN chunk for this buffer",
                      "Keep the .bin file beside the scene, or export the scene again.");
        }
        bytes = bin_;
        source = "the BIN chunk has ";
    }
    if (length > bytes.size()) {
        json.fail("byteLength",
                  "is " + std::to_string(length) + ", but " + source +
                      std::to_string(bytes.size()) + " bytes",
                  kFixDamaged);
    }
    return buffers_[index] = bytes.first(length);
}

namespace {

MeshoptView packed_view(const JsonObject& json, const JsonObject& view_json,
                        std::span<const std::byte> packed)
{
    const auto choice = [&](std::string_view key, std::span<const std::string_view> words) {
        const std::string word = json.text(key, std::string(words[0]));
        const auto found = std::find(words.begin(), words.end(), word);
        if (found == words.end()) json.fail(key, "unknown word " + in_quotes(word), kFixDamaged);
        return found - words.begin();
    };
    static constexpr std::string_view kModes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
    static constexpr std::string_view kFilters[] = {"NONE", "OCTAHEDRAL", "QUATERNION",
                                                    "EXPONENTIAL"};
    const std::uint64_t stride = json.require_whole("byteStride");
    const std::uint64_t count = json.require_whole("count");
    if (stride == 0 || stride > 256 || count != view_json.require_whole("byteLength") / stride) {
        json.fail("count", "times byteStride must be the byteLength of the view", kFixDamaged);
    }
    // A packed byte brings forth 128 at most: sixteen zeros are two bits of a header.
    if (count * stride / 128 > packed.size()) {
        json.fail("count", "is more than " + std::to_string(packed.size()) + " bytes can hold",
                  kFixDamaged);
    }
    return {packed, count, stride, static_cast<MeshoptMode>(choice("mode", kModes)),
            static_cast<MeshoptFilter>(choice("filter", kFilters))};
}

}  // namespace

// All of the file that are packed, since a child process unpacks them; their plain bytes may be missing.
void GltfBuffers::unpack_views()
{
    std::vector<MeshoptView> packed;
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < view_count(); ++i) {
        const JsonObject view_json = views_json_.object(i);
        const auto json = view_json.extension(kMeshopt);
        if (!json) continue;
        packed.push_back(packed_view(*json, view_json, range_of(*json)));
        places.push_back(i);
        budget.take(packed.back().count, packed.back().stride, json->path_to("count"), *log_);
    }
    auto unpacked = unpack_meshopt_views(packed, log_->file);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!unpacked[i]) {
            views_json_.object(places[i])
                .extension(kMeshopt)
                ->fail("", "the packed bytes are damaged", kFixDamaged);
        }
        unpacked_[places[i]] = std::move(*unpacked[i]);
    }
}

std::span<const std::byte> GltfBuffers::view(std::uint32_t index)
{
    const JsonObject json = views_json_.object(index);
    if (!json.extension(kMeshopt)) return range_of(json);
    if (unpacked_.empty()) unpack_views();
    return unpacked_.at(index);
}

// The bytes of a view, or of its packed form.
std::span<const std::byte> GltfBuffers::range_of(const JsonObject& json)
{
    const auto bytes = buffer(json.require_index("buffer", "buffer", buffers_json_.size()));
    const std::uint64_t offset = json.whole("byteOffset", 0);
    const std::uint64_t length = json.require_whole("byteLength");
    if (!fits(offset, length, 1, 1, bytes.size())) {
        json.fail("byteLength",
                  "bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                      " are not inside the buffer of " + std::to_string(bytes.size()),
                  kFixDamaged);
    }
    return bytes.subspan(offset, length);
}

const Accessor& GltfBuffers::accessor(std::uint32_t index)
{
    const auto found = accessors_.find(index);
    if (found != accessors_.end()) return found->second;
    return accessors_.emplace(index, read_accessor(accessors_json_.object(index))).first->second;
}

Accessor GltfBuffers::read_accessor(const JsonObject& json)
{
    Accessor accessor;
    accessor.type = component_type(json, "componentType");
    accessor.components = component_count(json);
    accessor.normalized = json.flag("normalized", false);
    const std::uint64_t count = json.require_whole("count");
    if (count == 0 || count > 0xffffffffu) {
        json.fail("count", "must be in [1, 4294967295], got " + std::to_string(count), kFixDamaged);
    }
    accessor.count = count;
    const std::size_t bytes =
        static_cast<std::size_t>(accessor.components) * component_bytes(accessor.type);
    accessor.stride = bytes;

    if (const auto view_index = json.index("bufferView", "buffer view", view_count())) {
        const auto data = view(*view_index);
        const JsonObject view_json = views_json_.object(*view_index);
        if (view_json.has("byteStride")) {
            accessor.stride = view_json.require_whole("byteStride");
            if (accessor.stride < bytes || accessor.stride > 252) {
                view_json.fail("byteStride",
                               "must be in [" + std::to_string(bytes) + ", 252] for " +
                                   json.path() + ", got " + std::to_string(accessor.stride),
                               kFixDamaged);
            }
        }
        const std::uint64_t offset = json.whole("byteOffset", 0);
        if (!fits(offset, count, accessor.stride, bytes, data.size())) {
            json.fail("count",
                      std::to_string(count) + " elements of " + std::to_string(bytes) + " bytes, " +
                          std::to_string(accessor.stride) + " apart from offset " +
                          std::to_string(offset) + ", do not fit in bufferViews[" +
                          std::to_string(*view_index) + "] of " + std::to_string(data.size()) +
                          " bytes",
                      kFixDamaged);
        }
        accessor.base = data.data() + offset;
    }
    if (const auto sparse = json.object("sparse")) read_sparse(*sparse, accessor);
    return accessor;
}

void GltfBuffers::read_sparse(const JsonObject& json, Accessor& accessor)
{
    const std::uint64_t count = json.require_whole("count");
    if (count == 0 || count > accessor.count) {
        json.fail(
            "count",
            "must be in [1, " + std::to_string(accessor.count) + "], got " + std::to_string(count),
            kFixDamaged);
    }
    // Bytes of one half of the sparse data, known to fit.
    const auto part = [&](std::string_view name, std::size_t bytes_each) {
        const auto object = json.object(name);
        if (!object) json.fail(name, "is missing", kFixDamaged);
        const auto data = view(object->require_index("bufferView", "buffer view", view_count()));
        const std::uint64_t offset = object->whole("byteOffset", 0);
        if (!fits(offset, count, bytes_each, bytes_each, data.size())) {
            object->fail("byteOffset",
                         std::to_string(count) + " elements of " + std::to_string(bytes_each) +
                             " bytes from offset " + std::to_string(offset) +
                             " do not fit in a buffer view of " + std::to_string(data.size()) +
                             " bytes",
                         kFixDamaged);
        }
        return data.data() + offset;
    };
    const auto indices = json.object("indices");
    if (!indices) json.fail("indices", "is missing", kFixDamaged);
    Accessor index;
    index.type = component_type(*indices, "componentType");
    if (index.type != ComponentType::Uint8 && index.type != ComponentType::Uint16 &&
        index.type != ComponentType::Uint32) {
        indices->fail("componentType", "must be an unsigned integer type", kFixDamaged);
    }
    index.count = count;
    index.stride = component_bytes(index.type);
    index.base = part("indices", index.stride);
    accessor.sparse_values = part(
        "values", static_cast<std::size_t>(accessor.components) * component_bytes(accessor.type));
    budget.take(count, sizeof(std::uint32_t), json.path_to("count"), *log_);
    accessor.sparse_indices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t at = index.whole(i);
        if (at >= accessor.count || (i > 0 && at <= accessor.sparse_indices.back())) {
            indices->fail("bufferView",
                          "sparse index " + std::to_string(i) + " is " + std::to_string(at) +
                              "; they must increase and be below " + std::to_string(accessor.count),
                          kFixDamaged);
        }
        accessor.sparse_indices.push_back(at);
    }
}

}  // namespace petrichor::scene
