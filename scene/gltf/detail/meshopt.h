// Buffers packed by meshoptimizer (EXT_meshopt_compression), unpacked by us.
#ifndef PETRICHOR_SCENE_GLTF_DETAIL_MESHOPT_H
#define PETRICHOR_SCENE_GLTF_DETAIL_MESHOPT_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace petrichor::scene {

enum class MeshoptMode { Attributes, Triangles, Indices };
enum class MeshoptFilter { None, Octahedral, Quaternion, Exponential };

/// count * stride bytes; nothing when the packed bytes are damaged. Never reads beyond `packed`,
/// whatever it holds.
///
///   stride   Attributes: a multiple of 4 up to 256; indices: 2 or 4
///   count    Triangles: a multiple of 3
///   filter   of Attributes: Octahedral has strides 4 and 8, Quaternion 8
///   source   EXT_meshopt_compression, appendices A (bitstream) and B (filters)
std::optional<std::vector<std::byte>> unpack_meshopt(std::span<const std::byte> packed,
                                                     std::size_t count, std::size_t stride,
                                                     MeshoptMode mode, MeshoptFilter filter);

}  // namespace petrichor::scene

#endif
