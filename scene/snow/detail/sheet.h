// The ground below the snow as seen from above, and its heights as snow of a depth smooths them.
#ifndef PETRICHOR_SCENE_SNOW_DETAIL_SHEET_H
#define PETRICHOR_SCENE_SNOW_DETAIL_SHEET_H

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "scene/patches/tracer.h"
#include "scene/snow/detail/settle.h"
#include "scene/snow/snow_caps.h"
#include "scene/subdivide/subdivide.h"

namespace petrichor::scene::detail {

/// Heights of all that snow lies on, in square cells, layer over layer.
class Sheet {
public:
    struct Smoothed {
        float height_m;
        glm::vec2 slope{0.0f};  ///< rise along x and z
        float open = 0.0f;      ///< mean of what shelter leaves
        float bare = 1.0f;      ///< mean of `open` where nothing lies over it, 0 elsewhere
        float whole = 0.0f;     ///< share of the circle that is such ground
    };

    /// near: whether a place is of interest; others are left out. The cell grows where there would be too many.
    /// climbs: which steps count is told by so much of a depth.
    Sheet(const SnowCaps& caps, const CutMesh& mesh, float cell_m, const std::function<bool(const glm::vec3&)>& near, float climbs);

    /// Mean around a place of what lies within a step of `own_m`, in a circle that goes with the depth. Steps much lower than
    /// the depth count as they are, higher ones not at all. What lies close below something else counts as just below it.
    Smoothed smoothed(const glm::vec2& place, float own_m, float depth_m) const;

    static constexpr std::uint32_t kNoLayer = 0xffffffffu;
    struct Layer {
        float height_m;
        float open;
        std::uint32_t next;         ///< of the same cell; kNoLayer: none
        std::uint32_t primitive;    ///< of the mesh ..
        std::uint32_t first_index;  ///< .. and its triangle
    };
    int width() const { return width_; }
    int height() const { return height_; }
    float cell_m() const { return cell_m_; }
    /// Of a cell: its first layer, and where its middle lies in plan.
    std::uint32_t first(int x, int z) const { return first_[static_cast<std::size_t>(z) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)]; }
    glm::vec2 place(int x, int z) const { return low_ + cell_m_ * (glm::vec2(static_cast<float>(x), static_cast<float>(z)) + 0.5f); }
    glm::ivec2 cell_of(const glm::vec2& place) const { return glm::ivec2(glm::floor((place - low_) / cell_m_)); }
    const std::vector<Layer>& layers() const { return layers_; }

private:
    float cell_m_;
    float climbs_;
    glm::vec2 low_{0.0f};
    int width_ = 0, height_ = 0;
    std::vector<std::uint32_t> first_;
    std::vector<Layer> layers_;
};

/// Sets fill_m and broad: of all points, at each of SnowCaps::kFillDepths_m. Returns the sheet near the eyes.
Sheet fill_relief(SnowCaps& caps, const CutMesh& mesh, const std::vector<Joint>& joints, const Tracer& tracer,
                  const SnowCapOptions& options);

/// Times the depth at a place: the waves of snow, as far as edges of a length can carry them.
float uneven_at(const glm::vec3& place, float edge_m);

}  // namespace petrichor::scene::detail

#endif
