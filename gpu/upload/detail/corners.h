#ifndef PETRICHOR_GPU_UPLOAD_DETAIL_CORNERS_H
#define PETRICHOR_GPU_UPLOAD_DETAIL_CORNERS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "base/four.h"
#include "gpu/upload/seen_triangles.h"

namespace petrichor::gpu {

/// Brings vertices to the screen, four at a time; the bits are those of `clip_from_mesh * vec4(position, 1)` one by one.
class CornerProjector {
public:
    CornerProjector(const glm::mat4& clip_from_mesh, float width, float height, const AskedPart& asked)
        : matrix_(clip_from_mesh), width_(width), height_(height), asked_(asked)
    {
    }
    void project(const glm::vec3* positions, std::size_t count, Corner* out) const
    {
        std::size_t at = 0;
        for (; at + 4 <= count; at += 4) four_of(&positions[at].x, out + at);
        if (at == count) return;
        glm::vec3 last[4] = {};
        Corner corners[4];
        std::copy_n(positions + at, count - at, last);
        four_of(&last[0].x, corners);
        std::copy_n(corners, count - at, out + at);
    }

private:
    void four_of(const float* xyz, Corner* out) const
    {
        const Four p = four(xyz), q = four(xyz + 4), r = four(xyz + 8);
        const Four x = __builtin_shufflevector(__builtin_shufflevector(p, q, 0, 3, 6, 6), r, 0, 1, 2, 5);
        const Four y = __builtin_shufflevector(__builtin_shufflevector(p, q, 1, 4, 7, 7), r, 0, 1, 2, 6);
        const Four z = __builtin_shufflevector(__builtin_shufflevector(p, q, 2, 5, 5, 5), r, 0, 1, 4, 7);
        const auto row = [&](int k) {
            return (x * matrix_[0][k] + y * matrix_[1][k]) + (z * matrix_[2][k] + matrix_[3][k]);
        };
        const Four clip_x = row(0), clip_y = row(1), clip_w = row(3);
        const Signs before = clip_w > all(1.0e-6f);
        const Four nearer = 1.0f / clip_w;
        const Four across = (clip_x * nearer * 0.5f + 0.5f) * width_;
        const Four down = (clip_y * nearer * 0.5f + 0.5f) * height_;
        // What is not a number is inside of all.
        Signs outside = row(2) < all(asked_.least_z);
        outside &= Signs{} + std::int32_t{INT32_MIN};
        for (int i = 0; i < asked_.count; ++i) {
            const glm::vec3& line = asked_.lines[static_cast<std::size_t>(i)];
            const Signs beyond = clip_x * line.x + clip_y * line.y + line.z < all(0.0f);
            outside |= beyond & (std::int32_t{1} << i);
        }
        for (int k = 0; k < 4; ++k) {
            if (before[k] == 0) {
                out[k] = {};
                continue;
            }
            out[k] = {across[k], down[k], nearer[k], static_cast<std::uint32_t>(outside[k])};
        }
    }

    glm::mat4 matrix_;
    float width_, height_;
    AskedPart asked_;
};

}  // namespace petrichor::gpu

#endif
