#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLTF_URI_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLTF_URI_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/detail/gltf_json.h"

namespace petrichor::scene {

bool is_data_uri(std::string_view uri);

/// The bytes that a `data:[type];base64,...` URI carries. `where` is the JSON path for messages.
/// Throws Error when it is not base64.
std::vector<std::byte> decode_data_uri(std::string_view uri, const std::string& where,
                                       const GltfLog& log);

/// The file that a relative URI names, percent-decoded, separated by '/'.
///
/// Throws Error for anything that could leave the folder of the scene: an absolute path, a "..", a
/// scheme (http:, file:, C:), also when they only appear after decoding; and for control
/// characters.
std::string decode_relative_uri(std::string_view uri, const std::string& where, const GltfLog& log);

}  // namespace petrichor::scene

#endif
