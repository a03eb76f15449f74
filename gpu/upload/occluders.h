#ifndef PETRICHOR_GPU_UPLOAD_OCCLUDERS_H
#define PETRICHOR_GPU_UPLOAD_OCCLUDERS_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace petrichor::gpu {

/// A triangle that may hide much, or two that follow each other and are one flat face.
struct LargeFace {
    std::uint32_t number = 0;  ///< of its draw's triangles; of two, the first
    int corners = 3;
    std::uint32_t vertices[4] = {};  ///< as its indices call them, around it
    float area = 0.0f;               ///< in the space of its vertices
};

/// The largest of a draw, largest first.
std::vector<LargeFace> large_faces(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                   std::uint32_t first_vertex);

/// How near a map of depths without perspective is at least, once its large faces are drawn: in cells of some texels, of which
/// a face counts that covers all. What lies behind in every cell that it touches leaves no texel of the map as it would
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
    void add(const glm::mat4& to_world, std::span<const LargeFace> large, const glm::vec3* positions,
             std::uint32_t first_vertex, const LeftOut& left_out)
    {
        const glm::mat4 clip_from_mesh = clip_from_world_ * to_world;
        const float least = least_area(to_world);
        for (const LargeFace& face : large) {
            if (face.area < least) return;
            if (left_out(face.number) || (face.corners == 4 && left_out(face.number + 1))) continue;
            glm::vec3 corners[4];
            for (int k = 0; k < face.corners; ++k)
                corners[k] = glm::vec3(clip_from_mesh * glm::vec4(positions[face.vertices[k] - first_vertex], 1.0f));
            cover(corners, face.corners);
        }
    }
    /// A box in the space of that matrix.
    bool hide(const glm::mat4& clip_from_mesh, const glm::vec3& centre, const glm::vec3& half) const;

private:
    float least_area(const glm::mat4& to_world) const;
    void cover(const glm::vec3 (&clip)[4], int corners);

    glm::mat4 clip_from_world_;
    float texels_, rounding_, texels_a_m_;
    int cells_;  // a side
    std::vector<float> nearest_;
};

}  // namespace petrichor::gpu

#endif
