// KHR_materials_variants: other materials for the primitives of a scene, by name.
#ifndef PETRICHOR_SCENE_GLTF_DETAIL_GLTF_VARIANTS_H
#define PETRICHOR_SCENE_GLTF_DETAIL_GLTF_VARIANTS_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "scene/gltf/detail/gltf_json.h"

namespace petrichor::scene {

/// The number of the variant to show; nothing when none is asked for. Throws Error for a name that
/// the file does not have.
std::optional<std::uint32_t> variant_number(const JsonObject& root, const std::string& variant);

/// The material of a primitive in that variant; nothing where the variant leaves it as it is.
std::optional<std::uint32_t> variant_material(const JsonObject& primitive, std::uint32_t variant,
                                              std::size_t material_count);

}  // namespace petrichor::scene

#endif
