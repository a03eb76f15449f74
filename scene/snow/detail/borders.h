#ifndef PETRICHOR_SCENE_SNOW_DETAIL_BORDERS_H
#define PETRICHOR_SCENE_SNOW_DETAIL_BORDERS_H

#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "scene/patches/tracer.h"
#include "scene/snow/snow_caps.h"
#include "scene/subdivide/subdivide.h"

namespace petrichor::scene::detail {

/// Of an edge, a drop that no snow on what lies beyond reaches up to.
inline constexpr float kDeepDrop_m = 0.6f;
inline constexpr float kBeyond_m = 0.04f;  ///< so far out of a border is what lies beyond

/// How far a scene is a thing as it stands on a table, 0..1, by its size without its backdrop: its steps are its shape.
float small_model(const Tracer& tracer);

/// A piece of a border.
struct Border {
    glm::vec3 from{0.0f};
    glm::vec3 to{0.0f};
    glm::vec2 out{0.0f};  ///< unit, world x and z
    float gap_m = 1.0e9f;  ///< open: until ground goes on behind a slot or joint; 1e9: it does not
    float drop_m = kDeepDrop_m;  ///< open: how far below it what lies beyond is
    std::uint32_t beyond = SnowCaps::kNone;  ///< open: the point of the caps nearest to there
};

/// What lies beyond a border.
enum class Beyond { Nothing, Wall, Ground };
Beyond beyond(const Tracer& tracer, const glm::vec3& at, const glm::vec2& out);
/// How wide a slot is that begins at a place, until ground goes on; 1e9 when it is none.
float gap_beyond_m(const Tracer& tracer, const glm::vec3& at, const glm::vec2& out);

/// All borders of a mesh, in pieces of at most 0.25 m: open where the ground falls away beyond them, slots where it
/// goes on soon after, closed where a wall rises or ground goes on after a joint; low of the closed, where it goes on lower; bars of them,
/// where it goes on as high beyond a slot with lower ground in it.
struct Borders {
    std::vector<Border> open, slots, closed, low, bars;
};
Borders borders_of(const CutMesh& mesh, const Tracer& tracer);

struct NearEdge {
    float distance_m = 1.0e9f;
    const Border* border = nullptr;  ///< nothing: none is near
};

/// Finds the nearest border that lies on the same surface.
class EdgeGrid {
public:
    static constexpr float kReach_m = 0.6f;
    explicit EdgeGrid(std::vector<Border> edges);
    /// normal: of the surface at the place, unit.
    NearEdge nearest(const glm::vec3& place, const glm::vec3& normal) const;
    std::vector<Border>& edges() { return edges_; }

private:
    std::vector<Border> edges_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace petrichor::scene::detail

#endif
