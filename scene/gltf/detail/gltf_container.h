#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLTF_CONTAINER_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLTF_CONTAINER_H

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

#include "scene/gltf/detail/gltf_json.h"

namespace petrichor::scene {

/// The two parts of an asset; views into it.
struct GltfContainer {
    std::string_view json;
    std::span<const std::byte> bin;
    bool has_bin = false;
};

/// Takes a GLB apart, or passes glTF text through: told apart by the first four bytes.
/// Throws Error when the chunks do not fit the file or each other.
/// source: glTF 2.0 specification, section 4 (GLB file format).
GltfContainer split_container(std::span<const std::byte> asset, GltfLog& log);

/// Parses the JSON text. Throws Error with line and column; nesting deeper than 64 is refused.
nlohmann::json parse_gltf_json(std::string_view text, const GltfLog& log);

}  // namespace petrichor::scene

#endif
