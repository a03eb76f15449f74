#ifndef PETRICHOR_DEMO_STREET_PARTS_H
#define PETRICHOR_DEMO_STREET_PARTS_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/image.h"
#include "demo/mesh_builder.h"

namespace petrichor::demo {

/// The materials of the street; each becomes one primitive.
enum class Slot {
    Cobble,
    Paving,
    Granite,
    Brick,
    Plaster,
    Timber,   ///< dark oak
    Painted,  ///< painted boards: door, frames, shutters
    RoofTile,
    Zinc,
    Iron,
    Awning,
    Grass,
    Blades,  ///< grass blades and leaves, coloured by vertex
    Glass,
    LitGlass,  ///< a window with light behind it
    LampGlass,
    Count,
};
inline constexpr std::size_t kSlots = static_cast<std::size_t>(Slot::Count);

/// What the builders of the parts share.
struct Kit {
    std::vector<MeshBuilder> builders;  ///< one a slot
    Image cobble_height;                ///< 1 channel, of the cobble material
    float cobble_tile_m = 1.0f;
    float cobble_scale_m = 0.02f;
    std::uint32_t seed = 1;

    MeshBuilder& operator[](Slot slot) { return builders[static_cast<std::size_t>(slot)]; }
};

/// A wall's own coordinates: u along it, v up, d out of it.
struct Frame {
    glm::vec3 origin{0.0f};
    glm::vec3 along{1.0f, 0.0f, 0.0f};
    glm::vec3 out{0.0f, 0.0f, 1.0f};

    glm::vec3 at(float u, float v, float d = 0.0f) const
    {
        return origin + along * u + glm::vec3(0.0f, v, 0.0f) + out * d;
    }
    glm::mat3 axes() const { return glm::mat3(along, glm::vec3(0.0f, 1.0f, 0.0f), out); }
};

// Measures of the street, metres. The road runs along z between -kRoadHalf and kRoadHalf.
inline constexpr float kRoadHalf = 2.2f;
inline constexpr float kGutterEnd = 2.5f;
inline constexpr float kKerbEnd = 2.64f;
inline constexpr float kKerbTop = 0.11f;
inline constexpr float kNear = 8.0f;    ///< z where the street begins, behind the camera
inline constexpr float kGate = -10.2f;  ///< z of the gate's front
inline constexpr float kFar = -21.0f;   ///< z of the last house
inline constexpr float kLeftWall = -3.75f;
inline constexpr float kRightWall = 3.3f;
inline constexpr float kGarden = -2.2f;  ///< the garden on the right ends here, a house begins

/// Ground level of the road without the relief of its stones, and where water gathers on it (0..1).
struct RoadPoint {
    float height_m;
    float puddle;
};
RoadPoint road_at(const Kit& kit, float x, float z);
/// Pavement level at a distance from the axis of the road, on either side.
float pavement_height(float x);

/// A leaf of two triangles, folded along its middle, that hangs from `at` and faces outward. half_width: over its length.
void add_leaf(MeshBuilder& plants, const glm::vec3& at, const glm::vec3& outward, float size,
              std::uint32_t hash, const glm::vec3& color, float half_width = 0.42f);

void add_ground(Kit& kit);
void add_houses(Kit& kit);
void add_gate(Kit& kit);
void add_awning(Kit& kit);
void add_lamp(Kit& kit, const glm::vec3& foot);
void add_furniture(Kit& kit);
void add_plants(Kit& kit);

/// Where the light of the lamp is, above its foot.
inline constexpr float kLampLight = 3.12f;
inline constexpr glm::vec3 kLampFoot{2.82f, 0.11f, -0.95f};

}  // namespace petrichor::demo

#endif
