#ifndef PETRICHOR_SCENE_SNOW_SNOW_LEVELS_H
#define PETRICHOR_SCENE_SNOW_SNOW_LEVELS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace petrichor::scene {

struct SnowCaps;

/// The triangles of caps in pieces, and fewer of them for deep snow, which has forgotten the stones that they were cut for.
struct SnowLevels {
    /// From these depths on, wherever in a piece, it may be drawn coarser.
    static constexpr std::size_t kCoarser = 2;
    static constexpr std::array<float, kCoarser> kFrom_m{0.07f, 0.14f};
    struct Range {
        std::uint32_t first_index = 0;
        std::uint32_t index_count = 0;
    };
    struct Piece {
        std::uint32_t part = 0;  ///< of the caps
        std::array<Range, 1 + kCoarser> levels{};  ///< into `indices`; the first one has all of its triangles
    };
    std::vector<Piece> pieces;           ///< in the order of the parts
    std::vector<std::uint32_t> indices;  ///< as those of the caps

    /// What lies so deep all over a piece is drawn at this level.
    static std::size_t level_at(float least_depth_m);
};

/// Corners are left out one by one where the triangles around one of their neighbours hold the same snow: within a third of a
/// pixel as the nearest of the eyes sees it (a millimetre at least), hardly turned, under the same colours and masks, for all
/// depths that the level is for. What is left out lies deep below snow that stands upright over it, and so does all
/// around it; borders, rims and seams stay. Corners stay where they are, so pieces of any levels meet without gaps.
SnowLevels build_snow_levels(const SnowCaps& caps, const std::vector<glm::vec3>& eyes_m);

/// Snow so high over its ground, upright within this, hides it.
inline constexpr float kHidesGround_m = 0.02f;
inline constexpr float kUpright_m = 0.001f;

}  // namespace petrichor::scene

#endif
