#include "gpu/passes/lights/light_turns.h"

#include <algorithm>
#include <cmath>

namespace petrichor::gpu {

namespace {

constexpr int kSide = LIGHT_TILE * LIGHT_COARSE;  // pixels

// Coarse tiles, the high ones beyond the last.
struct Tiles {
    int low_x = 1 << 30, low_y = 1 << 30, high_x = 0, high_y = 0;

    bool empty() const { return low_x >= high_x || low_y >= high_y; }
    void join(const Tiles& other)
    {
        if (other.empty()) return;
        low_x = std::min(low_x, other.low_x);
        low_y = std::min(low_y, other.low_y);
        high_x = std::max(high_x, other.high_x);
        high_y = std::max(high_y, other.high_y);
    }
};

struct Range {
    float low, high;
};

// Along an axis of the picture: where the ball is seen, in pixels.
//   across, along   of its centre, from the eye
Range seen_range(float across, float along, float radius, float corner, float step, bool orthographic)
{
    Range seen{across - radius, across + radius};
    if (!orthographic) {
        // Slopes of the two lines from the eye that touch a circle; radius < along.
        const float tangent = std::sqrt(std::max(across * across + along * along - radius * radius, 0.0f));
        seen = {(across * tangent - along * radius) / (along * tangent + across * radius),
                (across * tangent + along * radius) / (along * tangent - across * radius)};
    }
    constexpr float kMargin = 2.0f;  // samples are moved by less than a pixel
    return {(seen.low - corner) / step - kMargin, (seen.high - corner) / step + kMargin};
}

// low and high of the tiles along an axis of so many.
void tiles_of(const Range& pixels, int tiles, int& low, int& high)
{
    const auto tile = [tiles](float at) {
        return static_cast<int>(std::clamp(std::floor(at / kSide), -1.0f, static_cast<float>(tiles)));
    };
    low = std::max(tile(pixels.low), 0);
    high = std::min(tile(pixels.high) + 1, tiles);
}

Tiles tiles_of(const glm::vec4& ball, const shared::FrameConstants& c, int tiles_x, int tiles_y)
{
    const bool orthographic = (c.flags & FRAME_ORTHOGRAPHIC) != 0u;
    const glm::vec3 offset = glm::vec3(ball) - c.camera_m;
    const float along = glm::dot(offset, c.forward);
    const float radius = ball.w;
    if (along + radius < 0.0f) return {};
    Tiles seen{0, 0, tiles_x, tiles_y};
    if (!orthographic && along <= 1.001f * radius) return seen;  // it may be all around the eye
    const float step_x = glm::length(c.ray_dx), step_y = glm::length(c.ray_dy);
    const glm::vec3 right = c.ray_dx / step_x, down = c.ray_dy / step_y;
    const glm::vec3 corner = orthographic ? c.origin_corner - c.camera_m : c.ray_corner;
    tiles_of(seen_range(glm::dot(offset, right), along, radius, glm::dot(corner, right), step_x, orthographic), tiles_x,
             seen.low_x, seen.high_x);
    tiles_of(seen_range(glm::dot(offset, down), along, radius, glm::dot(corner, down), step_y, orthographic), tiles_y,
             seen.low_y, seen.high_y);
    return seen;
}

// Counts what is added to rectangles of tiles.
class TileCounts {
public:
    TileCounts(int tiles_x, int tiles_y)
        : width_(tiles_x + 1), height_(tiles_y + 1), counts_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))
    {
    }
    void add(const Tiles& t)
    {
        if (t.empty()) return;
        ++at(t.low_x, t.low_y);
        --at(t.high_x, t.low_y);
        --at(t.low_x, t.high_y);
        ++at(t.high_x, t.high_y);
    }
    void sum_up()
    {
        for (int y = 0; y < height_; ++y)
            for (int x = 1; x < width_; ++x) at(x, y) += at(x - 1, y);
        for (int y = 1; y < height_; ++y)
            for (int x = 0; x < width_; ++x) at(x, y) += at(x, y - 1);
    }
    long& at(int x, int y)
    {
        return counts_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    }

private:
    int width_, height_;
    std::vector<long> counts_;
};

}  // namespace

LightCrowd largest_light_crowd(std::span<const glm::vec4> balls, int ranges,
                               const std::vector<shared::FrameConstants>& views, int width, int height)
{
    const int tiles_x = (width + kSide - 1) / kSide, tiles_y = (height + kSide - 1) / kSide;
    TileCounts lights(tiles_x, tiles_y), words(tiles_x, tiles_y);
    Tiles word;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        Tiles seen;
        for (const shared::FrameConstants& view : views) seen.join(tiles_of(balls[i], view, tiles_x, tiles_y));
        lights.add(seen);
        word.join(seen);
        if (i % 32 == 31 || i + 1 == balls.size()) {
            words.add(word);
            word = {};
        }
    }
    lights.sum_up();
    words.sum_up();
    LightCrowd crowd;
    for (int y = 0; y < tiles_y; ++y) {
        for (int x = 0; x < tiles_x; ++x) {
            // light_loops.glsl, where invocations read lights for each other, at most: of b lights in a word b for
            // themselves and a turn for each eight, which ends a loop over them, and each word once more in every range.
            const auto here = static_cast<std::size_t>(lights.at(x, y));
            const std::size_t turns = here + (3 * here + 7) / 8 +
                                      static_cast<std::size_t>(words.at(x, y)) * (3 * static_cast<std::size_t>(ranges) + 3);
            if (turns > crowd.turns) crowd = {here, turns};
        }
    }
    return crowd;
}

}  // namespace petrichor::gpu
