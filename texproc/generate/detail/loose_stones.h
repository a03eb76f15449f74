#ifndef PETRICHOR_TEXPROC_GENERATE_DETAIL_LOOSE_STONES_H
#define PETRICHOR_TEXPROC_GENERATE_DETAIL_LOOSE_STONES_H

#include <array>
#include <vector>

#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc::detail {

/// How a layer of loose stones lies: one in each cell of a jittered grid.
struct LooseStones {
    float size_m = 0.02f;     ///< of a cell; a stone reaches 0.3 to 0.7 of it from its middle
    float roundness = 0.3f;   ///< 0 broken .. 1 rolled by water
    float flatness = 0.55f;   ///< height over half its width
    float spread_m = 0.003f;  ///< of the heights at which they lie
    float sunk_m = 0.0f;      ///< how deep the layer lies
    float share = 1.0f;       ///< of the cells that hold a stone
    std::uint32_t salt = 0;
};

/// The stone that is highest at a place.
struct StoneAt {
    float height_m = -1.0f;  ///< of its surface; -1 where there is none
    float inside = 0.0f;     ///< 0 at its outline .. 1 in the middle
    std::uint32_t id = 0;
};

/// Stones of one size over a tile, broken along planes or rounded, each tilted. Those finer than three texels are left
/// out, as octaves of noise are.
class StoneLayer {
public:
    StoneLayer(const MaterialSurface& surface, const LooseStones& rule);
    StoneAt at(float x_m, float y_m) const;
    bool left_out() const { return stones_.empty(); }

private:
    static constexpr int kSides = 7;
    struct Stone {
        float x, y, level;              // metres
        float radius;                   // metres, of the longer axis
        float stretch;                  // longer axis over the shorter
        float cosine, sine;
        float tilt_x, tilt_y;
        std::array<float, kSides> side;  // distance of the planes, of the radius
        std::uint32_t id;
        bool there;
    };
    LooseStones rule_;
    int cells_;
    float cell_m_, tile_m_;
    std::array<glm::vec2, kSides> normals_;
    std::vector<Stone> stones_;
};

}  // namespace petrichor::texproc::detail

#endif
