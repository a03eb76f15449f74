#ifndef PETRICHOR_TEXPROC_PREFILTER_DETAIL_FLOOR_PLAN_H
#define PETRICHOR_TEXPROC_PREFILTER_DETAIL_FLOOR_PLAN_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>

#include "texproc/prefilter/picture.h"

namespace petrichor::texproc::detail {

// Which point of a floor z = 0 a place in the picture shows.
struct FloorPoint {
    double u = 0.0, v = 0.0;  // metres: the material repeats every one
    glm::vec3 to_eye{0.0f, 0.0f, 1.0f};
};
// A pixel: its middle, and how far its point moves over the pixel to the right and down.
struct FloorPixel : FloorPoint {
    double across_u = 0.0, across_v = 0.0, along_u = 0.0, along_v = 0.0;
};

class FloorPlan {
public:
    explicit FloorPlan(const PictureView& view)
        : view_(view),
          pitch_(view.pitch_deg * std::numbers::pi / 180.0),
          pixel_(2.0 * std::tan(view.field_of_view_deg * std::numbers::pi / 360.0) / view.width)
    {
    }
    // Where a place inside of a pixel is, 0..1 across and down what it covers; for ray().
    std::array<double, 2> inside(int x, int y, double across, double down) const
    {
        if (view_.covers == 1.0) return {x + across, y + down};  // to the last bit as ever
        return {x + 0.5 + (across - 0.5) * view_.covers, y + 0.5 + (down - 0.5) * view_.covers};
    }
    // x, y in pixels from the upper left corner.
    FloorPoint ray(int frame, double x, double y) const
    {
        const double right = (x - 0.5 * view_.width) * pixel_;
        const double down = (y - 0.5 * view_.rows) * pixel_;
        const double ahead = std::cos(pitch_) - down * std::sin(pitch_);
        const double fall = std::max(std::sin(pitch_) + down * std::cos(pitch_), 1e-3);
        const double distance = view_.height_m / fall;
        FloorPoint at;
        at.u = 0.13 + view_.step_right_m * frame + right * distance;
        at.v = view_.step_ahead_m * frame + ahead * distance;
        at.to_eye = glm::normalize(glm::vec3(glm::dvec3(-right, -ahead, fall)));
        return at;
    }
    FloorPixel pixel(int frame, int x, int y) const
    {
        FloorPixel p;
        static_cast<FloorPoint&>(p) = ray(frame, x + 0.5, y + 0.5);
        const auto [left_x, up_y] = inside(x, y, 0.0, 0.0);
        const auto [right_x, down_y] = inside(x, y, 1.0, 1.0);
        const FloorPoint left = ray(frame, left_x, y + 0.5), right = ray(frame, right_x, y + 0.5);
        const FloorPoint up = ray(frame, x + 0.5, up_y), down = ray(frame, x + 0.5, down_y);
        p.across_u = right.u - left.u, p.across_v = right.v - left.v;
        p.along_u = down.u - up.u, p.along_v = down.v - up.v;
        return p;
    }

private:
    PictureView view_;
    double pitch_, pixel_;
};

// Two numbers in [0, 1) for a sample of a pixel.
inline std::array<double, 2> jitter(std::uint32_t seed, int frame, int x, int y, int sample)
{
    std::uint32_t h = seed * 0x9e3779b9u;
    for (const int v : {frame, x, y, sample}) {
        h ^= static_cast<std::uint32_t>(v) + 0x7f4a7c15u;
        h *= 0x85ebca6bu;
        h ^= h >> 15;
        h *= 0xc2b2ae35u;
        h ^= h >> 13;
    }
    const std::uint32_t g = (h ^ (h >> 16)) * 0x27d4eb2du;
    return {static_cast<double>(h) / 4294967296.0,
            static_cast<double>(g ^ (g >> 15)) / 4294967296.0};
}

}  // namespace petrichor::texproc::detail

#endif
