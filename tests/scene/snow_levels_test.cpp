// Fewer triangles for deep snow, that no eye can tell.
#include "scene/snow/snow_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "scene/snow/snow_caps.h"
#include "tests/scene/snow_scenes.h"

namespace petrichor::scene {
namespace {

using namespace snow_scenes;
using glm::vec2;
using glm::vec3;

class SnowLevelsTest : public ::testing::Test {
protected:
    SnowLevelsTest()
    {
        const Scene scene = cobbles(5, 100, 0.006f);
        const Triangles triangles(scene, {});
        const Tracer tracer(triangles);
        SnowCapOptions options;
        options.eyes_m = {{1.5f, 1.6f, 5.0f}};
        caps = build_snow_caps(tracer, options);
    }

    std::size_t triangles(std::size_t level) const
    {
        std::size_t count = 0;
        for (const SnowLevels::Piece& piece : caps.levels.pieces) count += piece.levels[level].index_count / 3;
        return count;
    }

    // Points of the triangles of a piece.
    std::vector<std::uint32_t> points(const SnowLevels::Piece& piece, std::size_t level) const
    {
        std::vector<std::uint32_t> list;
        for (std::uint32_t k = 0; k < piece.levels[level].index_count; ++k)
            list.push_back(caps.corner_points[caps.levels.indices[piece.levels[level].first_index + k]]);
        return list;
    }

    SnowCaps caps;
};

TEST_F(SnowLevelsTest, HaveAllTrianglesAtFirstAndFewWhereSnowIsDeep)
{
    EXPECT_EQ(triangles(0), caps.indices.size() / 3);
    EXPECT_LT(3 * triangles(1), triangles(0));
    EXPECT_LE(triangles(2), triangles(1));
    EXPECT_EQ(SnowLevels::level_at(0.069f), 0u);
    EXPECT_EQ(SnowLevels::level_at(0.071f), 1u);
    EXPECT_EQ(SnowLevels::level_at(0.3f), 2u);
}

// At depths that they were not made for, too.
TEST_F(SnowLevelsTest, LieOnTheSnowWithinMillimetres)
{
    for (const float depth : {0.085f, 0.12f, 0.2f, 0.35f}) {
        const SnowShape shape = snow_shape(caps, std::vector<float>(caps.points.size(), depth));
        const std::size_t level = SnowLevels::level_at(depth);
        double farthest_m = 0.0, most_turned = 0.0;
        std::size_t met = 0, all = 0;
        for (const SnowLevels::Piece& piece : caps.levels.pieces) {
            const std::vector<std::uint32_t> coarse = points(piece, level);
            const std::vector<std::uint32_t> fine = points(piece, 0);
            for (const std::uint32_t i : std::set<std::uint32_t>(fine.begin(), fine.end())) {
                const auto plan = [&](std::uint32_t point) { return vec2(shape.positions[point].x, shape.positions[point].z); };
                const auto cross = [](const vec2& a, const vec2& b) { return a.x * b.y - a.y * b.x; };
                // Rims overhang: there plan tells nothing, and nothing is left out.
                if (caps.points[i].edge_m < 0.5f) continue;
                ++all;
                for (std::size_t k = 0; k + 2 < coarse.size(); k += 3) {
                    const vec2 u = plan(coarse[k + 1]) - plan(coarse[k]), v = plan(coarse[k + 2]) - plan(coarse[k]), w = plan(i) - plan(coarse[k]);
                    const float area = cross(u, v), b1 = cross(w, v) / area, b2 = cross(u, w) / area;
                    if (!(b1 >= -1.0e-4f && b2 >= -1.0e-4f && b1 + b2 <= 1.0001f)) continue;
                    const auto mean = [&](const std::vector<vec3>& list) {
                        return (1.0f - b1 - b2) * list[coarse[k]] + b1 * list[coarse[k + 1]] + b2 * list[coarse[k + 2]];
                    };
                    farthest_m = std::max(farthest_m, static_cast<double>(std::abs(mean(shape.positions).y - shape.positions[i].y)));
                    most_turned = std::max(most_turned, static_cast<double>(glm::distance(glm::normalize(mean(shape.normals)), shape.normals[i])));
                    ++met;
                    break;
                }
            }
        }
        EXPECT_GT(met, all * 99 / 100);
        EXPECT_LT(farthest_m, 0.004) << "at " << depth;
        EXPECT_LT(most_turned, 0.15) << "at " << depth;
        RecordProperty("farthest" + std::to_string(depth), std::to_string(farthest_m));
    }
}

// Borders stay: pieces of any levels meet.
TEST_F(SnowLevelsTest, MeetWithoutGaps)
{
    for (const SnowLevels::Piece& piece : caps.levels.pieces) {
        const auto border = [&](std::size_t level) {
            const std::vector<std::uint32_t> list = points(piece, level);
            std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
            for (std::size_t k = 0; k < list.size(); ++k) {
                const std::uint32_t a = list[k], b = list[k % 3 == 2 ? k - 2 : k + 1];
                ways[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
            }
            std::erase_if(ways, [](const auto& one) { return one.second == 0; });
            return ways;
        };
        EXPECT_FALSE(border(0).empty());
        for (std::size_t level = 1; level <= SnowLevels::kCoarser; ++level) EXPECT_EQ(border(level), border(0));
    }
}

}  // namespace
}  // namespace petrichor::scene
