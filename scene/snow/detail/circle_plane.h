// The plane through what lies in a circle of the ground.
#ifndef PETRICHOR_SCENE_SNOW_DETAIL_CIRCLE_PLANE_H
#define PETRICHOR_SCENE_SNOW_DETAIL_CIRCLE_PLANE_H

#include <algorithm>
#include <glm/glm.hpp>

namespace petrichor::scene::detail {

/// Heights in a circle, by weights. One that an edge or a wall cuts has its mean off the place: the plane through it tells
/// what is there. Where little lies in it the plane is a guess, and goes no further than what lies there.
class CirclePlane {
public:
    /// way: from the middle of the circle, over its radius. rise: m, over any level that all share.
    void add(float weight, const glm::vec2& way, float rise_m)
    {
        if (!(weight > 0.0f)) return;
        weight_ += weight;
        lowest_ = std::min(lowest_, rise_m);
        highest_ = std::max(highest_, rise_m);
        height_ += weight * rise_m;
        middle_ += weight * way;
        lean_ += weight * rise_m * way;
        xx_ += weight * way.x * way.x;
        xz_ += weight * way.x * way.y;
        zz_ += weight * way.y * way.y;
    }
    float weight() const { return weight_; }

    struct Fit {
        float rise_m;        ///< in the middle of the circle
        glm::vec2 slope_m;   ///< a radius
    };
    /// Of weight() > 0.
    Fit fit() const
    {
        const glm::vec2 middle = middle_ / weight_;
        const float height = height_ / weight_;
        const glm::vec2 lean = lean_ / weight_ - height * middle;
        const float xx = xx_ / weight_ - middle.x * middle.x + kStiff;
        const float zz = zz_ / weight_ - middle.y * middle.y + kStiff;
        const float xz = xz_ / weight_ - middle.x * middle.y;
        const float det = xx * zz - xz * xz;
        const glm::vec2 slope(glm::dot(glm::vec2(zz, -xz), lean) / det, glm::dot(glm::vec2(-xz, xx), lean) / det);
        return {std::clamp(height - glm::dot(slope, middle), lowest_, highest_), slope};
    }

private:
    static constexpr float kStiff = 0.01f;  // over the radius squared
    float weight_ = 0.0f, height_ = 0.0f, xx_ = 0.0f, xz_ = 0.0f, zz_ = 0.0f, lowest_ = 1.0e9f, highest_ = -1.0e9f;
    glm::vec2 middle_{0.0f}, lean_{0.0f};
};

}  // namespace petrichor::scene::detail

#endif
