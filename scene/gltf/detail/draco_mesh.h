// Meshes packed by Draco (KHR_draco_mesh_compression), unpacked in a child process with limits.
#ifndef PETRICHOR_SCENE_GLTF_DETAIL_DRACO_MESH_H
#define PETRICHOR_SCENE_GLTF_DETAIL_DRACO_MESH_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace petrichor::scene {

struct DracoAttribute {
    std::size_t components = 0;
    std::vector<float> values;  ///< components a vertex; whole numbers as they are
};

struct DracoMesh {
    std::vector<std::uint32_t> indices;  ///< 3 a triangle, each below vertices
    std::size_t vertices = 0;
    std::map<std::uint32_t, DracoAttribute> attributes;  ///< by Draco's unique number
};

/// All of a file's in one run of the child. Throws Error for damage, a child that came to its end or
/// its limits, and where this build reads no Draco. `name` is the scene's, for messages.
std::vector<DracoMesh> unpack_draco(const std::vector<std::span<const std::byte>>& packed,
                                    const std::string& name);

}  // namespace petrichor::scene

#endif
