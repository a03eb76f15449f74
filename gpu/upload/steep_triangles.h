#ifndef PETRICHOR_GPU_UPLOAD_STEEP_TRIANGLES_H
#define PETRICHOR_GPU_UPLOAD_STEEP_TRIANGLES_H

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/upload/vertex.h"

namespace petrichor::gpu {

struct Draw;
struct GpuMaterial;

/// What of a scene is so steep that no water stands on it, whatever the weather: walls, posts, most of a roof. It is shaded
/// by a shorter text (WATER_STEEP), since a CPU walks the part of puddles and rings for a wall as well.
struct SteepTriangles {
    /// Bits of a triangle: nowhere on it does its material hold water; nor has it any of a hollow beside it (gpu/frame/place.glsl).
    static constexpr std::uint8_t kDry = 1, kUpright = 2;
    /// Fewer indices are not looked at one by one.
    static constexpr std::uint32_t kLeastIndices = 3 * 256;

    std::vector<std::uint8_t> whole;                   ///< of each draw: what all its triangles are
    std::vector<std::vector<std::uint8_t>> triangles;  ///< of each draw; empty: as `whole` has it
    std::vector<std::uint8_t> some;                    ///< of each material: what some of its triangles are
    std::vector<std::uint8_t> all;                     ///< .. and what all are
};

/// y of the normal, seen from either side, from which on water stands on a material in some weather. 0: from the first.
float water_stands_from(const GpuMaterial& material);

/// Of the scene as it is laid out. What moves or is shaped anew for a frame is not steep.
SteepTriangles steep_triangles(std::span<const Draw> draws, std::span<const GpuMaterial> materials,
                               std::span<const Vertex> vertices, std::span<const std::uint32_t> indices);

/// What a triangle with these unit normals at its corners is, between them as well.
std::uint8_t steep_bits(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float stands_from);

}  // namespace petrichor::gpu

#endif
