#ifndef PETRICHOR_GPU_UPLOAD_OCCLUDERS_H
#define PETRICHOR_GPU_UPLOAD_OCCLUDERS_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace petrichor::gpu {

/// A triangle that may hide much.
struct LargeTriangle {
    std::uint32_t number = 0;  ///< of its draw
    float area = 0.0f;         ///< in the space of its vertices
};

/// The largest of a draw, largest first.
std::vector<LargeTriangle> large_triangles(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                           std::uint32_t first_vertex);

/// How near a map of depths without perspective is at least, once its large triangles are drawn: in cells of some texels, of which
/// a triangle counts that covers all. What lies behind in every cell that it touches leaves no texel of the map as it would
/// be without it. Depths are reversed, 1 near.
class Occluders {
public:
    static constexpr float kCell = 16.0f;  // texels
    /// texels: a side of the map. rounding: how far a corner may be off, texels.
    Occluders(const glm::mat4& clip_from_world, float texels, float rounding);
    /// Whether something so large may cover a cell.
    bool may_cover(float radius_m) const { return radius_m * texels_a_m_ > kCell; }
    /// Draws those of a draw that cover some cell; `left_out` (by number) are not in the map.
    template <class LeftOut>
    void add(const glm::mat4& to_world, std::span<const LargeTriangle> large, const glm::vec3* positions,
             const std::uint32_t* indices, std::uint32_t first_vertex, const LeftOut& left_out)
    {
        const glm::mat4 clip_from_mesh = clip_from_world_ * to_world;
        const float least = least_area(to_world);
        for (const LargeTriangle& triangle : large) {
            if (triangle.area < least) return;
            if (left_out(triangle.number)) continue;
            const std::uint32_t* index = indices + 3 * std::size_t{triangle.number};
            glm::vec3 corners[3];
            for (int k = 0; k < 3; ++k) corners[k] = glm::vec3(clip_from_mesh * glm::vec4(positions[index[k] - first_vertex], 1.0f));
            cover(corners);
        }
    }
    /// A box in the space of that matrix.
    bool hide(const glm::mat4& clip_from_mesh, const glm::vec3& centre, const glm::vec3& half) const;

private:
    float least_area(const glm::mat4& to_world) const;
    void cover(const glm::vec3 (&clip)[3]);

    glm::mat4 clip_from_world_;
    float texels_, rounding_, texels_a_m_;
    int cells_;  // a side
    std::vector<float> nearest_;
};

}  // namespace petrichor::gpu

#endif
