#ifndef PETRICHOR_GPU_UPLOAD_ASKED_PART_H
#define PETRICHOR_GPU_UPLOAD_ASKED_PART_H

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace petrichor::gpu {

/// Where a map is asked: what lies outside of it throws its shadow on nothing that is seen.
struct AskedPart {
    std::array<glm::vec3, 8> lines{};  ///< inside of each a x + b y + c >= 0, x and y of clip space
    int count = 0;                     ///< 0: everywhere
    float least_z = -1.0e30f;          ///< of clip space: the farthest that asks

    bool operator==(const AskedPart&) const = default;
};

/// The part without what all of a sphere is inside of; nothing when the sphere is outside.
std::optional<AskedPart> asked_of(const AskedPart& asked, const glm::mat4& clip_from_world, const glm::vec3& centre_m,
                                  float radius_m);

}  // namespace petrichor::gpu

#endif
