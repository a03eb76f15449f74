#ifndef PETRICHOR_TEXPROC_GENERATE_DETAIL_COLONIES_H
#define PETRICHOR_TEXPROC_GENERATE_DETAIL_COLONIES_H

#include "texproc/generate/detail/material_texels.h"

namespace petrichor::texproc::detail {

/// The round growth that a place lies deepest in, or is nearest to.
struct ColonyAt {
    float inside = -8.0f;   ///< 1 in its middle, 0 at its rim, below 0 outside; in radii
    float radius_m = 0.0f;
    std::uint32_t id = 0;
};

/// Things that grow outwards from points: lichen, blisters of rust, drops of oil. One in each cell of a jittered grid,
/// most of them small.
class Colonies {
public:
    Colonies(const MaterialSurface& surface, float size_m, std::uint32_t salt)
        : cells_(surface.cells(size_m)), to_cells_(static_cast<float>(cells_) / surface.tile_m),
          seed_(hash_u32(surface.seed + 613u * salt + 29u))
    {
    }

    /// `share` 0..1 of the cells hold one.
    ColonyAt at(float x_m, float y_m, float share) const
    {
        ColonyAt best;
        const float x = x_m * to_cells_, y = y_m * to_cells_;
        const int cx = static_cast<int>(std::floor(x)), cy = static_cast<int>(std::floor(y));
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                const std::uint32_t h = hash_cell(wrap_index(cx + i, cells_), wrap_index(cy + j, cells_), seed_);
                if (hash_unit(h, 1) >= share) continue;
                const float dx = x - (static_cast<float>(cx + i) + 0.5f + 0.4f * hash_signed(h, 2));
                const float dy = y - (static_cast<float>(cy + j) + 0.5f + 0.4f * hash_signed(h, 3));
                const float chance = hash_unit(h, 4);
                const float radius = 0.10f + 0.48f * chance * chance;
                const float inside = 1.0f - std::sqrt(dx * dx + dy * dy) / radius;
                if (inside > best.inside) best = {inside, radius / to_cells_, h};
            }
        }
        return best;
    }

private:
    int cells_;
    float to_cells_;
    std::uint32_t seed_;
};

/// A crust of lichen on stone, clay or slate: rosettes of several sizes, each a mosaic of grains that thins at its rim.
struct LichenAt {
    float cover = 0.0f;      ///< 0..1
    float thick_m = 0.0f;
    glm::vec3 color{0.3f};
};

class Lichen {
public:
    Lichen(const MaterialSurface& surface, std::uint32_t salt);
    /// `share` 0..1: how much of the surface is grown over.
    LichenAt at(float x_m, float y_m, std::size_t texel, float share) const;

private:
    Colonies large_, small_;
    std::vector<float> lobes_, grain_, zone_;
};

}  // namespace petrichor::texproc::detail

#endif
