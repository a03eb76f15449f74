#include "film/tiles/glare_pyramid.h"

#include <algorithm>
#include <cstddef>
#include <glm/gtc/packing.hpp>

#include "base/parallel.h"

namespace petrichor::film {
namespace {

// As of gpu/passes/glare/glare.cpp and gpu/frame/targets.cpp.
constexpr float kWider = 0.75f;
constexpr int kSmallest = 4;

glm::vec3 light_of(const std::uint16_t* halves)
{
    return {glm::unpackHalf1x16(halves[0]), glm::unpackHalf1x16(halves[1]), glm::unpackHalf1x16(halves[2])};
}

// (1 3 3 1) / 8 across and down, around a texel of half the size.
template <class Texel>
glm::vec3 below_at(int x, int y, const Texel& texel)
{
    glm::vec3 sum(0.0f);
    for (int dy = -1; dy <= 2; ++dy) {
        glm::vec3 row(0.0f);
        for (int dx = -1; dx <= 2; ++dx) row += texel(2 * x + dx, 2 * y + dy) * ((dx & 2) == 0 ? 3.0f : 1.0f);
        sum += row * ((dy & 2) == 0 ? 3.0f : 1.0f);
    }
    return sum / 64.0f;
}

}  // namespace

glm::vec3 GlarePyramid::Level::texel(int x, int y) const
{
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return light_of(&halves[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))]);
}

void GlarePyramid::Level::set(int x, int y, const glm::vec3& light)
{
    std::uint16_t* to = &halves[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
    for (int c = 0; c < 3; ++c) to[c] = glm::packHalf1x16(std::min(light[c], 65504.0f));
}

glm::vec3 GlarePyramid::between(const Level& level, int x, int y)
{
    const int near_x = x / 2, near_y = y / 2;
    const int side_x = (x & 1) * 2 - 1, side_y = (y & 1) * 2 - 1;
    return (9.0f * level.texel(near_x, near_y) + 3.0f * level.texel(near_x + side_x, near_y) +
            3.0f * level.texel(near_x, near_y + side_y) + level.texel(near_x + side_x, near_y + side_y)) /
           16.0f;
}

GlarePyramid::Level GlarePyramid::below(const ExposedLight& light, int threads)
{
    Level level{(light.width() + 1) / 2, (light.height() + 1) / 2, {}};
    level.halves.resize(3 * static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
    parallel_for(static_cast<std::size_t>(level.height), threads, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const int first = std::max(2 * y - 1, 0);
        const int last = std::min(2 * y + 2, light.height() - 1);
        const std::vector<std::uint16_t> rows = light.rows(std::min(first, light.height() - 1), last - first + 1);
        const auto texel = [&](int px, int py) {
            px = std::clamp(px, 0, light.width() - 1);
            py = std::clamp(py, first, last) - first;
            return light_of(&rows[3 * (static_cast<std::size_t>(py) * static_cast<std::size_t>(light.width()) +
                                       static_cast<std::size_t>(px))]);
        };
        for (int x = 0; x < level.width; ++x) level.set(x, y, below_at(x, y, texel));
    });
    return level;
}

GlarePyramid::Level GlarePyramid::below(const Level& level, int threads)
{
    Level half{(level.width + 1) / 2, (level.height + 1) / 2, {}};
    half.halves.resize(3 * static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
    parallel_for(static_cast<std::size_t>(half.height), threads, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        const auto texel = [&](int px, int py) { return level.texel(px, py); };
        for (int x = 0; x < half.width; ++x) half.set(x, y, below_at(x, y, texel));
    });
    return half;
}

GlarePyramid::GlarePyramid(const ExposedLight& light, int threads)
{
    levels_.push_back(below(light, threads));
    while (std::min(levels_.back().width, levels_.back().height) > kSmallest) levels_.push_back(below(levels_.back(), threads));
    for (std::size_t i = levels_.size() - 1; i > 0; --i) {
        Level& level = levels_[i - 1];
        const Level& wider = levels_[i];
        parallel_for(static_cast<std::size_t>(level.height), threads, [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < level.width; ++x)
                level.set(x, y, glm::mix(level.texel(x, y), between(wider, x, y), kWider));
        });
    }
    levels_.resize(1);
}

}  // namespace petrichor::film
