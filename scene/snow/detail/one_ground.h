// The ground as snow that lies over its steps sees it: one height a cell.
#ifndef PETRICHOR_SCENE_SNOW_DETAIL_ONE_GROUND_H
#define PETRICHOR_SCENE_SNOW_DETAIL_ONE_GROUND_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "scene/snow/detail/sheet.h"

namespace petrichor::scene::detail {

inline constexpr float kHighestStep_m = 0.25f;  // that ground hangs together over

/// Of each cell of a sheet the highest layer of ground that hangs together over steps and is wide, below what roofs it over;
/// things that stand on it are left out, and joints are as high as their stones.
class OneGround {
public:
    static constexpr float kStep_m = 0.02f;  ///< from cell to cell: lower ones are relief
    static constexpr int kJoint = 3;         ///< cells without ground between ground are a joint

    /// The sheet must outlive it.
    explicit OneGround(const Sheet& sheet);

    bool found(int x, int z) const { return at(x, z) != nullptr; }
    float height_m(int x, int z) const { return heights_[index(x, z)]; }
    std::size_t index(int x, int z) const { return static_cast<std::size_t>(z) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x); }
    bool inside(int x, int z) const { return x >= 0 && z >= 0 && x < width_ && z < height_; }
    const Sheet::Layer* at(int x, int z) const
    {
        if (!inside(x, z)) return nullptr;
        const std::uint32_t top = top_[index(x, z)];
        return top == Sheet::kNoLayer ? nullptr : &sheet_->layers()[top];
    }
    int width() const { return width_; }
    int height() const { return height_; }

    struct Smoothed {
        float height_m = 0.0f;
        glm::vec2 slope{0.0f};
        float open = 0.0f;  ///< of what is open: what lies below bars counts little
        float whole = 0.0f;
    };
    /// By the plane through what lies in a circle of 1.6 of the depth around a place in a cell; heights over own_m count.
    Smoothed smoothed(int x, int z, float depth_m, float own_m, const glm::vec2& place) const;

private:
    const Sheet* sheet_;
    int width_, height_;
    std::vector<std::uint32_t> top_;
    std::vector<float> heights_;

    void leave_out_things(const std::function<bool(std::uint32_t layer)>& is_ground);
    void close_joints();
};

}  // namespace petrichor::scene::detail

#endif
