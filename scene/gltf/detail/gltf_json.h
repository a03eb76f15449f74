#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLTF_JSON_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLTF_JSON_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace petrichor::scene {

/// What was ignored or mended. A scene may have the same flaw ten thousand times: each is said
/// once, with the first place and the number of others.
class Warnings {
public:
    void add(const std::string& where, const std::string& what);
    std::vector<std::string> lines() const;

private:
    struct Entry {
        std::string where;
        std::size_t others = 0;
    };
    std::map<std::string, Entry> entries_;
};

/// Text of a file as it may stand in a message: quoted, no control characters, at most 60 of it.
std::string in_quotes(std::string_view text);
/// Shortest usual form: 0.5, 17, 1e+20.
std::string number_text(double value);
/// The candidate that is the fewest edits away, when it is near enough to be a misspelling.
std::optional<std::string> nearest_word(std::string_view word,
                                        std::span<const std::string_view> candidates);

/// Everything a message needs to know about the file.
struct GltfLog {
    std::string file;  ///< "street.glb"
    Warnings warnings;

    /// Throws Error "street.glb: PATH: PROBLEM".
    [[noreturn]] void fail(const std::string& path, const std::string& problem,
                           const std::string& fix) const;
};

class JsonArray;

/// An object of the JSON text together with the way to it, so that every complaint names the place:
/// `street.glb: meshes[2].primitives[0].indices: accessor 17 does not exist (0..11)`.
///
/// Getters return the fallback when the key is absent and throw Error when the value has the wrong
/// type or range. The JSON document and the log must outlive the object.
class JsonObject {
public:
    JsonObject(const nlohmann::json& value, std::string path, GltfLog& log);

    const std::string& path() const { return path_; }
    std::string path_to(std::string_view key) const;
    GltfLog& log() const { return *log_; }

    bool has(std::string_view key) const;
    std::vector<std::string> keys() const;
    std::optional<JsonObject> object(std::string_view key) const;
    /// extensions.NAME of this object.
    std::optional<JsonObject> extension(std::string_view name) const;
    JsonArray array(std::string_view key) const;  ///< empty when absent

    std::string text(std::string_view key, std::string_view fallback = "") const;
    bool flag(std::string_view key, bool fallback) const;
    /// A non-negative whole number below 2^53; 3.0 counts as one.
    std::uint64_t whole(std::string_view key, std::uint64_t fallback) const;
    std::uint64_t require_whole(std::string_view key) const;
    /// The index of one of `count` things; `thing` is what the message calls them.
    std::optional<std::uint32_t> index(std::string_view key, std::string_view thing,
                                       std::size_t count) const;
    std::uint32_t require_index(std::string_view key, std::string_view thing,
                                std::size_t count) const;
    float number(std::string_view key, float fallback,
                 float low = std::numeric_limits<float>::lowest(),
                 float high = std::numeric_limits<float>::max()) const;
    /// As number(), but a value out of range is clamped with a warning: exporters do write them.
    float clamped(std::string_view key, float fallback, float low, float high) const;
    /// Overwrites `values` when the key is there; it must hold exactly as many numbers. Gives
    /// whether it was there.
    bool numbers(std::string_view key, std::span<float> values) const;

    [[noreturn]] void fail(std::string_view key, const std::string& problem,
                           const std::string& fix) const;
    void warn(std::string_view key, const std::string& what) const;

private:
    const nlohmann::json* find(std::string_view key) const;

    const nlohmann::json* value_;
    std::string path_;
    GltfLog* log_;
};

/// An array of the JSON text together with the way to it.
class JsonArray {
public:
    JsonArray(const nlohmann::json* value, std::string path, GltfLog& log)
        : value_(value), path_(std::move(path)), log_(&log)
    {
    }

    std::size_t size() const;
    const std::string& path() const { return path_; }
    std::string path_to(std::size_t i) const { return path_ + "[" + std::to_string(i) + "]"; }
    JsonObject object(std::size_t i) const;
    std::string text(std::size_t i) const;
    std::uint32_t index(std::size_t i, std::string_view thing, std::size_t count) const;

private:
    const nlohmann::json* value_;  ///< null: absent, empty
    std::string path_;
    GltfLog* log_;
};

}  // namespace petrichor::scene

#endif
