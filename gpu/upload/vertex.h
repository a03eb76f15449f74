#ifndef PETRICHOR_GPU_UPLOAD_VERTEX_H
#define PETRICHOR_GPU_UPLOAD_VERTEX_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "gpu/upload/scene_names.h"

namespace petrichor::gpu {

/// One vertex as the vertex stage reads it.
struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec4 tangent;
    glm::vec2 uv0;
    glm::vec2 uv1;
    std::uint8_t color[4];
    std::uint8_t weather[4];  ///< masks; then what is not snow itself
};
static_assert(sizeof(Vertex) == 64);

/// Vertex i of a primitive as the scene holds it.
Vertex vertex_of(const scene::Primitive& primitive, std::size_t i);

}  // namespace petrichor::gpu

#endif
