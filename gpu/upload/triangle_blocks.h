#ifndef PETRICHOR_GPU_UPLOAD_TRIANGLE_BLOCKS_H
#define PETRICHOR_GPU_UPLOAD_TRIANGLE_BLOCKS_H

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/upload/asked_part.h"

namespace petrichor::gpu {

/// The triangles of a draw in blocks, in their order: what a view leaves out as a whole is not looked at one by one.
inline constexpr std::uint32_t kBlockTriangles = 64;
struct TriangleBlock {
    glm::vec3 centre{0.0f};  ///< of its box, in the space of the vertices; not a number where some corner is none
    glm::vec3 half{0.0f};
};

/// positions: of a draw's vertices, the first of which its indices call `first_vertex`.
std::vector<TriangleBlock> blocks_of(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                     std::uint32_t first_vertex);

/// What of a view is outside for a block when it is for each of its triangles (gpu/upload/seen_triangles.cpp), with more slack
/// than rounding takes: no block is left out of which a triangle would stay.
class BlockSieve {
public:
    /// low, high: pixels that the samples reach beyond the picture. slack and rounding: of a corner, pixels, and pixels at
    /// distance 1.
    BlockSieve(const glm::mat4& clip_from_mesh, glm::vec2 size, glm::vec2 low, glm::vec2 high, float slack, float rounding,
               const AskedPart& asked);
    bool leaves_out(const TriangleBlock& block) const;

private:
    // Of four half spaces: lanes of x, y, z and the rest; below 0 is outside.
    struct Sides {
        float rows[4][4] = {};
    };
    void set(Sides& sides, int lane, const glm::vec4& plane);

    Sides frame_;
    Sides asked_[3];
    int asked_fours_ = 0;
    glm::vec4 w_{0.0f};
    float slack_ = 0.0f, rounding_ = 0.0f;
};

}  // namespace petrichor::gpu

#endif
