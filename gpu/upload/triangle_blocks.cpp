#include "gpu/upload/triangle_blocks.h"

#include <algorithm>
#include <cmath>

#include "base/four.h"

namespace petrichor::gpu {

namespace {

// What sums of four products may be off by, relative to what they are made of, many times over.
constexpr float kRounding = 1.0e-5f;
constexpr float kBehind = 1.0e-6f;  // the least w before an eye

glm::vec4 row_of(const glm::mat4& m, int row)
{
    return {m[0][row], m[1][row], m[2][row], m[3][row]};
}

Four absolute(Four v)
{
    return v < all(0.0f) ? -v : v;
}

}  // namespace

std::vector<TriangleBlock> blocks_of(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                     std::uint32_t first_vertex)
{
    std::vector<TriangleBlock> blocks;
    const std::size_t corners = std::size_t{3} * kBlockTriangles;
    blocks.reserve(indices.size() / corners + 1);
    for (std::size_t at = 0; at < indices.size(); at += corners) {
        Four low = all(1.0e30f), high = all(-1.0e30f), sum = all(0.0f);
        const std::size_t end = std::min(indices.size(), at + corners);
        for (std::size_t k = at; k < end; ++k) {
            const glm::vec3& of = positions[indices[k] - first_vertex];
            const Four p{of.x, of.y, of.z, 0.0f};
            low = smaller(p, low);
            high = larger(p, high);
            sum += p - p;  // 0, or not a number
        }
        const Four centre = 0.5f * (low + high) + sum, half = 0.5f * (high - low);
        blocks.push_back({{centre[0], centre[1], centre[2]}, {half[0], half[1], half[2]}});
    }
    return blocks;
}

void BlockSieve::set(Sides& sides, int lane, const glm::vec4& plane)
{
    for (int k = 0; k < 4; ++k) sides.rows[k][lane] = plane[k];
}

BlockSieve::BlockSieve(const glm::mat4& clip_from_mesh, glm::vec2 size, glm::vec2 low, glm::vec2 high, float slack,
                       float rounding, const AskedPart& asked)
    : w_(row_of(clip_from_mesh, 3)), slack_(slack), rounding_(rounding)
{
    const glm::vec4 z = row_of(clip_from_mesh, 2);
    for (int k = 0; k < 2; ++k) {
        // Pixels times w: the picture ends at 0 and at its size.
        const glm::vec4 along = 0.5f * size[k] * row_of(clip_from_mesh, k);
        set(frame_, 2 * k, along + (0.5f * size[k] - low[k]) * w_);
        set(frame_, 2 * k + 1, -along + (0.5f * size[k] + high[k]) * w_);
    }
    const int lanes = asked.count + 1;
    asked_fours_ = (lanes + 3) / 4;
    for (int i = 0; i < 4 * asked_fours_; ++i) {
        glm::vec4 plane(0.0f, 0.0f, 0.0f, 1.0f);
        if (i < asked.count) {
            const glm::vec3& line = asked.lines[static_cast<std::size_t>(i)];
            plane = line.x * row_of(clip_from_mesh, 0) + line.y * row_of(clip_from_mesh, 1);
            plane.w += line.z;
        } else if (i == asked.count) {
            plane = z - glm::vec4(0.0f, 0.0f, 0.0f, asked.least_z);
        }
        set(asked_[i / 4], i % 4, plane);
    }
}

bool BlockSieve::leaves_out(const TriangleBlock& block) const
{
    const glm::vec3& c = block.centre;
    const glm::vec3& h = block.half;
    const glm::vec3 size = glm::abs(c) + h;
    const glm::vec3 w_abs = glm::abs(glm::vec3(w_));
    const float middle = glm::dot(glm::vec3(w_), c) + w_.w;
    const float reach = glm::dot(w_abs, h) + kRounding * (glm::dot(w_abs, size) + std::abs(w_.w));
    if (middle + reach <= kBehind) return true;
    const float nearest = middle - reach;
    if (!(nearest > kBehind)) return false;
    const auto most = [&](const Sides& sides) {
        const Four x = four(sides.rows[0]), y = four(sides.rows[1]), z = four(sides.rows[2]), rest = four(sides.rows[3]);
        const Four ax = absolute(x), ay = absolute(y), az = absolute(z);
        return x * c.x + y * c.y + z * c.z + rest + (ax * h.x + ay * h.y + az * h.z) +
               (ax * size.x + ay * size.y + az * size.z + absolute(rest)) * kRounding;
    };
    const float slack = (slack_ + rounding_ / nearest) * (middle + reach) * (1.0f + kRounding);
    if (!none(most(frame_) < all(-slack))) return true;
    for (int k = 0; k < asked_fours_; ++k)
        if (!none(most(asked_[k]) < all(0.0f))) return true;
    return false;
}

}  // namespace petrichor::gpu
