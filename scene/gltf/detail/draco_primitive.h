// Primitives that Draco packed, as if the file had them plain.
#ifndef PETRICHOR_SCENE_GLTF_DETAIL_DRACO_PRIMITIVE_H
#define PETRICHOR_SCENE_GLTF_DETAIL_DRACO_PRIMITIVE_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/gltf/detail/draco_mesh.h"
#include "scene/gltf/detail/gltf_parts.h"

namespace petrichor::scene {

/// What stands in for the accessors of a primitive, in the type that these say.
struct UnpackedPrimitive {
    UnpackedPrimitive() = default;
    UnpackedPrimitive(UnpackedPrimitive&&) = default;  // not copied: accessors point into `bytes`
    UnpackedPrimitive& operator=(UnpackedPrimitive&&) = default;

    std::map<std::string, std::vector<std::byte>> bytes;     ///< by attribute
    std::map<std::string, Accessor, std::less<>> accessors;  ///< by attribute; into `bytes`
    const std::vector<std::uint32_t>* corners = nullptr;     ///< of the mesh; 3 a triangle
};

/// Throws Error where Draco's mesh and the accessors of `attributes` do not agree. `packed` must
/// outlive the result.
UnpackedPrimitive unpack_primitive(GltfBuffers& buffers, const JsonObject& json,
                                   const JsonObject& attributes, const DracoMesh& packed);

/// Draco's meshes of the file, by mesh and primitive; those that have a plain copy are left packed.
std::map<std::pair<std::size_t, std::size_t>, DracoMesh> unpacked_meshes(GltfSource& source,
                                                                         const JsonArray& meshes);

}  // namespace petrichor::scene

#endif
