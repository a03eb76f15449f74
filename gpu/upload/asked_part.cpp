#include "gpu/upload/asked_part.h"

#include <algorithm>
#include <cstddef>

namespace petrichor::gpu {

std::optional<AskedPart> asked_of(const AskedPart& asked, const glm::mat4& clip_from_world, const glm::vec3& centre_m,
                                  float radius_m)
{
    AskedPart part;
    if (asked.count == 0) return part;
    const glm::vec4 centre = clip_from_world * glm::vec4(centre_m, 1.0f);
    const auto radius = [&](int row) {
        return radius_m * glm::length(glm::vec3(clip_from_world[0][row], clip_from_world[1][row],
                                                clip_from_world[2][row]));
    };
    if (centre.z + radius(2) < asked.least_z) return {};
    if (centre.z - radius(2) < asked.least_z) part.least_z = asked.least_z;
    const float wide = std::max(radius(0), radius(1));
    for (int i = 0; i < asked.count; ++i) {
        const glm::vec3& line = asked.lines[static_cast<std::size_t>(i)];
        const float inside = line.x * centre.x + line.y * centre.y + line.z;
        if (inside < -wide) return {};
        if (!(inside > wide)) part.lines[static_cast<std::size_t>(part.count++)] = line;
    }
    return part;
}

}  // namespace petrichor::gpu
