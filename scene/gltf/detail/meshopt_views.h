// Buffer views packed by EXT_meshopt_compression, unpacked in a child process with limits.
#ifndef PETRICHOR_SCENE_GLTF_DETAIL_MESHOPT_VIEWS_H
#define PETRICHOR_SCENE_GLTF_DETAIL_MESHOPT_VIEWS_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/detail/meshopt.h"

namespace petrichor::scene {

/// A view as it lies in the file: the arguments of unpack_meshopt().
struct MeshoptView {
    std::span<const std::byte> packed;
    std::uint64_t count = 0, stride = 0;
    MeshoptMode mode = MeshoptMode::Attributes;
    MeshoptFilter filter = MeshoptFilter::None;
};

/// Of each view count * stride bytes, or nothing where it is damaged: all of a file's in one run of the
/// child. Throws Error when that cannot be started, crashes or comes to its limits. `name` is the scene's.
std::vector<std::optional<std::vector<std::byte>>> unpack_meshopt_views(std::span<const MeshoptView> views,
                                                                        const std::string& name);

}  // namespace petrichor::scene

#endif
