#include "scene/animation/transform.h"

#include <cmath>

namespace petrichor::scene {

glm::dmat4 compose(const glm::dvec3& translation, const glm::dquat& rotation,
                   const glm::dvec3& scale)
{
    glm::dmat4 m = glm::mat4_cast(rotation);
    m[0] *= scale.x;
    m[1] *= scale.y;
    m[2] *= scale.z;
    m[3] = glm::dvec4(translation, 1.0);
    return m;
}

std::optional<glm::dquat> to_rotation(const glm::vec4& xyzw)
{
    const glm::dquat rotation(static_cast<double>(xyzw.w), static_cast<double>(xyzw.x),
                              static_cast<double>(xyzw.y), static_cast<double>(xyzw.z));
    const double length = glm::length(rotation);
    if (!(length > 1e-12)) return std::nullopt;
    return rotation / length;
}

bool is_usable(const glm::dmat4& m)
{
    constexpr double kLargest = 1e18;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!(std::abs(m[c][r]) <= kLargest)) return false;
        }
    }
    return true;
}

glm::dmat4 without_scale(const glm::dmat4& m)
{
    const auto unit_or = [](const glm::dvec3& v, const glm::dvec3& otherwise) {
        const double length = glm::length(v);
        return length > 1e-30 ? v / length : otherwise;
    };
    const glm::dvec3 z = unit_or(glm::dvec3(m[2]), {0.0, 0.0, 1.0});
    const glm::dvec3 side =
        std::abs(z.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    glm::dvec3 y(m[1]);
    y = unit_or(y - z * glm::dot(z, y), glm::normalize(side - z * glm::dot(z, side)));
    glm::dmat4 out(1.0);
    out[0] = glm::dvec4(glm::cross(y, z), 0.0);
    out[1] = glm::dvec4(y, 0.0);
    out[2] = glm::dvec4(z, 0.0);
    out[3] = m[3];
    return out;
}

}  // namespace petrichor::scene
