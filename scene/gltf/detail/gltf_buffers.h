#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLTF_BUFFERS_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLTF_BUFFERS_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/detail/gltf_json.h"
#include "scene/gltf/gltf.h"

namespace petrichor::scene {

/// Limits what a file may make us allocate: 512 MiB and 256 times its own size (with the buffers
/// and images it names). Honest scenes stay far below: most bytes become some 50 of ours, and a
/// thousand meshes may share one vertex array. Accessors without a buffer view hold zeros that no
/// byte of the file stands behind; their elements are charged at 4096 bytes, so that a count of 1e9
/// is refused.
class Budget {
public:
    static constexpr std::uint64_t kInventedElement = 4096;

    void grow(std::size_t file_bytes);
    /// Charges `count` things of `bytes_each`; throws Error at `where` when that is too much.
    void take(std::uint64_t count, std::uint64_t bytes_each, const std::string& where,
              const GltfLog& log);

private:
    std::uint64_t left_ = std::uint64_t{512} << 20;
};

enum class ComponentType : std::uint32_t {
    Int8 = 5120,
    Uint8 = 5121,
    Int16 = 5122,
    Uint16 = 5123,
    Uint32 = 5125,
    Float = 5126,
};

/// An accessor whose every byte is known to lie inside its buffer.
struct Accessor {
    std::size_t count = 0;
    int components = 1;  ///< 1..4, or 16 of a matrix
    ComponentType type = ComponentType::Float;
    bool normalized = false;
    const std::byte* base = nullptr;  ///< null: zeros
    std::size_t stride = 0;
    std::vector<std::uint32_t> sparse_indices;  ///< strictly increasing, each < count
    const std::byte* sparse_values = nullptr;

    /// Component c of element i as a number; normalised integers become -1..1 or 0..1.
    float value(std::size_t i, int c) const;
    /// Element i of an unsigned accessor.
    std::uint32_t whole(std::size_t i) const;
    /// Component c of element i of an accessor of unsigned bytes or shorts.
    std::uint32_t part(std::size_t i, int c) const;

private:
    const std::byte* element(std::size_t i) const;
};

/// Buffers, buffer views and accessors, loaded when they are first asked for and checked then.
class GltfBuffers {
public:
    /// The views and functions given must outlive the object.
    GltfBuffers(const JsonObject& root, std::span<const std::byte> bin, bool has_bin,
                const ResourceReader& read_resource, std::size_t asset_bytes);

    std::size_t accessor_count() const { return accessors_json_.size(); }
    std::size_t view_count() const { return views_json_.size(); }

    /// Bytes of a buffer view.
    std::span<const std::byte> view(std::uint32_t index);
    const Accessor& accessor(std::uint32_t index);
    /// Bytes of a data: URI or of a file beside the scene. `where` is the JSON path.
    std::vector<std::byte> read_resource(const std::string& uri, const std::string& where);

    Budget budget;

private:
    std::span<const std::byte> buffer(std::uint32_t index);
    std::span<const std::byte> range_of(const JsonObject& json);
    void unpack_views();
    Accessor read_accessor(const JsonObject& json);
    void read_sparse(const JsonObject& json, Accessor& accessor);

    GltfLog* log_;
    JsonArray buffers_json_;
    JsonArray views_json_;
    JsonArray accessors_json_;
    std::span<const std::byte> bin_;
    bool has_bin_;
    const ResourceReader* read_resource_;
    std::set<std::string> files_read_;
    std::map<std::string, std::vector<std::byte>> resources_;  ///< of buffers, by decoded URI
    std::map<std::uint32_t, std::span<const std::byte>> buffers_;
    std::map<std::uint32_t, std::vector<std::byte>> unpacked_;  ///< views, by number
    std::map<std::uint32_t, Accessor> accessors_;
};

}  // namespace petrichor::scene

#endif
