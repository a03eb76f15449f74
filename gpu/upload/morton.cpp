#include "gpu/upload/morton.h"

#include <algorithm>

namespace petrichor::gpu {

std::uint32_t morton(const glm::vec3& p, const Bounds& box)
{
    const glm::vec3 size = glm::max(box.high - box.low, glm::vec3(1.0e-6f));
    const glm::vec3 share = (p - box.low) / size;
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        // Written so that NaN is 0.
        const auto cell = static_cast<std::uint32_t>(
            share[axis] > 0.0f ? std::min(share[axis], 1.0f) * 1023.0f : 0.0f);
        for (std::uint32_t bit = 0; bit < 10; ++bit)
            code |= (cell >> bit & 1u) << (3u * bit + static_cast<std::uint32_t>(axis));
    }
    return code;
}

}  // namespace petrichor::gpu
