#ifndef PETRICHOR_GPU_UPLOAD_POSE_H
#define PETRICHOR_GPU_UPLOAD_POSE_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/upload/vertex.h"
#include "scene/animation/rig.h"
#include "scene/animation/wave.h"

namespace petrichor::gpu {

/// One primitive of one instance that moves. Where it bends, it has vertices of its own.
struct MovingDraw {
    scene::Instance instance;
    scene::Bounds box;                 ///< of its mesh at rest
    std::uint32_t index_count = 0;
    std::size_t first_vertex = 0;      ///< of those that are written anew
    std::shared_ptr<const scene::Primitive> shape;  ///< null: it is rigid
};

/// One primitive of one instance that bends in the wind, with vertices of its own.
struct WavingDraw {
    std::shared_ptr<const scene::Primitive> shape;
    scene::Bounds box;
    scene::WindLook look;
    std::size_t first_vertex = 0;
    std::int32_t mover = -1;  ///< number of what a user's own surface moves instead; negative: it is the wind
};

/// One primitive of one instance whose vertices a user's own surface moves (gpu/passes/own_moves).
struct OwnMover {
    std::shared_ptr<const scene::Primitive> shape;  ///< at rest
    std::size_t first_vertex = 0;                   ///< of all that bends
    std::uint32_t material = 0;
    glm::mat4 to_world{1.0f};
};

/// What it says of a vertex, in the world.
struct MovedVertex {
    glm::vec3 by_m;  ///< from where it rests
    glm::vec3 normal;
    glm::vec3 tangent;
};
/// So many vertices bend in the wind or are moved by own surfaces; a scene with more is refused.
inline constexpr std::size_t kMostWaving = 8u << 20;

/// What a draw is at a moment.
struct PosedDraw {
    bool visible = true;
    glm::mat4 to_world{1.0f};
    scene::Bounds box;        ///< in the space that to_world starts from
    bool mirrored = false;
};

/// `vertices` are those of all bending draws; the draw's own are written.
PosedDraw posed(const MovingDraw& draw, const scene::Rig& rig, const scene::Posture& posture,
                std::vector<Vertex>& vertices);

/// The smallest box along the axes around a box that is turned.
scene::Bounds box_in_world(const scene::Bounds& box, const glm::mat4& to_world);

}  // namespace petrichor::gpu

#endif
