// A ball of triangles.
#ifndef PETRICHOR_TESTS_GPU_BALL_H
#define PETRICHOR_TESTS_GPU_BALL_H

#include <cmath>

#include "scene/scene.h"

namespace petrichor::gpu {

/// Around `at`, its poles up and down.
inline scene::Primitive ball(std::uint32_t material = 0, const glm::vec3& at = glm::vec3(0.0f), float radius = 1.0f,
                      int rows = 32, int columns = 48)
{
    scene::Primitive p;
    for (int i = 0; i <= rows; ++i) {
        for (int j = 0; j <= columns; ++j) {
            const float a = 3.14159265f * static_cast<float>(i) / static_cast<float>(rows);
            const float b = 6.2831853f * static_cast<float>(j) / static_cast<float>(columns);
            const glm::vec3 n(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
            p.positions.push_back(at + radius * n);
            p.normals.push_back(n);
            p.tangents.emplace_back(-std::sin(b), 0.0f, std::cos(b), 1.0f);
            p.uv0.emplace_back(static_cast<float>(j) / static_cast<float>(columns), static_cast<float>(i) / static_cast<float>(rows));
        }
    }
    const auto side = static_cast<std::uint32_t>(columns) + 1;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(rows); ++i) {
        for (std::uint32_t j = 0; j + 1 < side; ++j) {
            const std::uint32_t a = i * side + j, b = a + side;
            for (const std::uint32_t k : {a, a + 1, b, b, a + 1, b + 1}) p.indices.push_back(k);
        }
    }
    p.material = material;
    return p;
}

}  // namespace petrichor::gpu

#endif
