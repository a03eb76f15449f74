#ifndef PETRICHOR_GPU_UPLOAD_MORTON_H
#define PETRICHOR_GPU_UPLOAD_MORTON_H

#include <cstdint>
#include <glm/glm.hpp>

#include "gpu/upload/scene_names.h"

namespace petrichor::gpu {

/// A number of 30 bits along Morton's curve (Morton 1966) through the box: what lies together mostly has
/// numbers that do. NaN is at its low side.
std::uint32_t morton(const glm::vec3& p, const Bounds& box);

}  // namespace petrichor::gpu

#endif
